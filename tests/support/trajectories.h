// The cubic motions and the end poses that public motions are searched by.
#pragma once

#include "chasles/motion/motion.h"
#include "chasles/motion/screw_trajectory.h"
#include "chasles/motion/sweep_trajectory.h"

namespace chasles::test {

/// The cubic motion of a screw that is one piece, and of a sweep.
inline motion::RationalMotion<algebra::DoubleDouble> cubic_of(const ScrewMotion& screw) {
    return motion::ScrewPiece(screw.trajectory().ends()).cubic();
}
inline motion::RationalMotion<algebra::DoubleDouble> cubic_of(const SweepMotion& sweep) {
    return sweep.trajectory().piece().cubic();
}

/// The end poses in the frame of the fixed body.
template <class AnyMotion>
motion::RelativeEnds relative_ends_of(const AnyMotion& motion) {
    return motion::RelativeEnds(motion.trajectory().ends());
}

} // namespace chasles::test
