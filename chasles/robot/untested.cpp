// What a checker does not look at. The pairs with a scene are counted, not visited, so that large scenes cost nothing.
#include "chasles/robot/prepared.h"

#include <algorithm>
#include <tuple>

namespace chasles::robot {

namespace {

using Prepared = RobotChecker::Prepared;
using OwnerPair = Model::OwnerPair;

class RobotUntestedCount {
public:
    explicit RobotUntestedCount(const Prepared& prepared)
        : prepared_(prepared), model_(prepared.model()), have_shapes_(model_.owners.size()) {
        for (const Element& element : model_.elements)
            have_shapes_[element.owner] = true;
        const std::size_t links = model_.description.links.size();
        for (const LinkPairDescription& pair : model_.description.disabled_pairs)
            if (const OwnerPair owners = model_.owners_of(pair.first, pair.second); owners.second < links)
                disabled_.insert(owners);
    }

    UntestedPairs run();

private:
    void visit(std::size_t a, std::size_t b);
    [[nodiscard]] UntestedReason reason_of(const OwnerPair& owners) const;
    void add_scene();

    const Prepared& prepared_;
    const Model& model_;
    std::vector<bool> have_shapes_; ///< of each owner
    std::set<OwnerPair> disabled_;
    UntestedPairs found_;
};

/// Of a pair that the model ignores.
UntestedReason RobotUntestedCount::reason_of(const OwnerPair& owners) const {
    if (model_.neighbours.contains(owners))
        return UntestedReason::adjacent;
    return disabled_.contains(owners) ? UntestedReason::disabled : UntestedReason::ignored;
}

void RobotUntestedCount::visit(std::size_t a, std::size_t b) {
    const Owner &first = model_.owners[a], &second = model_.owners[b];
    if (!have_shapes_[a] || !have_shapes_[b])
        ++found_.counts[std::size_t(UntestedReason::no_shapes)];
    else if (first.group == second.group)
        found_.add(first.name, second.name, UntestedReason::at_rest);
    else if (model_.ignored.contains({a, b}))
        found_.add(first.name, second.name, reason_of({a, b}));
    else
        ++found_.tested;
}

void RobotUntestedCount::add_scene() {
    const std::size_t bodies = prepared_.bodies.size();
    const auto with_shapes = std::size_t(std::ranges::count(have_shapes_, true));
    found_.counts[std::size_t(UntestedReason::no_shapes)] += (have_shapes_.size() - with_shapes) * bodies;
    found_.tested += with_shapes * bodies;
    for (const auto& [owner, body] : prepared_.ignored) {
        if (!have_shapes_[owner])
            continue;
        --found_.tested;
        found_.add(model_.owners[owner].name, prepared_.bodies[body].name, UntestedReason::ignored, true);
    }
}

UntestedPairs RobotUntestedCount::run() {
    for (std::size_t a = 0; a < model_.owners.size(); ++a)
        for (std::size_t b = a + 1; b < model_.owners.size(); ++b)
            visit(a, b);
    add_scene();
    for (std::size_t owner = 0; owner < model_.owners.size(); ++owner)
        if (!have_shapes_[owner])
            found_.without_shapes.push_back(model_.owners[owner].name);
    std::ranges::stable_sort(found_.named, {}, &UntestedPair::reason);
    return std::move(found_);
}

} // namespace

UntestedPairs untested_pairs(const Prepared& prepared) {
    return RobotUntestedCount(prepared).run();
}

} // namespace chasles::robot
