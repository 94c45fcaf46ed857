// A scene of equal bodies in another library, in a process of its own: Coal's DynamicAABBTreeCollisionManager
// (bench/registry/coal_scene.py), or Parry's tree of boxes and its casts (bench/registry/parry/src/scene.rs).
//
//     bench                                    child
//     body V T x y z ... a b c ...             done           V vertices, T triangles; the shape of all bodies
//     place N w x y z x y z ...                done           the poses of N bodies: unit quaternions and translations
//     pass                                     found SECONDS a b a b ...   the pairs that overlap, or that touch
//
// SECONDS is the time of the library's update and of its test, by the child's own clock. Coal tests the poses of the
// last line `place`, Parry the way from the poses of the one before to these.
#pragma once

#include "bench/child_process.h"
#include "bench/pair_sets.h"
#include "chasles/scene/scene.h"

namespace chasles::bench {

/// Each function throws ChildFailed.
class PeerScene {
public:
    struct Pass {
        double milliseconds = 0;
        PairSet found;
    };

    PeerScene(const std::vector<std::string>& command, const Polyhedron& shape);

    /// Puts the bodies to where they are at a time.
    void place(const Scene& scene, double time);
    Pass pass();

private:
    void tell(const std::string& line);

    ChildProcess child_;
};

} // namespace chasles::bench
