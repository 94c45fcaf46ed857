// The least distance of two bodies at samples of a motion, by FCL: what users do without a proof.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/motion.h"

#include <memory>

namespace chasles::bench {

class FclDistance {
public:
    FclDistance(const Polyhedron& moving, const Polyhedron& fixed);
    ~FclDistance();

    /// The distance of the bodies at a time; 0 where they overlap.
    [[nodiscard]] double at(const Motion& motion, double time) const;
    /// The least distance of the bodies at `samples` poses, evenly over the time; 0 where they overlap.
    [[nodiscard]] double least(const Motion& motion, int samples) const;

private:
    struct Models;
    std::unique_ptr<const Models> models_;
};

} // namespace chasles::bench
