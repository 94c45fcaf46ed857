// The boxes of a body at both ends of an interval, widened by how far its points leave their chords.
// Source: docs/derivations/27-scenes.md, "Boxes".
#include "chasles/scene/world_box.h"

#include <algorithm>
#include <cmath>

namespace chasles::scene {

namespace {

using Eigen::Vector3d;

/// The allowance for all roundings of a box, relative to the sizes that enter. The actual rounding is below a
/// hundredth.
constexpr double rounding = 1e-12;

Vector3d as_eigen(const motion::Vector3<double>& v) {
    return {v.x, v.y, v.z};
}

/// The times between which no rate jumps, from the start to the end of the interval.
std::vector<double> sections_of(const motion::MovingFrame& frame, const Bracket& times) {
    std::vector<double> cuts;
    frame.add_cuts(cuts);
    std::erase_if(cuts, [&](double cut) { return !(times.lower < cut && cut < times.upper); });
    cuts.push_back(times.lower);
    cuts.push_back(times.upper);
    std::ranges::sort(cuts);
    return cuts;
}

/// The box of the body at a time: what the turned box of the body and the ball around it have in common.
Box box_at(const WorldBody& body, double time) {
    const MeshReport& report = body.body->report();
    const Bvh& tree = body.body->bvh();
    const motion::GeneralPose<double> pose = body.frame->at(time);
    const auto& [w, v] = pose.rotation;
    const Eigen::Matrix3d turn = Eigen::Quaterniond(w, v.x, v.y, v.z).toRotationMatrix();
    const Vector3d place = as_eigen(pose.translation);
    const Vector3d centre = turn * (0.5 * (report.lower + report.upper)) + place;
    const Vector3d around = turn.cwiseAbs() * (0.5 * (report.upper - report.lower));
    const Vector3d ball = turn * tree.centre() + place;
    const Vector3d radius = Vector3d::Constant(body.body->vertex_radius());
    return {(centre - around).cwiseMax(ball - radius), (centre + around).cwiseMin(ball + radius)};
}

/// How far a point of the body may leave its chord during a section.
double bend(const WorldBody& body, const Bracket& times) {
    const MeshReport& report = body.body->report();
    const Vector3d centre = 0.5 * (report.lower + report.upper);
    const double reach =
        (centre - as_eigen(body.frame->reference())).norm() + 0.5 * (report.upper - report.lower).norm();
    return deviation_from_straight(body.frame->rates(times), reach, times.upper - times.lower);
}

} // namespace

bool is_at_rest(const motion::MovingFrame& frame) {
    std::vector<double> cuts;
    frame.add_cuts(cuts);
    const motion::RateBounds rates = frame.rates({0, 1});
    return cuts.empty() && rates.turn_rate == 0 && rates.speed == 0;
}

Box swept_box(const WorldBody& body, const Bracket& times) {
    const std::vector<double> cuts = body.rests ? std::vector{times.lower} : sections_of(*body.frame, times);
    Box before = box_at(body, cuts.front());
    Box swept = before;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        const Box after = box_at(body, cuts[i]);
        Box section = before.merged(after);
        const Vector3d wider = Vector3d::Constant(bend(body, {cuts[i - 1], cuts[i]}));
        section.min() -= wider;
        section.max() += wider;
        swept.extend(section);
        before = after;
    }
    const double size = swept.min().cwiseAbs().cwiseMax(swept.max().cwiseAbs()).sum() + body.frame->size() +
                        body.body->report().lower.lpNorm<1>() + body.body->report().upper.lpNorm<1>();
    const Vector3d slack = Vector3d::Constant(rounding * size);
    return {swept.min() - slack, swept.max() + slack};
}

} // namespace chasles::scene
