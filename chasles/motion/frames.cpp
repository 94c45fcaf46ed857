// The elementary frames: at rest, a hinge, a path. Source: docs/derivations/26-frames.md.
#include "chasles/motion/frames.h"
#include "chasles/algebra/sine_cosine.h"
#include "chasles/motion/axis_motion.h"
#include "chasles/motion/fixed_pose.h"
#include "chasles/motion/frame_in_both.h"
#include "chasles/motion/motion_description.h"
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

ScaledVector exact_vector(const Eigen::Vector3d& v) {
    return {vector_in<algebra::ExactNumber>(v)};
}

/// Of a polynomial that changes evenly, if they are doubles.
std::optional<std::vector<double>> values_at_ends(const TimePolynomial& polynomial) {
    if (!polynomial.is_straight())
        return std::nullopt;
    return std::vector{double(polynomial.at(Wide(0.0))), double(polynomial.at(Wide(1.0)))};
}

class RestFrame final : public FrameInBoth<RestFrame> {
public:
    explicit RestFrame(const Pose& pose) : given_(pose), pose_(pose) {}
    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& /*time*/) const {
        return in<S>(pose_);
    }
    [[nodiscard]] Vector3<double> reference() const override { return {}; }
    [[nodiscard]] Vector3<Wide> refined_reference() const override { return {}; }
    [[nodiscard]] RateExpansion expansion(const Bracket& /*times*/) const override {
        RateExpansion expansion{.pose = pose_.in_double, .reference = pose_.in_double.translation};
        expansion.turn_jerk = expansion.jerk = 0;
        return expansion;
    }
    [[nodiscard]] std::optional<AxisExpansion> expansion_about(const Vector3<double>& /*direction*/,
                                                               const Bracket& times) const override {
        return AxisExpansion{expansion(times), {}};
    }
    [[nodiscard]] double size() const override { return norm1(pose_.in_double.translation); }
    [[nodiscard]] std::vector<AxisSection> axis_sections() const override {
        AxisMotion motion;
        motion.base = ExactPose(given_);
        return {{{0, 1}, motion}};
    }
    [[nodiscard]] bool add_links(ChainLinks& chain, bool is_inverse) const override {
        chain.add(given_, is_inverse);
        return true;
    }

private:
    Pose given_;
    FixedPose pose_;
};

class HingeFrame final : public FrameInBoth<HingeFrame> {
public:
    /// The direction has unit length. `given` is the direction as it was given, if it has no unit length.
    HingeFrame(const Vector3<Wide>& point, const Vector3<Wide>& direction, TimePolynomial angle,
               std::optional<Eigen::Vector3d> given = std::nullopt)
        : given_(std::move(given)), point_(point), direction_(direction), point_in_double_(in_double(point)),
          direction_in_double_(in_double(direction)), angle_(std::move(angle)) {}

    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        const auto [sine, cosine] = algebra::sine_cosine(S(S(0.5) * angle_.at(time)));
        const auto& [point, direction] = numbers<S>();
        const Quaternion<S> turn{cosine, scale(direction, sine)};
        return {point - rotated(turn, point), turn};
    }
    [[nodiscard]] Vector3<double> reference() const override { return point_in_double_; }
    [[nodiscard]] Vector3<Wide> refined_reference() const override { return point_; }
    [[nodiscard]] RateExpansion expansion(const Bracket& times) const override {
        const PolynomialRates angle = angle_.rates(times);
        RateExpansion expansion{.pose = at(middle_of(times)), .reference = point_in_double_};
        expansion.turn_rate = scale(direction_in_double_, angle.first);
        expansion.turn_acceleration = scale(direction_in_double_, angle.second);
        expansion.bounds = expansion.sums = {angle.bounds[0], angle.bounds[1], 0, 0};
        expansion.turn_jerk = angle.bounds[2];
        expansion.jerk = 0;
        return expansion;
    }
    [[nodiscard]] std::optional<AxisExpansion> expansion_about(const Vector3<double>& direction,
                                                               const Bracket& times) const override {
        const RateExpansion all = expansion(times);
        return AxisExpansion{
            all, turn_across(direction_in_double_, direction, all.bounds.turn_rate, all.bounds.turn_acceleration)};
    }
    [[nodiscard]] double size() const override { return 2 * norm1(point_in_double_); }
    /// None of a direction that was rounded.
    [[nodiscard]] std::vector<AxisSection> axis_sections() const override {
        if (!given_)
            return {};
        AxisMotion motion;
        motion.kind = angle_.is_zero() ? AxisMotion::Kind::rest : AxisMotion::Kind::turn;
        motion.direction = exact_vector(*given_);
        motion.point = {{point_in_double_.x, point_in_double_.y, point_in_double_.z}};
        motion.value = angle_;
        return {{{0, 1}, motion}};
    }
    [[nodiscard]] bool add_links(ChainLinks& chain, bool is_inverse) const override {
        const std::optional<std::vector<double>> angles = values_at_ends(angle_);
        if (!given_ || !angles)
            return false;
        const Eigen::Vector3d point(point_in_double_.x, point_in_double_.y, point_in_double_.z);
        chain.add({point, Eigen::Quaterniond::Identity()}, false);
        const bool fits = chain.add({ChainLink::Kind::turn, is_inverse, *given_, {}, *angles}, {0, 1});
        chain.add({-point, Eigen::Quaterniond::Identity()}, false);
        return fits;
    }
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

    std::optional<Eigen::Vector3d> given_;
    Vector3<Wide> point_;
    Vector3<Wide> direction_;
    Vector3<double> point_in_double_;
    Vector3<double> direction_in_double_;
    TimePolynomial angle_;
};

class PathFrame final : public FrameInBoth<PathFrame> {
public:
    explicit PathFrame(std::array<TimePolynomial, 3> place) : place_(std::move(place)) {}
    /// Along a direction.
    PathFrame(const Eigen::Vector3d& direction, const TimePolynomial& way)
        : place_{scaled(way, direction.x()), scaled(way, direction.y()), scaled(way, direction.z())},
          given_(direction) {
        line_.kind = way.is_constant() ? AxisMotion::Kind::rest : AxisMotion::Kind::slide;
        line_.direction = exact_vector(direction);
        line_.value = way;
    }

    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        return {{place_[0].at(time), place_[1].at(time), place_[2].at(time)}, {S(1), {}}};
    }
    [[nodiscard]] Vector3<double> reference() const override { return {}; }
    [[nodiscard]] Vector3<Wide> refined_reference() const override { return {}; }
    [[nodiscard]] RateExpansion expansion(const Bracket& times) const override {
        const auto pose = at(middle_of(times));
        RateExpansion expansion{.pose = pose, .reference = pose.translation};
        const std::array rates{place_[0].rates(times), place_[1].rates(times), place_[2].rates(times)};
        const auto bound = [&](std::size_t order) {
            return Eigen::Vector3d(rates[0].bounds[order], rates[1].bounds[order], rates[2].bounds[order]).stableNorm();
        };
        expansion.velocity = {rates[0].first, rates[1].first, rates[2].first};
        expansion.acceleration = {rates[0].second, rates[1].second, rates[2].second};
        expansion.bounds = expansion.sums = {0, 0, bound(0), bound(1)};
        expansion.turn_jerk = 0;
        expansion.jerk = bound(2);
        return expansion;
    }
    [[nodiscard]] std::optional<AxisExpansion> expansion_about(const Vector3<double>& direction,
                                                               const Bracket& times) const override {
        AxisExpansion result{expansion(times), {}};
        for (int i = 0; i < 3; ++i)
            result.across.acceleration += std::abs(direction[i]) * place_[std::size_t(i)].rates(times).bounds[1];
        return result;
    }
    [[nodiscard]] double size() const override { return place_[0].size() + place_[1].size() + place_[2].size(); }
    [[nodiscard]] double rounding() const override {
        return std::max({place_[0].rounding(), place_[1].rounding(), place_[2].rounding()});
    }
    [[nodiscard]] std::vector<AxisSection> axis_sections() const override {
        if (line_.kind == AxisMotion::Kind::slide)
            return {{{0, 1}, line_}};
        const std::optional<Eigen::Vector3d> place = coefficient(0), way = coefficient(1);
        if (!std::ranges::all_of(place_, &TimePolynomial::is_straight) || !place || !way)
            return {};
        AxisMotion motion;
        motion.base.translation = exact_vector(*place);
        motion.direction = exact_vector(*way);
        motion.goal = {1.0, 1.0};
        motion.kind = motion.direction.is_zero() ? AxisMotion::Kind::rest : AxisMotion::Kind::slide;
        return {{{0, 1}, motion}};
    }

    [[nodiscard]] bool add_links(ChainLinks& chain, bool is_inverse) const override {
        ChainLink slide{.kind = ChainLink::Kind::slide, .is_inverse = is_inverse, .poses = {}, .values = {0, 1}};
        if (given_) {
            slide.vector = *given_;
            slide.values = values_at_ends(line_.value).value_or(std::vector<double>());
        } else {
            const std::optional<Eigen::Vector3d> place = coefficient(0), way = coefficient(1);
            if (!std::ranges::all_of(place_, &TimePolynomial::is_straight) || !place || !way)
                return false;
            chain.add({*place, Eigen::Quaterniond::Identity()}, is_inverse);
            slide.vector = *way;
        }
        return !slide.values.empty() && chain.add(std::move(slide), {0, 1});
    }

private:
    static TimePolynomial scaled(const TimePolynomial& way, double factor) {
        std::vector<Wide> coefficients;
        for (const Wide& c : way.coefficients())
            coefficients.push_back(c * Wide(factor));
        return TimePolynomial(std::move(coefficients));
    }
    /// Empty if it is no double: then the way was rounded, and may not meet the next one.
    [[nodiscard]] std::optional<Eigen::Vector3d> coefficient(std::size_t power) const {
        Eigen::Vector3d result = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < 3; ++i) {
            const std::vector<Wide>& coefficients = place_[i].coefficients();
            if (power >= coefficients.size())
                continue;
            if (coefficients[power].low() != 0)
                return std::nullopt;
            result[Eigen::Index(i)] = coefficients[power].high();
        }
        return result;
    }

    std::array<TimePolynomial, 3> place_;
    std::optional<Eigen::Vector3d> given_; ///< along which the way is, if it is along one direction
    AxisMotion line_;                      ///< at rest where no direction was given, or no way
};

} // namespace

SharedFrame frame_at_rest(const Pose& pose) {
    return std::make_shared<const RestFrame>(pose);
}

SharedFrame hinge_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, TimePolynomial angle) {
    return std::make_shared<const HingeFrame>(vector_in<Wide>(point), FixedAxis(direction).refined, std::move(angle),
                                              of_order_one(direction));
}

SharedFrame hinge_frame(const Vector3<Wide>& direction, TimePolynomial angle) {
    return std::make_shared<const HingeFrame>(origin(), direction, std::move(angle));
}

SharedFrame slide_frame(const Eigen::Vector3d& direction, const TimePolynomial& way) {
    return std::make_shared<const PathFrame>(direction, way);
}

SharedFrame path_frame(std::array<TimePolynomial, 3> place) {
    return std::make_shared<const PathFrame>(std::move(place));
}

} // namespace chasles::motion
