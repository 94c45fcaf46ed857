#include "bench/chasles_peer.h"

#include "bench/piecewise_poses.h"
#include "chasles/query/first_contact.h"

namespace chasles::bench {

namespace {

Peer chasles_peer(const std::string& name, Find find) {
    const auto prepare = [find](const Polyhedron& moving, const Polyhedron& fixed) {
        const auto screw = [](const Displacement& motion) { return ScrewMotion::between(motion.start, motion.goal); };
        const auto ask = [&moving, &fixed, screw, find](const Displacement& motion) {
            const FirstContact found =
                first_contact({.moving = moving, .fixed = fixed, .motion = screw(motion), .options = {.find = find}});
            PeerAnswer answer{.touches = found.verdict != Verdict::clear, .time = {}};
            if (answer.touches && find == Find::first)
                answer.time = found.time.lower;
            return answer;
        };
        const auto pose_at = [screw](const Displacement& motion, double time) {
            return PiecewisePoses(screw(motion)).at(time);
        };
        return PeerPair{ask, pose_at};
    };
    return {.name = name, .prepare = prepare};
}

} // namespace

Peer chasles_first() {
    return chasles_peer("Chasles, first contact", Find::first);
}

Peer chasles_any() {
    return chasles_peer("Chasles, yes or no", Find::any);
}

} // namespace chasles::bench
