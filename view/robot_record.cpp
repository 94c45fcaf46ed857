#include "view/robot_record.h"

#include "view/proven_verdict.h"
#include "view/sampled_track.h"

#include <algorithm>
#include <cmath>

namespace chasles::view {
namespace {

/// All links of a robot at a stamp.
struct LinksAt {
    double stamp;
    std::vector<Pose> poses;
};

/// Stamps that follow the variables: the page interpolates between them.
std::vector<double> stamps_of_variables(const JointPath& path, double end) {
    constexpr double largest_step = 0.03; // of the sum of all variables, radians or mesh unit
    constexpr int most_steps = 200;       // of a segment
    std::vector<double> stamps;
    for (const JointPath::Segment& segment : path.segments()) {
        if (segment.begin > end)
            break;
        double way = 0;
        for (Eigen::Index k = 1; k < segment.coefficients.rows(); ++k)
            way += segment.coefficients.row(k).lpNorm<1>();
        const int steps = int(std::clamp(std::ceil(way / largest_step), 1.0, double(most_steps)));
        for (int i = 0; i < steps; ++i)
            if (const double stamp = segment.begin + (segment.end - segment.begin) * i / steps; stamp < end)
                stamps.push_back(stamp);
    }
    stamps.push_back(end);
    const auto [first, last] = std::ranges::unique(stamps);
    stamps.erase(first, last);
    return stamps;
}

/// Adds stamps where a link turns far in one step: a joint of many turns, a joint that follows another one with a large
/// factor, a floating joint.
class LinkSampler {
public:
    LinkSampler(const chasles::Robot& robot, const JointPath& path) : robot_(robot), path_(path) {}

    [[nodiscard]] std::vector<LinksAt> along(const std::vector<double>& stamps) const {
        std::vector<LinksAt> samples{at(stamps.front())};
        for (std::size_t i = 1; i < stamps.size(); ++i)
            add(LinksAt(samples.back()), at(stamps[i]), most_halvings, samples);
        return samples;
    }

private:
    static constexpr int most_halvings = 12;
    static constexpr double probed_part = 0.618034;   ///< see sampled_track.cpp
    static constexpr double largest_deviation = 0.01; ///< radians

    [[nodiscard]] LinksAt at(double stamp) const { return {stamp, robot_.link_poses(path_.at(stamp))}; }

    void add(const LinksAt& from, const LinksAt& to, int halvings, std::vector<LinksAt>& samples) const {
        if (halvings > 0 && turns_far(from, to)) {
            const LinksAt middle = at((from.stamp + to.stamp) / 2);
            add(from, middle, halvings - 1, samples);
            add(middle, to, halvings - 1, samples);
        } else {
            samples.push_back(to);
        }
    }

    [[nodiscard]] bool turns_far(const LinksAt& from, const LinksAt& to) const {
        const LinksAt probe = at((1 - probed_part) * from.stamp + probed_part * to.stamp);
        for (std::size_t i = 0; i < from.poses.size(); ++i) {
            const auto turn = [&](const LinksAt& links) {
                return Eigen::Quaterniond(links.poses[i].rotation).normalized();
            };
            if (turn(from).angularDistance(turn(to)) > largest_turn_of_step ||
                turn(from).slerp(probed_part, turn(to)).angularDistance(turn(probe)) > largest_deviation)
                return true;
        }
        return false;
    }

    const chasles::Robot& robot_;
    const JointPath& path_;
};

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

/// A body of the world around the robot, at times of its own: it may turn much faster than the links.
RecordedBody body_of_world(const SceneBody& body, double begin, double whole, double end) {
    const double share = std::clamp((end - begin) / whole, 0.0, 1.0);
    const SampledTrack track = sampled_track(body.motion, box_around(body.shape), {share});
    RecordedBody recorded{body.name, body.shape, track.poses};
    if (track.times.empty())
        return recorded; // it rests
    for (const double time : track.times)
        recorded.times.push_back(time == share ? end : begin + whole * time);
    const auto after = std::ranges::upper_bound(recorded.times, end) - recorded.times.begin();
    recorded.times.resize(std::size_t(after));
    recorded.poses.resize(std::size_t(after));
    return recorded;
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
    require_answer(answer.verdict);
    const std::vector<JointPath::Segment>& segments = path.segments();
    const double begin = segments.front().begin, whole = segments.back().end - begin;
    const double end = answer.verdict == Verdict::clear ? segments.back().end : answer.time.lower;
    SceneRecord record{.source = RecordSource::first_contact, .clear_until = answer.clear_until};
    record.untested = *answer.untested;
    const auto& links = robot.description().links;
    std::vector<std::vector<Pose>> poses(links.size());
    for (const LinksAt& now : LinkSampler(robot, path).along(stamps_of_variables(path, end))) {
        record.times.push_back(now.stamp);
        for (std::size_t i = 0; i < links.size(); ++i)
            poses[i].push_back(now.poses[i]);
    }
    for (std::size_t i = 0; i < links.size(); ++i) {
        add_bodies(record, links[i].name, links[i].collisions, poses[i]);
        for (const AttachedPart& part : robot.attached())
            if (part.link == links[i].name)
                add_bodies(record, part.name, {{part.shape, part.pose}}, poses[i]);
    }
    for (const SceneBody& body : scene ? scene->bodies() : std::span<const SceneBody>())
        record.bodies.push_back(body_of_world(body, begin, whole, end));
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
