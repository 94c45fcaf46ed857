// The bodies of a scene: their names, and which pairs are not tested.
#include "chasles/scene/scene.h"

#include "chasles/base/invalid_input.h"
#include "chasles/query/requirements.h"
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
    scene::WorldMotion motion = scene::world_motion(body.motion, body.name);
    const bool rests = motion.rests;
    placed_.push_back({std::make_shared<scene::WorldMotion>(std::move(motion)), next_id_, rests});
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
    std::erase_if(touching_, has_body);
    for (Rules* rules : {&margins_, &holds_})
        std::erase_if(rules->of_pairs, [&](const auto& entry) { return has_body(entry.first); });
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
    placed_[index].rests = placed_[index].motion->rests;
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
    margins_.of_pairs[ids] = margin;
}

void Scene::set_group_margin(const std::string& a, const std::string& b, double margin) {
    query::check_options({.margin = margin});
    margins_.of_groups[ordered(a, b)] = margin;
}

void Scene::set_hold(std::string_view a, std::string_view b, double hold) {
    const Ids ids = ids_of(a, b, "hold");
    query::require_hold(hold);
    holds_.of_pairs[ids] = hold;
}

void Scene::set_group_hold(const std::string& a, const std::string& b, double hold) {
    query::require_hold(hold);
    holds_.of_groups[ordered(a, b)] = hold;
}

std::optional<double> Scene::rule_of(std::size_t a, std::size_t b, const Rules& rules) const {
    if (!rules.of_pairs.empty())
        if (const auto own = rules.of_pairs.find(ordered(placed_[a].id, placed_[b].id)); own != rules.of_pairs.end())
            return own->second;
    if (!rules.of_groups.empty())
        if (const auto own = rules.of_groups.find(ordered(bodies_[a].group, bodies_[b].group));
            own != rules.of_groups.end())
            return own->second;
    return std::nullopt;
}

double Scene::margin_of(std::size_t a, std::size_t b, double of_question) const {
    return rule_of(a, b, margins_).value_or(of_question);
}

QueryOptions Scene::options_of(std::size_t a, std::size_t b, const QueryOptions& of_question) const {
    QueryOptions options = of_question;
    options.margin = margin_of(a, b, of_question.margin);
    if (const auto hold = rule_of(a, b, holds_))
        options.hold = hold;
    if (options.hold && *options.hold >= options.margin)
        options.hold.reset();
    return options;
}

Bracket Scene::margins(double of_question) const {
    Bracket margins{of_question, of_question};
    const auto take = [&](double margin) {
        margins = {std::min(margins.lower, margin), std::max(margins.upper, margin)};
    };
    for (const auto& [ids, margin] : margins_.of_pairs)
        take(margin);
    for (const auto& [groups, margin] : margins_.of_groups)
        take(margin);
    return margins;
}

} // namespace chasles
