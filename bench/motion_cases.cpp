#include "bench/motion_cases.h"

#include "bench/discrete_overlap.h"
#include "bench/piecewise_poses.h"

#include <Eigen/Geometry>
#include <numbers>

namespace chasles::bench {

namespace {

constexpr double degree = std::numbers::pi / 180;

struct Extent {
    Eigen::Vector3d centre;
    double length; ///< the longest side of the bounding box
};

Extent extent_of(const Polyhedron& body) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : body.vertices())
        box.extend(vertex);
    return {box.center(), box.sizes().maxCoeff()};
}

ScrewMotion straight(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Quaterniond still = Eigen::Quaterniond::Identity();
    return ScrewMotion::between(Pose(from, still), Pose(to, still));
}

/// A pose that turns the body about its middle, the point `centre` of the body's frame.
Pose turned_about(const Eigen::Vector3d& centre, const Eigen::Vector3d& offset, const Eigen::Quaterniond& turn) {
    return {Eigen::Vector3d(centre + offset - turn * centre), turn};
}

} // namespace

std::vector<MotionCase> into_contact(const NamedBody& body) {
    const Extent extent = extent_of(body.body);
    const Eigen::Vector3d directions[] = {{1, 0, 0},      {0, 1, 0},      {0, 0, 1},
                                          {-1, 0.5, 0.2}, {0.3, -1, 0.4}, {-0.5, 0.6, -1}};
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(20 * degree, Eigen::Vector3d(0.36, -0.8, 0.48)));
    std::vector<MotionCase> cases;
    for (const Eigen::Vector3d& direction : directions) {
        const Eigen::Vector3d far_away = 2 * extent.length * direction.normalized();
        const FirstContact touch = first_contact(
            {.moving = body.body, .fixed = body.body, .motion = straight(far_away, Eigen::Vector3d::Zero())});
        const Eigen::Vector3d way = 0.5 * extent.length * direction.normalized();
        const Eigen::Vector3d from = (1 - touch.time.lower) * far_away + 0.6 * way;
        cases.push_back({body.name + "/" + std::to_string(cases.size()), body.body, body.body,
                         ScrewMotion::between(Pose(from, Eigen::Quaterniond::Identity()),
                                              turned_about(extent.centre, from - way, turn)),
                         Verdict::contact});
    }
    return cases;
}

MotionCase nut_step(const NutAndBolt& pair) {
    const double pitch = 0.002;
    const double angle = 5 * degree;
    const Eigen::Vector3d raised(0, 0, 0.97 * pitch);
    const Eigen::Vector3d higher(0, 0, 0.97 * pitch + pitch * angle / (2 * std::numbers::pi));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
    return {"m16_nut_step", pair.nut, pair.bolt,
            ScrewMotion::between(Pose(raised, Eigen::Quaterniond::Identity()), Pose(higher, turn)), Verdict::clear};
}

FirstContact answer(const MotionCase& test, Find find) {
    return first_contact(
        {.moving = test.moving, .fixed = test.fixed, .motion = test.motion, .options = {.find = find}});
}

std::string contradiction(const MotionCase& test) {
    const FirstContact first = answer(test, Find::first);
    const FirstContact any = answer(test, Find::any);
    if (first.verdict != test.expected || any.verdict != test.expected)
        return "the verdict is not the expected one";
    const bool meets = first.verdict == Verdict::contact;
    if (meets && any.time.upper < first.time.lower)
        return "a contact is before the first one";
    const PiecewisePoses poses(test.motion);
    const auto overlap_at = [&](double time) { return is_overlapping(test.moving, test.fixed, poses.at(time)); };
    const int samples = 8;
    const double last = meets ? first.time.lower : 1;
    for (int i = 0; i <= samples; ++i)
        if (overlap_at(last * (i == samples ? 1 - 1e-9 : double(i) / samples)))
            return "the bodies overlap before the contact";
    if (meets && !overlap_at(first.time.upper + 1e-6))
        return "the bodies do not overlap after the contact";
    return {};
}

} // namespace chasles::bench
