// The boxes of a body at both ends of an interval, widened by how far its points leave their chords.
#include "chasles/scene/swept_body.h"

#include "chasles/base/sort.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chasles::scene {

namespace {

using Eigen::Vector3d;

/// The allowance for all roundings of a box, relative to the sizes that enter. The actual rounding is below a
/// hundredth.
constexpr double rounding = 1e-12;

Vector3d as_eigen(const motion::Vector3<double>& v) {
    return {v.x, v.y, v.z};
}

/// A body in its own frame.
struct Extent {
    explicit Extent(const WorldBody& body)
        : middle(0.5 * (body.body.report().lower + body.body.report().upper)),
          half(0.5 * (body.body.report().upper - body.body.report().lower)), centre(body.body.bvh().centre()),
          radius(body.body.ball_radius()), reference(as_eigen(body.frame.reference())) {}

    Vector3d middle, half; ///< of its box
    Vector3d centre;       ///< of the ball around it
    double radius;
    Vector3d reference; ///< of the rates
};

/// A body at a time, in the world.
struct Placement {
    Box box;
    Vector3d centre; ///< of the ball
};

/// The box is what the turned box of the body and the ball around it have in common.
Placement placement(const Extent& extent, const motion::MovingFrame& frame, double time) {
    const motion::GeneralPose<double> pose = frame.at(time);
    const auto& [w, v] = pose.rotation;
    const Eigen::Matrix3d turn = Eigen::Quaterniond(w, v.x, v.y, v.z).toRotationMatrix();
    const Vector3d place = as_eigen(pose.translation);
    const Vector3d middle = turn * extent.middle + place;
    const Vector3d around = turn.cwiseAbs() * extent.half;
    const Vector3d centre = turn * extent.centre + place;
    const Vector3d radius = Vector3d::Constant(extent.radius);
    return {{(middle - around).cwiseMax(centre - radius), (middle + around).cwiseMin(centre + radius)}, centre};
}

/// What a body has swept, section by section.
class Sweep {
public:
    Sweep(const WorldBody& body, const Extent& extent, const Placement& start)
        : frame_(body.frame), extent_(extent), reach_((extent.middle - extent.reference).norm() + extent.half.norm()),
          arm_((extent.centre - extent.reference).norm()), start_(start.centre), before_(start),
          swept_{start.box, {start.centre, Vector3d::Zero(), extent.radius}} {}

    /// Goes on to a time before which no rate jumps.
    void go_on(double until) {
        const motion::RateBounds rates = frame_.rates({time_, until});
        const Placement end = placement(extent_, frame_, until);
        swept_.box.extend(widened(before_.box.merged(end.box), deviation_from_straight(rates, reach_, until - time_)));
        swept_.ball.radius += deviation_from_straight(rates, arm_, until - time_);
        swept_.ball.way = end.centre - start_;
        before_ = end;
        time_ = until;
    }
    [[nodiscard]] const SweptBody& swept() const { return swept_; }

private:
    const motion::MovingFrame& frame_;
    const Extent& extent_;
    double reach_, arm_;
    Vector3d start_; ///< of the centre
    Placement before_;
    double time_ = 0;
    SweptBody swept_;
};

/// A body that moves.
SweptBody swept_while_moving(const WorldBody& body, const Extent& extent, const Placement& start, double until) {
    std::vector<double> cuts; // times at which rates jump
    body.frame.add_cuts(cuts);
    std::erase_if(cuts, [&](double cut) { return !(0 < cut && cut < until); });
    chasles::sort(cuts);
    Sweep sweep(body, extent, start);
    for (const double cut : cuts)
        sweep.go_on(cut);
    sweep.go_on(until);
    SweptBody swept = sweep.swept();
    if (!cuts.empty()) // the way is not even: the ball is everywhere, and the box alone decides
        swept.ball.radius = std::numeric_limits<double>::infinity();
    return swept;
}

} // namespace

bool is_at_rest(const motion::MovingFrame& frame) {
    std::vector<double> ends{0, 1};
    frame.add_cuts(ends);
    chasles::sort(ends);
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const motion::RateBounds rates = frame.rates({ends[i - 1], ends[i]});
        if (rates.turn_rate != 0 || rates.speed != 0)
            return false;
    }
    return true;
}

Box widened(const Box& box, double length) {
    const Vector3d wider = Vector3d::Constant(length);
    return {box.min() - wider, box.max() + wider};
}

SweptBody swept(const WorldBody& body, double until) {
    const Extent extent(body);
    const Placement start = placement(extent, body.frame, 0);
    SweptBody swept = body.rests ? SweptBody{start.box, {start.centre, Vector3d::Zero(), extent.radius}}
                                 : swept_while_moving(body, extent, start, until);
    swept.ball.size = body.frame.size() + extent.middle.lpNorm<1>() + extent.half.lpNorm<1>();
    const double size = swept.box.min().cwiseAbs().cwiseMax(swept.box.max().cwiseAbs()).sum() + swept.ball.size;
    swept.box = widened(swept.box, rounding * size);
    return swept;
}

/// The first root of |d + t w|^2 = r^2.
double earliest_meeting(const MovingBall& a, const MovingBall& b, double margin) {
    constexpr double never = 2;
    const Vector3d apart = a.start - b.start, way = a.way - b.way;
    const double reach = a.radius + b.radius + margin + rounding * (apart.norm() + way.norm() + a.size + b.size);
    const double gap = apart.squaredNorm() - reach * reach;
    if (!(gap > 0))
        return 0;
    const double closing = -apart.dot(way), square = way.squaredNorm();
    if (closing <= 0 || (apart + way * (closing / square)).norm() > reach) // where they are nearest
        return never;
    const double root = std::max(0.0, closing * closing - square * gap);
    return std::min(never, gap / (closing + std::sqrt(root)) * (1 - 1e-6));
}

MovingBall rest_of(const MovingBall& ball, double share) {
    MovingBall rest = ball;
    rest.start += share * ball.way;
    rest.way *= 1 - share;
    return rest;
}

} // namespace chasles::scene
