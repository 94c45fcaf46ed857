// The bodies of a scene: their names, and which pairs are not tested.
#include "chasles/scene/scene.h"

#include "chasles/base/invalid_input.h"
#include "chasles/query/pair_query.h"
#include "chasles/scene/pair_question.h"

#include <algorithm>

namespace chasles {

using scene::refuse;

namespace {

template <class T>
std::pair<T, T> ordered(const T& a, const T& b) {
    return a < b ? std::pair(a, b) : std::pair(b, a);
}

/// Makes room for a quarter more: a doubled vector of a large scene wastes more than some bodies hold.
template <class T>
void grow(std::vector<T>& items) {
    constexpr std::size_t least = 8;
    if (items.size() == items.capacity())
        items.reserve(items.size() + items.size() / 4 + least);
}

} // namespace

std::size_t Scene::add(SceneBody body) {
    if (body.name.empty())
        throw InvalidInput("scene: a body has no name");
    if (by_name_.contains(body.name))
        refuse(body.name, "is in the scene already");
    grow(bodies_);
    grow(placed_);
    placed_.push_back({std::make_shared<scene::WorldMotion>(scene::world_motion(body.motion, body.name)), next_id_});
    ++next_id_;
    by_name_.emplace(body.name, bodies_.size());
    bodies_.push_back(std::move(body));
    return bodies_.size() - 1;
}

void Scene::remove(std::string_view name) {
    const std::size_t index = index_of(name);
    const std::uint32_t id = placed_[index].id;
    const auto has_body = [&](const Ids& pair) { return pair.first == id || pair.second == id; };
    std::erase_if(ignored_, has_body);
    std::erase_if(margins_, [&](const auto& entry) { return has_body(entry.first); });
    by_name_.erase(by_name_.find(name));
    if (index + 1 < bodies_.size()) {
        bodies_[index] = std::move(bodies_.back());
        placed_[index] = std::move(placed_.back());
        by_name_.find(bodies_[index].name)->second = index;
    }
    bodies_.pop_back();
    placed_.pop_back();
}

void Scene::move(std::size_t index, const Motion& motion) {
    scene::require_body(*this, index);
    placed_[index].motion = std::make_shared<scene::WorldMotion>(scene::world_motion(motion, bodies_[index].name));
    bodies_[index].motion = motion;
}

std::size_t Scene::index_of(std::string_view name) const {
    const auto found = by_name_.find(name);
    if (found == by_name_.end())
        refuse(name, "is not in the scene");
    return found->second;
}

Scene::Ids Scene::ids_of(std::string_view a, std::string_view b, const char* what) const {
    if (a == b)
        refuse(a, std::string(what) + ": the same body twice");
    return ordered(placed_[index_of(a)].id, placed_[index_of(b)].id);
}

void Scene::ignore(std::string_view a, std::string_view b) {
    ignored_.insert(ids_of(a, b, "ignore"));
}

void Scene::ignore_groups(const std::string& a, const std::string& b) {
    ignored_groups_.insert(ordered(a, b));
}

bool Scene::is_ignored(std::size_t a, std::size_t b) const {
    return (!ignored_.empty() && ignored_.contains(ordered(placed_[a].id, placed_[b].id))) ||
           (!ignored_groups_.empty() && ignored_groups_.contains(ordered(bodies_[a].group, bodies_[b].group)));
}

void Scene::set_margin(std::string_view a, std::string_view b, double margin) {
    const Ids ids = ids_of(a, b, "margin");
    query::check_options({.margin = margin});
    margins_[ids] = margin;
}

void Scene::set_group_margin(const std::string& a, const std::string& b, double margin) {
    query::check_options({.margin = margin});
    group_margins_[ordered(a, b)] = margin;
}

double Scene::margin_of(std::size_t a, std::size_t b, double of_question) const {
    if (!margins_.empty())
        if (const auto own = margins_.find(ordered(placed_[a].id, placed_[b].id)); own != margins_.end())
            return own->second;
    if (group_margins_.empty())
        return of_question;
    const auto of_groups = group_margins_.find(ordered(bodies_[a].group, bodies_[b].group));
    return of_groups != group_margins_.end() ? of_groups->second : of_question;
}

double Scene::largest_margin(double of_question) const {
    double largest = of_question;
    for (const auto& [ids, margin] : margins_)
        largest = std::max(largest, margin);
    for (const auto& [groups, margin] : group_margins_)
        largest = std::max(largest, margin);
    return largest;
}

double Scene::least_margin(double of_question) const {
    double least = of_question;
    for (const auto& [ids, margin] : margins_)
        least = std::min(least, margin);
    for (const auto& [groups, margin] : group_margins_)
        least = std::min(least, margin);
    return least;
}

} // namespace chasles
