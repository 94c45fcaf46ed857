// How a dragged body may move at all.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace chasles {

/// What a lock leaves to a body.
enum class DragLockKind : std::uint8_t {
    free,     ///< every motion
    hinge,    ///< to turn about a line
    slider,   ///< to slide along a direction
    cylinder, ///< to turn about a line and to slide along it
    plane,    ///< to slide in a plane and to turn about its normal
};

/// A lock of a dragged body, in the world, from where the body is when the dragging begins.
struct DragLock {
    DragLockKind kind = DragLockKind::free;
    Eigen::Vector3d direction = Eigen::Vector3d::UnitZ(); ///< of the line, or the normal; of any length but zero
    Eigen::Vector3d point = Eigen::Vector3d::Zero();      ///< on the line of a hinge or a cylinder; mesh unit
};

} // namespace chasles
