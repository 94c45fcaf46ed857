// A scene in Coal's DynamicAABBTreeCollisionManager, in a process of its own (bench/registry/coal_scene.py).
//
//     bench                                    child
//     body V T x y z ... a b c ...             done           V vertices, T triangles; the shape of all bodies
//     place N w x y z x y z ...                done           the poses of N bodies: unit quaternions and translations
//     pass                                     found SECONDS a b a b ...   the pairs that overlap
//
// SECONDS is the time of the manager's update and of its test, by the child's own clock.
#pragma once

#include "bench/child_process.h"
#include "bench/pair_sets.h"
#include "bench/registry_peers.h"
#include "chasles/scene/scene.h"

namespace chasles::bench {

/// Each function throws ChildFailed.
class CoalScene {
public:
    struct Pass {
        double milliseconds = 0;
        PairSet found;
    };

    CoalScene(const PythonPeers& python, const Polyhedron& shape);

    /// Puts the bodies to where they are at a time.
    void place(const Scene& scene, double time);
    Pass pass();

private:
    void tell(const std::string& line);

    ChildProcess child_;
};

} // namespace chasles::bench
