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
          radius(body.body.vertex_radius()), reference(as_eigen(body.frame.reference())) {}

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

/// The times between which no rate jumps, from 0 to the end.
std::vector<double> sections_of(const motion::MovingFrame& frame, double until) {
    std::vector<double> cuts;
    frame.add_cuts(cuts);
    std::erase_if(cuts, [&](double cut) { return !(0 < cut && cut < until); });
    cuts.push_back(0);
    cuts.push_back(until);
    chasles::sort(cuts);
    return cuts;
}

/// A body that moves, from `before` on.
SweptBody swept_while_moving(const WorldBody& body, const Extent& extent, const Placement& before, double until) {
    const std::vector<double> cuts = sections_of(body.frame, until);
    const double reach = (extent.middle - extent.reference).norm() + extent.half.norm();
    const double arm = (extent.centre - extent.reference).norm();
    SweptBody swept{before.box, {before.centre, Vector3d::Zero(), extent.radius}};
    Placement begin = before;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        const double duration = cuts[i] - cuts[i - 1];
        const motion::RateBounds rates = body.frame.rates({cuts[i - 1], cuts[i]});
        const Placement end = placement(extent, body.frame, cuts[i]);
        swept.box.extend(widened(begin.box.merged(end.box), deviation_from_straight(rates, reach, duration)));
        swept.ball.radius += deviation_from_straight(rates, arm, duration);
        begin = end;
    }
    swept.ball.way = begin.centre - before.centre;
    if (cuts.size() > 2) // the way is not even: the ball is everywhere, and the box alone decides
        swept.ball.radius = std::numeric_limits<double>::infinity();
    return swept;
}

} // namespace

bool is_at_rest(const motion::MovingFrame& frame) {
    std::vector<double> cuts;
    frame.add_cuts(cuts);
    const motion::RateBounds rates = frame.rates({0, 1});
    return cuts.empty() && rates.turn_rate == 0 && rates.speed == 0;
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
