#include "chasles/manipulation/surroundings.h"

#include "chasles/manipulation/near_contacts.h"
#include "chasles/query/pair_query.h"

#include <algorithm>

namespace chasles::manipulation {

namespace {

/// Bodies nearer than this share of the margin cannot be kept apart.
constexpr double least_distance = 0x1p-20;
/// For roundings of balls, as a share of all lengths.
constexpr double ball_rounding = 1e-12;

Other placed(const Scene& scene, std::size_t index, std::size_t dragged) {
    const SceneBody& body = scene.bodies()[index];
    const bool is_ignored = scene.is_ignored(index, dragged);
    Other other{index, body.name, body.shape, body.motion, body.motion.pose_at(1), is_ignored, {}, 0, nullptr};
    other.centre = other.pose.isometry() * body.shape.body().bvh().centre();
    other.radius = body.shape.body().ball_radius();
    other.radius += ball_rounding * (other.radius + other.centre.norm());
    prepare(body.shape.body());
    return other;
}

/// Whether a body that was placed is still as the scene has it.
bool is_same(const Other& other, const SceneBody& body) {
    return other.name == body.name && &other.shape.body() == &body.shape.body() &&
           &other.motion.trajectory() == &body.motion.trajectory();
}

} // namespace

void prepare(const Body& body) {
    (void)body.normal_cones();
    (void)body.faces_around(0);
}

double Distances::safe_level(double distance) const {
    return distance >= reach ? margin : std::min(distance, margin) / 2;
}

double Distances::time_at_margin(const FirstContact& found, double level) const {
    const double time = found.clear_until;
    if (found.contacts.empty() || !(found.contacts.front().approach_speed > 0))
        return time;
    const double back = (margin - level) / found.contacts.front().approach_speed;
    return back < time ? time - back : time;
}

bool Surroundings::is_unchanged(const Scene& scene, std::size_t dragged) const {
    const auto is_as_before = [&](const Other& other) {
        return other.index < scene.bodies().size() && is_same(other, scene.bodies()[other.index]) &&
               other.is_ignored == scene.is_ignored(other.index, dragged);
    };
    return others_.size() + 1 == scene.bodies().size() && std::ranges::all_of(others_, is_as_before);
}

std::optional<std::vector<std::size_t>> Surroundings::refresh(const Scene& scene, std::size_t dragged) {
    if (is_unchanged(scene, dragged))
        return std::nullopt;
    std::vector<Other> now;
    std::vector<std::size_t> moved;
    for (std::size_t i = 0; i < scene.bodies().size(); ++i) {
        if (i == dragged)
            continue;
        const SceneBody& body = scene.bodies()[i];
        const auto before = std::ranges::find(others_, body.name, &Other::name);
        if (before != others_.end() && !is_same(*before, body))
            moved.push_back(now.size());
        now.push_back(placed(scene, i, dragged));
        if (before != others_.end() && &before->shape.body() == &body.shape.body())
            now.back().neighbours = std::move(before->neighbours);
    }
    others_ = std::move(now);
    return moved;
}

Neighbourhood Surroundings::near(const Body& body, const Pose& pose) {
    Neighbourhood found;
    const Eigen::Vector3d centre = pose.isometry() * body.bvh().centre();
    const double radius = distances_.reach + body.ball_radius() + ball_rounding * centre.norm();
    for (Other& other : others_) {
        found.distances.push_back(distances_.reach);
        if (other.is_ignored || (centre - other.centre).norm() > radius + other.radius)
            continue;
        const PlacedBody there{other.shape.body(), other.pose};
        if (!other.neighbours)
            other.neighbours = std::make_unique<memory::NeighbourList>(body, there.body);
        const NearContacts near = near_contacts({body, pose}, there, distances_.reach, *other.neighbours);
        found.work += near.work;
        found.distances.back() = near.distance;
        for (const Contact& contact : near.contacts)
            found.contacts.push_back(modelled(contact, other.index, {body, there.body, pose, there.pose}));
        if (near.overlaps || near.distance <= least_distance * distances_.margin)
            found.touching.push_back(other.index);
    }
    return found;
}

Passage Surroundings::passage(const Body& body, const Pose& start, const Pose& goal,
                              const std::vector<double>& at_start) const {
    const Eigen::Vector3d& middle = body.bvh().centre();
    const motion::PathBall path =
        Motion::screw(start, goal).trajectory().ball_around_path({middle.x(), middle.y(), middle.z()});
    const Eigen::Vector3d centre(path.centre.x, path.centre.y, path.centre.z);
    const double radius = path.radius + body.ball_radius() + ball_rounding * path.size;
    Passage passage;
    passage.clearance = distances_.margin;
    for (std::size_t i = 0; i < others_.size(); ++i) {
        const Other& other = others_[i];
        const double level = distances_.safe_level(at_start[i]);
        if (other.is_ignored || (centre - other.centre).norm() > level + radius + other.radius)
            continue;
        passage.clearance = std::min(passage.clearance, level);
        const Motion relative = ScrewMotion::relative(start, goal, other.pose, other.pose);
        const FirstContact found = query::answer({body,
                                                  other.shape.body(),
                                                  relative.trajectory(),
                                                  {.margin = level},
                                                  passage.until,
                                                  other.neighbours ? *other.neighbours : search::no_memory()});
        passage.work += found.work;
        if (found.verdict == Verdict::clear || found.clear_until >= passage.until)
            continue;
        passage.until = distances_.time_at_margin(found, level);
        passage.blocked_by = other.index;
    }
    return passage;
}

} // namespace chasles::manipulation
