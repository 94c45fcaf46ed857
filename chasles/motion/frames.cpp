// Poses of composed frames, and bounds of their rates.
// Source: docs/derivations/26-frames.md.
#include "chasles/motion/frames.h"

#include "chasles/algebra/sine_cosine.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace chasles::motion {

namespace {

using Wide = algebra::DoubleDouble;

Vector3<Wide> origin() {
    return {Wide(0.0), Wide(0.0), Wide(0.0)};
}

template <class S>
Vector3<S> placed(const GeneralPose<S>& pose, const Vector3<S>& point) {
    return rotated(pose.rotation, point) + pose.translation;
}

template <class S>
GeneralPose<S> product(const GeneralPose<S>& outer, const GeneralPose<S>& inner) {
    return {placed(outer, inner.translation), outer.rotation * inner.rotation};
}

/// `pose` relative to `frame`, both with quaternions of unit length.
template <class S>
GeneralPose<S> relative(const GeneralPose<S>& frame, const GeneralPose<S>& pose) {
    const Quaternion<S> back = frame.rotation.conjugate();
    return {rotated(back, pose.translation - frame.translation), back * pose.rotation};
}

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

class RestFrame final : public FrameInBoth<RestFrame> {
public:
    explicit RestFrame(const Pose& pose) : pose_(pose_in<Wide>(pose)) {
        const Wide inverse = Wide(1.0) / sqrt(pose_.rotation.squared_norm());
        pose_.rotation = {pose_.rotation.w * inverse, scale(pose_.rotation.v, inverse)};
        in_double_ = rounded_pose(pose_);
    }
    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& /*time*/) const {
        if constexpr (std::is_same_v<S, double>)
            return in_double_;
        else
            return pose_;
    }
    [[nodiscard]] Vector3<Wide> reference() const override { return origin(); }
    [[nodiscard]] RateBounds rates(const Bracket& /*times*/) const override { return {0, 0, 0, 0}; }
    [[nodiscard]] double size() const override { return norm1(in_double_.translation); }

private:
    GeneralPose<Wide> pose_;
    GeneralPose<double> in_double_;
};

class HingeFrame final : public FrameInBoth<HingeFrame> {
public:
    /// The direction has unit length.
    HingeFrame(const Vector3<Wide>& point, const Vector3<Wide>& direction, SmoothPolynomial angle)
        : point_(point), direction_(direction), point_in_double_(in_double(point)),
          direction_in_double_(in_double(direction)), angle_(std::move(angle)) {}

    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        const auto [sine, cosine] = algebra::sine_cosine(S(S(0.5) * angle_.at(time)));
        const auto& [point, direction] = numbers<S>();
        const Quaternion<S> turn{cosine, scale(direction, sine)};
        return {point - rotated(turn, point), turn};
    }
    [[nodiscard]] Vector3<Wide> reference() const override { return point_; }
    [[nodiscard]] RateBounds rates(const Bracket& times) const override {
        return {angle_.rate(times), angle_.second_rate(times), 0, 0};
    }
    [[nodiscard]] double size() const override { return 2 * norm1(point_in_double_); }
    /// The rounding of the angle, too, which may be many turns.
    [[nodiscard]] double rounding() const override { return 1 + angle_.rounding() * angle_.size(); }

private:
    template <class S>
    [[nodiscard]] std::pair<const Vector3<S>&, const Vector3<S>&> numbers() const {
        if constexpr (std::is_same_v<S, double>)
            return {point_in_double_, direction_in_double_};
        else
            return {point_, direction_};
    }

    Vector3<Wide> point_;
    Vector3<Wide> direction_;
    Vector3<double> point_in_double_;
    Vector3<double> direction_in_double_;
    SmoothPolynomial angle_;
};

class PathFrame final : public FrameInBoth<PathFrame> {
public:
    explicit PathFrame(std::array<SmoothPolynomial, 3> place) : place_(std::move(place)) {}

    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        return {{place_[0].at(time), place_[1].at(time), place_[2].at(time)}, {S(1), {}}};
    }
    [[nodiscard]] Vector3<Wide> reference() const override { return origin(); }
    [[nodiscard]] RateBounds rates(const Bracket& times) const override {
        const auto norm = [&](auto bound) { return std::hypot(bound(place_[0]), bound(place_[1]), bound(place_[2])); };
        return {0, 0, norm([&](const SmoothPolynomial& p) { return p.rate(times); }),
                norm([&](const SmoothPolynomial& p) { return p.second_rate(times); })};
    }
    [[nodiscard]] double size() const override { return place_[0].size() + place_[1].size() + place_[2].size(); }
    [[nodiscard]] double rounding() const override {
        return std::max({place_[0].rounding(), place_[1].rounding(), place_[2].rounding()});
    }

private:
    std::array<SmoothPolynomial, 3> place_;
};

/// Two frames that make a third one.
template <class Derived>
class FrameOfTwo : public FrameInBoth<Derived> {
public:
    FrameOfTwo(SharedFrame first, SharedFrame second) : first_(std::move(first)), second_(std::move(second)) {}

    [[nodiscard]] bool is_refined() const final { return first_->is_refined() && second_->is_refined(); }
    [[nodiscard]] double size() const final {
        return first_->size() + second_->size() + norm1(in_double(first_->reference())) +
               norm1(in_double(second_->reference()));
    }
    [[nodiscard]] double rounding() const final { return first_->rounding() + second_->rounding() + 1; }
    void add_cuts(std::vector<double>& cuts) const final {
        first_->add_cuts(cuts);
        second_->add_cuts(cuts);
    }

protected:
    template <class S>
    static GeneralPose<S> place_of(const MovingFrame& frame, const S& time) {
        if constexpr (std::is_same_v<S, double>)
            return frame.at(time);
        else
            return frame.refined_at(time);
    }

    SharedFrame first_;
    SharedFrame second_;
};

class ProductFrame final : public FrameOfTwo<ProductFrame> {
public:
    using FrameOfTwo::FrameOfTwo;

    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        return product(place_of<S>(*first_, time), place_of<S>(*second_, time));
    }
    [[nodiscard]] Vector3<Wide> reference() const override { return second_->reference(); }

    [[nodiscard]] RateBounds rates(const Bracket& times) const override {
        const RateBounds outer = first_->rates(times);
        const RateBounds inner = second_->rates(times);
        const Vector3<double> carried =
            placed(second_->at(0.5 * (times.lower + times.upper)), in_double(second_->reference()));
        const double arm = length(carried - in_double(first_->reference())) * (1 + 1e-12) + 1e-12 * size() +
                           0.5 * (times.upper - times.lower) * inner.speed;
        return {outer.turn_rate + inner.turn_rate,
                outer.turn_acceleration + inner.turn_acceleration + outer.turn_rate * inner.turn_rate,
                outer.speed + outer.turn_rate * arm + inner.speed,
                outer.acceleration + (outer.turn_acceleration + outer.turn_rate * outer.turn_rate) * arm +
                    2 * outer.turn_rate * inner.speed + inner.acceleration};
    }
};

class RelativeFrame final : public FrameOfTwo<RelativeFrame> {
public:
    using FrameOfTwo::FrameOfTwo;

    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        return relative(place_of<S>(*second_, time), place_of<S>(*first_, time));
    }
    [[nodiscard]] Vector3<Wide> reference() const override { return first_->reference(); }

    [[nodiscard]] RateBounds rates(const Bracket& times) const override {
        const RateBounds moving = first_->rates(times);
        const RateBounds fixed = second_->rates(times);
        const double middle = 0.5 * (times.lower + times.upper);
        const Vector3<double> between = placed(first_->at(middle), in_double(first_->reference())) -
                                        placed(second_->at(middle), in_double(second_->reference()));
        const double arm = length(between) * (1 + 1e-12) + 1e-12 * size() +
                           0.5 * (times.upper - times.lower) * (moving.speed + fixed.speed);
        const double speed = moving.speed + fixed.speed + fixed.turn_rate * arm;
        return {moving.turn_rate + fixed.turn_rate,
                moving.turn_acceleration + fixed.turn_acceleration + moving.turn_rate * fixed.turn_rate, speed,
                moving.acceleration + fixed.acceleration +
                    (fixed.turn_acceleration + fixed.turn_rate * fixed.turn_rate) * arm + 2 * fixed.turn_rate * speed};
    }
};

class JoinedFrames final : public FrameInBoth<JoinedFrames> {
public:
    JoinedFrames(std::vector<double> ends, std::vector<SharedFrame> frames)
        : ends_(std::move(ends)), frames_(std::move(frames)) {
        for (const SharedFrame& frame : frames_) {
            size_ = std::max(size_, frame->size());
            rounding_ = std::max(rounding_, frame->rounding());
            is_refined_ = is_refined_ && frame->is_refined();
        }
    }
    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        const std::size_t i = index_at(double(time));
        const S local = (time - S(ends_[i])) / (S(ends_[i + 1]) - S(ends_[i]));
        if constexpr (std::is_same_v<S, double>)
            return frames_[i]->at(local);
        else
            return frames_[i]->refined_at(local);
    }
    [[nodiscard]] bool is_refined() const override { return is_refined_; }
    [[nodiscard]] Vector3<Wide> reference() const override { return frames_.front()->reference(); }
    [[nodiscard]] RateBounds rates(const Bracket& times) const override {
        const std::size_t i = index_at(0.5 * (times.lower + times.upper));
        const double duration = ends_[i + 1] - ends_[i];
        const auto local = [&](double time) { return std::clamp((time - ends_[i]) / duration, 0.0, 1.0); };
        const RateBounds rates = frames_[i]->rates({local(times.lower), local(times.upper)});
        return {rates.turn_rate / duration, rates.turn_acceleration / (duration * duration), rates.speed / duration,
                rates.acceleration / (duration * duration)};
    }
    [[nodiscard]] double size() const override { return size_; }
    [[nodiscard]] double rounding() const override { return rounding_; }
    void add_cuts(std::vector<double>& cuts) const override { cuts.insert(cuts.end(), ends_.begin(), ends_.end()); }

private:
    /// Of the frame that lasts at this time; at an end, of the later one.
    [[nodiscard]] std::size_t index_at(double time) const {
        const auto after = std::upper_bound(ends_.begin(), ends_.end(), time);
        return std::clamp<std::size_t>(std::size_t(after - ends_.begin()), 1, frames_.size()) - 1;
    }

    std::vector<double> ends_;
    std::vector<SharedFrame> frames_;
    double size_ = 0;
    double rounding_ = 1;
    bool is_refined_ = true;
};

} // namespace

SharedFrame frame_at_rest(const Pose& pose) {
    return std::make_shared<const RestFrame>(pose);
}

SharedFrame hinge_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, SmoothPolynomial angle) {
    // The largest component is brought to the order of one first: nothing underflows.
    const Vector3<Wide> scaled = vector_in<Wide>(direction / direction.cwiseAbs().maxCoeff());
    return std::make_shared<const HingeFrame>(vector_in<Wide>(point), scale(scaled, Wide(1.0) / length(scaled)),
                                              std::move(angle));
}

SharedFrame hinge_frame(const Vector3<Wide>& direction, SmoothPolynomial angle) {
    return std::make_shared<const HingeFrame>(origin(), direction, std::move(angle));
}

SharedFrame path_frame(std::array<SmoothPolynomial, 3> place) {
    return std::make_shared<const PathFrame>(std::move(place));
}

SharedFrame product_frame(SharedFrame outer, SharedFrame inner) {
    return std::make_shared<const ProductFrame>(std::move(outer), std::move(inner));
}

SharedFrame relative_frame(SharedFrame moving, SharedFrame fixed) {
    return std::make_shared<const RelativeFrame>(std::move(moving), std::move(fixed));
}

SharedFrame joined_frames(std::vector<double> ends, std::vector<SharedFrame> frames) {
    return std::make_shared<const JoinedFrames>(std::move(ends), std::move(frames));
}

} // namespace chasles::motion
