// What the frames of the library have in common: one template for their poses in double and in double-double.
#pragma once

#include "chasles/motion/moving_frame.h"

namespace chasles::motion {

/// A frame whose poses are computed by one template.
template <class Derived>
class FrameInBoth : public MovingFrame {
public:
    [[nodiscard]] GeneralPose<double> at(double time) const final {
        return static_cast<const Derived&>(*this).template place<double>(time);
    }
    [[nodiscard]] GeneralPose<Wide> refined_at(const Wide& time) const final {
        return static_cast<const Derived&>(*this).template place<Wide>(time);
    }
    [[nodiscard]] bool is_refined() const override { return true; }
};

} // namespace chasles::motion
