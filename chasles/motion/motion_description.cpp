#include "chasles/motion/motion_description.h"

#include <algorithm>

namespace chasles::motion {

namespace {

bool is_same(const Pose& a, const Pose& b) {
    return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

bool is_same(const Pose* a, const Pose* b) {
    return a && b ? is_same(*a, *b) : a == b;
}

bool begins_where(const ChainLink& last, const ChainLink& next) {
    const bool is_one = last.kind == next.kind && last.is_inverse == next.is_inverse && last.vector == next.vector;
    if (!is_one || last.values.empty() != next.values.empty())
        return false;
    return last.values.empty() ? is_same(last.poses.back(), next.poses.front())
                               : last.values.back() == next.values.front();
}

} // namespace

bool ChainLinks::append(const ChainLinks& next) {
    if (!std::ranges::equal(links_, next.links_, begins_where))
        return false;
    for (std::size_t i = 0; i < links_.size(); ++i) {
        const ChainLink& more = next.links_[i];
        if (more.kind != ChainLink::Kind::pose)
            links_[i].poses.insert(links_[i].poses.end(), more.poses.begin() + !more.poses.empty(), more.poses.end());
        links_[i].values.insert(links_[i].values.end(), more.values.begin() + !more.values.empty(), more.values.end());
    }
    return true;
}

bool MotionDescription::append(const MotionDescription& next) {
    if (kind != next.kind || centre != next.centre)
        return false;
    if (kind == Kind::chain)
        return chain.append(next.chain);
    const MotionEnds &last = pieces.back(), &first = next.pieces.front();
    pieces.insert(pieces.end(), next.pieces.begin(), next.pieces.end());
    return is_same(last.goal, first.start) && is_same(last.goal_seen_from(), first.start_seen_from());
}

} // namespace chasles::motion
