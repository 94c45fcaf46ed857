// Counts what a scene leaves out by the sizes of groups, so that a large scene costs no time for each pair.
#include "chasles/scene/untested_pairs.h"

#include "chasles/base/limit.h"
#include "chasles/query/pair_query.h"
#include "chasles/scene/scene.h"

#include <algorithm>
#include <tuple>

namespace chasles {

/// The bodies of one scene. Ignored pairs are counted as such, whether they move or not.
class Scene::UntestedCount {
public:
    UntestedCount(const Scene& scene, double until, bool names)
        : scene_(scene), tests_bodies_at_rest_(until == 0), names_(names) {}

    UntestedPairs run();

private:
    using Reason = UntestedReason;
    /// Bodies of a group that is ignored against some group.
    struct Members {
        std::vector<std::size_t> all;
        std::size_t at_rest = 0;
    };

    [[nodiscard]] bool are_groups_ignored(std::size_t a, std::size_t b) const;
    void count_pairs();
    void count_groups();
    void count_at_rest();
    void name_groups(const Members& a, const Members& b);
    void name(Reason reason, std::size_t a, std::size_t b);
    [[nodiscard]] std::size_t& count(Reason reason) { return found_.counts[std::size_t(reason)]; }
    [[nodiscard]] bool is_full(Reason reason) const {
        return !names_ || named_[std::size_t(reason)] == UntestedPairs::most_named;
    }
    /// Of n bodies among themselves.
    static std::size_t pairs_of(std::size_t n) { return n == 0 ? 0 : n * (n - 1) / 2; }

    const Scene& scene_;
    bool tests_bodies_at_rest_;
    bool names_; ///< names take longer than numbers
    UntestedPairs found_;
    std::array<std::size_t, UntestedPairs::reasons> named_{};
    std::size_t ignored_at_rest_ = 0; ///< pairs
};

bool Scene::UntestedCount::are_groups_ignored(std::size_t a, std::size_t b) const {
    const std::string &first = scene_.bodies_[a].group, &second = scene_.bodies_[b].group;
    return scene_.ignored_groups_.contains(std::minmax(first, second));
}

void Scene::UntestedCount::name(Reason reason, std::size_t a, std::size_t b) {
    if (is_full(reason))
        return;
    ++named_[std::size_t(reason)];
    const auto [first, second] = std::minmax(scene_.bodies_[a].name, scene_.bodies_[b].name);
    found_.named.push_back({first, second, reason});
}

/// Pairs that are ignored by name.
void Scene::UntestedCount::count_pairs() {
    if (scene_.ignored_.empty())
        return;
    std::map<std::uint32_t, std::size_t> index_of;
    for (std::size_t i = 0; i < scene_.placed_.size(); ++i)
        index_of.emplace(scene_.placed_[i].id, i);
    for (const Ids& ids : scene_.ignored_) {
        const std::size_t a = index_of.at(ids.first), b = index_of.at(ids.second);
        const Reason reason = scene_.touching_.contains(ids) ? Reason::touching_at_start : Reason::ignored;
        ++count(reason);
        name(reason, a, b);
        if (are_groups_ignored(a, b))
            --count(Reason::ignored); // the groups count it too
        else
            ignored_at_rest_ += scene_.rests(a) && scene_.rests(b);
    }
}

void Scene::UntestedCount::count_groups() {
    std::map<std::string, Members> members;
    for (const auto& [a, b] : scene_.ignored_groups_)
        for (const std::string& group : {a, b})
            members.try_emplace(group);
    for (std::size_t i = 0; i < scene_.bodies_.size() && !members.empty(); ++i)
        if (const auto found = members.find(scene_.bodies_[i].group); found != members.end()) {
            found->second.all.push_back(i);
            found->second.at_rest += scene_.rests(i);
        }
    for (const auto& [first, second] : scene_.ignored_groups_) {
        const Members &a = members[first], &b = members[second];
        const bool is_same = first == second;
        count(Reason::ignored) += is_same ? pairs_of(a.all.size()) : a.all.size() * b.all.size();
        ignored_at_rest_ += is_same ? pairs_of(a.at_rest) : a.at_rest * b.at_rest;
        name_groups(a, b);
    }
}

void Scene::UntestedCount::name_groups(const Members& a, const Members& b) {
    const bool is_same = &a == &b;
    for (std::size_t i = 0; i < a.all.size(); ++i)
        for (std::size_t k = is_same ? i + 1 : 0; k < b.all.size(); ++k) {
            if (is_full(Reason::ignored))
                return;
            const auto ids = std::minmax(scene_.placed_[a.all[i]].id, scene_.placed_[b.all[k]].id);
            if (!scene_.ignored_.contains(ids)) // else it is named already
                name(Reason::ignored, a.all[i], b.all[k]);
        }
}

void Scene::UntestedCount::count_at_rest() {
    std::vector<std::size_t> resting;
    for (std::size_t i = 0; i < scene_.placed_.size(); ++i)
        if (scene_.rests(i))
            resting.push_back(i);
    const std::size_t pairs = pairs_of(resting.size()) - ignored_at_rest_;
    count(Reason::at_rest) = pairs;
    std::size_t left = names_ ? std::min<std::size_t>(pairs, UntestedPairs::most_named) : 0;
    std::size_t steps = 10'000; // where most pairs are ignored, fewer are named
    for (std::size_t i = 0; i < resting.size(); ++i)
        for (std::size_t k = i + 1; k < resting.size(); ++k) {
            if (left == 0 || steps-- == 0)
                return;
            if (!scene_.is_ignored(resting[i], resting[k])) {
                name(Reason::at_rest, resting[i], resting[k]);
                --left;
            }
        }
}

UntestedPairs Scene::UntestedCount::run() {
    count_pairs();
    count_groups();
    if (!tests_bodies_at_rest_)
        count_at_rest();
    std::ranges::sort(found_.named, {}, [](const UntestedPair& pair) {
        return std::tuple(pair.reason, std::string_view(pair.first), std::string_view(pair.second));
    });
    found_.tested = pairs_of(scene_.bodies_.size()) - found_.total();
    return std::move(found_);
}

UntestedPairs Scene::untested(const SceneQuery& query) const {
    return UntestedCount(*this, query.until, true).run();
}

UntestedPairs Scene::numbers_of_untested(const SceneQuery& query) const {
    return UntestedCount(*this, query.until, false).run();
}

std::vector<std::pair<std::string, std::string>> Scene::ignore_touching_at_start(double margin) {
    const SceneAnswer found = all_contacts({.options = {.margin = margin}, .until = 0});
    if (found.verdict == Verdict::unknown)
        throw Cancelled();
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const SceneContact& contact : found.contacts) {
        const auto ids = std::minmax(placed_[contact.moving].id, placed_[contact.fixed].id);
        ignored_.insert(ids);
        touching_.insert(ids);
        const auto [first, second] = std::minmax(bodies_[contact.moving].name, bodies_[contact.fixed].name);
        pairs.emplace_back(first, second);
    }
    std::ranges::sort(pairs);
    return pairs;
}

} // namespace chasles
