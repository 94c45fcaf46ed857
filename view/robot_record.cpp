#include "view/robot_record.h"

#include "view/proven_verdict.h"
#include "view/sampled_track.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace chasles::view {
namespace {

/// Which link a shape moves with from a stamp on.
struct Carried {
    std::size_t link;
    Pose place; ///< in the frame of the link
    double from = -std::numeric_limits<double>::infinity();
};

/// A shape of a link or of a part, which may change hands.
struct ShapeOfLink {
    std::string name;
    Polyhedron shape;
    std::vector<Carried> carried; ///< in the order of stamps

    [[nodiscard]] const Carried& at(double stamp) const {
        return *std::prev(std::ranges::upper_bound(carried, stamp, {}, &Carried::from));
    }
};

/// The shapes of links and parts, which are named after them.
std::vector<ShapeOfLink> shapes_of(const chasles::Robot& robot) {
    std::vector<ShapeOfLink> shapes;
    const std::vector<LinkDescription>& links = robot.description().links;
    for (std::size_t link = 0; link < links.size(); ++link) {
        const auto& [name, collisions] = links[link];
        for (std::size_t i = 0; i < collisions.size(); ++i)
            shapes.push_back({collisions.size() == 1 ? name : name + "/" + std::to_string(i + 1),
                              collisions[i].shape,
                              {{link, collisions[i].origin}}});
        for (const AttachedPart& part : robot.attached())
            if (part.link == name)
                shapes.push_back({part.name, part.shape, {{link, part.pose}}});
    }
    return shapes;
}

/// The place in the frame of a link, in the world.
Pose in_world(const Pose& link, const Pose& place) {
    const Eigen::Quaterniond turn = link.rotation.normalized();
    return {link.translation + turn * place.translation, turn * Eigen::Quaterniond(place.rotation)};
}

/// The place in the world, seen from a link.
Pose seen_from(const Pose& link, const Pose& place) {
    const Eigen::Quaterniond back = link.rotation.normalized().conjugate();
    return {back * (place.translation - link.translation), back * Eigen::Quaterniond(place.rotation)};
}

/// Parts keep their places where they change hands.
void add_handovers(std::vector<ShapeOfLink>& shapes, const chasles::Robot& robot, const RobotPathAnswer& answer) {
    const std::vector<LinkDescription>& links = robot.description().links;
    for (const Handover& handover : answer.handovers) {
        const auto shape = std::ranges::find(shapes, handover.part, &ShapeOfLink::name);
        const auto link = std::size_t(std::ranges::find(links, handover.link, &LinkDescription::name) - links.begin());
        const std::vector<Pose> poses = robot.link_poses(answer.path.at(handover.stamp));
        const Carried& before = shape->carried.back();
        const Pose place = in_world(poses[before.link], before.place);
        shape->carried.push_back({link, seen_from(poses[link], place), handover.stamp});
    }
}

/// Where segments meet, up to the end.
std::vector<double> stops_of(const JointPath& path, double end) {
    std::vector<double> stops;
    for (const JointPath::Segment& segment : path.segments())
        if (segment.begin < end)
            stops.push_back(segment.begin);
    stops.push_back(end);
    return stops;
}

void add_links(SceneRecord& record, const chasles::Robot& robot, const RobotPathAnswer& answer,
               const std::function<void(std::size_t)>& progress) {
    std::vector<ShapeOfLink> shapes = shapes_of(robot);
    add_handovers(shapes, robot, answer);
    const auto poses_at = [&](double stamp) {
        const std::vector<Pose> links = robot.link_poses(answer.path.at(stamp));
        std::vector<Pose> poses;
        for (const ShapeOfLink& shape : shapes)
            poses.push_back(in_world(links[shape.at(stamp).link], shape.at(stamp).place));
        return poses;
    };
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const ShapeOfLink& shape : shapes)
        boxes.push_back(box_around(shape.shape));
    std::vector<SampledTrack> tracks = sampled_tracks({poses_at, boxes, {}, true}, record.times, progress);
    for (std::size_t i = 0; i < shapes.size(); ++i)
        record.bodies.push_back(
            {shapes[i].name, shapes[i].shape, std::move(tracks[i].poses), std::move(tracks[i].times)});
}

/// The bodies of the world, whose motions last as long as the path.
void add_world(SceneRecord& record, const chasles::Scene& world, const Bracket& path) {
    const std::vector<double> ends =
        record.times.size() > 1 ? std::vector{record.times.front(), record.times.back()} : record.times;
    for (const SceneBody& body : world.bodies()) {
        const auto poses_at = [&](double stamp) {
            const double time = (stamp - path.lower) / (path.upper - path.lower);
            return std::vector{body.motion.pose_at(std::clamp(time, 0.0, 1.0))};
        };
        std::vector<double> cuts = cuts_of(body.motion);
        for (double& cut : cuts)
            cut = std::lerp(path.lower, path.upper, cut);
        SampledTrack track = sampled_tracks({poses_at, {box_around(body.shape)}, std::move(cuts)}, ends).front();
        record.bodies.push_back({body.name, body.shape, std::move(track.poses), std::move(track.times)});
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

SceneRecord robot_record(const chasles::Robot& robot, const chasles::Scene* scene, const RobotPathAnswer& about,
                         const std::function<void(std::size_t)>& progress) {
    const auto& [path, answer, handovers] = about;
    require_answer(answer.verdict);
    const Bracket whole{path.segments().front().begin, path.segments().back().end};
    SceneRecord record{.source = RecordSource::first_contact, .clear_until = answer.clear_until};
    record.times = stops_of(path, answer.verdict == Verdict::clear ? whole.upper : answer.time.lower);
    record.untested = *answer.untested;
    add_links(record, robot, about, progress);
    if (scene)
        add_world(record, *scene, whole);
    if (answer.pair)
        record.contacts.push_back({.time = answer.time.lower,
                                   .time_upper = answer.time.upper,
                                   .certain = answer.certain,
                                   .moving = index_of(record, answer.pair->first, answer.pair->first_shape),
                                   .fixed = index_of(record, answer.pair->second, answer.pair->second_shape),
                                   .contacts = answer.contact.contacts,
                                   .contacts_cut = answer.contact.contacts_cut,
                                   .overlap = answer.contact.overlap,
                                   .inside = answer.contact.inside});
    return record;
}

} // namespace chasles::view
