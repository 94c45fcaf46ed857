#include "view/robot_record.h"

#include <algorithm>
#include <cmath>

namespace chasles::view {
namespace {

/// Enough stamps for a page: linear interpolation between them looks like the motion.
std::vector<double> sampled_stamps(const JointPath& path, double end) {
    constexpr double largest_step = 0.03; // of the sum of all variables, radians or mesh unit
    constexpr int most_steps = 200;       // of a segment
    std::vector<double> stamps;
    for (const JointPath::Segment& segment : path.segments()) {
        if (segment.begin > end)
            break;
        double way = 0;
        for (Eigen::Index k = 1; k < segment.coefficients.rows(); ++k)
            way += segment.coefficients.row(k).lpNorm<1>();
        const int steps = std::clamp(int(std::ceil(way / largest_step)), 1, most_steps);
        for (int i = 0; i < steps; ++i)
            if (const double stamp = segment.begin + (segment.end - segment.begin) * i / steps; stamp < end)
                stamps.push_back(stamp);
    }
    stamps.push_back(end);
    const auto [first, last] = std::ranges::unique(stamps);
    stamps.erase(first, last);
    return stamps;
}

/// One pose for what never moves.
std::vector<PoseRow> rows_of(const std::vector<Pose>& poses) {
    std::vector<PoseRow> rows = pose_rows(poses);
    if (std::ranges::all_of(rows, [&](const PoseRow& row) { return row == rows.front(); }))
        rows.resize(1);
    return rows;
}

/// The bodies of a link or part, which are named after it.
void add_bodies(SceneRecord& record, const std::string& name, const std::vector<CollisionDescription>& shapes,
                const std::vector<Pose>& poses) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        std::vector<Pose> of_shape;
        of_shape.reserve(poses.size());
        for (const Pose& pose : poses)
            of_shape.emplace_back(pose.isometry() * shapes[i].origin.isometry());
        record.bodies.push_back(
            {shapes.size() == 1 ? name : name + "/" + std::to_string(i + 1), shapes[i].shape, rows_of(of_shape)});
    }
}

/// The index of a shape of a link, part or body of the scene in the record.
std::size_t index_of(const SceneRecord& record, const std::string& name, std::size_t shape) {
    for (const std::string& known : {name, name + "/" + std::to_string(shape + 1)})
        for (std::size_t i = 0; i < record.bodies.size(); ++i)
            if (record.bodies[i].name == known)
                return i;
    return 0;
}

} // namespace

SceneRecord robot_record(const chasles::Robot& robot, const chasles::Scene* scene, const JointPath& path,
                         const RobotAnswer& answer) {
    const std::vector<JointPath::Segment>& segments = path.segments();
    const double begin = segments.front().begin, whole = segments.back().end - begin;
    const double end = answer.verdict == Verdict::clear ? segments.back().end : answer.time.lower;
    SceneRecord record{.source = RecordSource::recording, .clear_until = answer.clear_until};
    record.untested = *answer.untested;
    record.times = sampled_stamps(path, end);
    const auto& links = robot.description().links;
    std::vector<std::vector<Pose>> poses(links.size());
    for (const double stamp : record.times) {
        const std::vector<Pose> now = robot.link_poses(path.at(stamp));
        for (std::size_t i = 0; i < links.size(); ++i)
            poses[i].push_back(now[i]);
    }
    for (std::size_t i = 0; i < links.size(); ++i) {
        add_bodies(record, links[i].name, links[i].collisions, poses[i]);
        for (const AttachedPart& part : robot.attached())
            if (part.link == links[i].name)
                add_bodies(record, part.name, {{part.shape, part.pose}}, poses[i]);
    }
    for (const SceneBody& body : scene ? scene->bodies() : std::span<const SceneBody>()) {
        std::vector<Pose> of_body;
        of_body.reserve(record.times.size());
        for (const double stamp : record.times)
            of_body.push_back(body.motion.pose_at(std::clamp((stamp - begin) / whole, 0.0, 1.0)));
        record.bodies.push_back({body.name, body.shape, rows_of(of_body)});
    }
    if (answer.pair)
        record.contacts.push_back({.time = answer.time.lower,
                                   .time_upper = answer.time.upper,
                                   .certain = answer.certain,
                                   .moving = index_of(record, answer.pair->first, answer.pair->first_shape),
                                   .fixed = index_of(record, answer.pair->second, answer.pair->second_shape),
                                   .contacts = answer.contact.contacts,
                                   .overlap = answer.contact.overlap});
    return record;
}

} // namespace chasles::view
