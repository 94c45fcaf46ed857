// Makes a robot and a scene ready for many questions.
#include "chasles/robot/prepared.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"
#include "chasles/motion/screw_path.h"
#include "chasles/query/requirements.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace chasles {

using robot::Element;
using robot::Model;

namespace {

using Prepared = RobotChecker::Prepared;

/// More obstacles than this have a tree.
constexpr std::size_t few_obstacles = 32;

Prepared::Extent extent_of(const Element& element) {
    const MeshReport report = element.shape.report();
    Prepared::Extent extent;
    extent.place = element.place.in_double;
    extent.centre = element.shape.body().bvh().centre();
    extent.half = (report.upper - extent.centre).cwiseMax(extent.centre - report.lower);
    extent.radius = element.shape.body().ball_radius();
    extent.size = norm1(extent.place.translation) + extent.centre.lpNorm<1>() + extent.half.lpNorm<1>();
    return extent;
}

Prepared::Obstacle obstacle_of(std::size_t index, const Polyhedron& shape, const scene::WorldMotion& motion) {
    const Body& body = shape.body();
    Prepared::Obstacle obstacle;
    obstacle.body = index;
    obstacle.pose = motion::FixedPose(motion.frame->refined_at(algebra::DoubleDouble(0.0)));
    const motion::GeneralPose<double>& pose = obstacle.pose.in_double;
    const auto [x, y, z] = placed(pose, motion::vector_in<double>(body.bvh().centre()));
    obstacle.box = scene::swept({body, *motion.frame, true}, 0).box;
    obstacle.centre = {x, y, z};
    obstacle.radius = body.ball_radius();
    obstacle.size = norm1(pose.translation) + body.bvh().centre().lpNorm<1>() + obstacle.radius;
    return obstacle;
}

/// As for scenes: `hold` needs some pair with a greater margin.
void check_options(const QueryOptions& options, const Model& model) {
    double largest = options.margin;
    for (const auto& [owners, margin] : model.margins)
        largest = std::max(largest, margin);
    query::check_options(options, largest);
}

} // namespace

RobotChecker::Prepared::Prepared(const Robot& given, const Scene* scene, const RobotQuery& query)
    : robot(given), options(query.options) {
    check_options(options, model());
    prepare_robot();
    if (scene)
        add_scene(*scene);
    untested = std::make_shared<const UntestedPairs>(robot::untested_pairs(*this));
}

RobotChecker::Prepared::Prepared(const Prepared& other, const Model& changed) : Prepared(other) {
    robot = Robot(std::make_shared<const Model>(changed));
    extents.clear();
    self_pairs.clear();
    prepare_robot();
    untested = std::make_shared<const UntestedPairs>(robot::untested_pairs(*this));
}

void RobotChecker::Prepared::prepare_robot() {
    for (const Element& element : model().elements)
        extents.push_back(extent_of(element));
    add_self_pairs();
}

QueryOptions RobotChecker::Prepared::options_of(const robot::Task& task) const {
    QueryOptions of_task = options;
    if (task.kind == robot::Task::Kind::self)
        of_task.margin = self_pairs[task.first].margin;
    if (of_task.hold && *of_task.hold >= of_task.margin)
        of_task.hold.reset();
    return of_task;
}

/// The element with more joints above it moves.
void RobotChecker::Prepared::add_self_pairs() {
    const Model& m = model();
    for (std::size_t i = 0; i < m.elements.size(); ++i)
        for (std::size_t j = i + 1; j < m.elements.size(); ++j) {
            const Element &a = m.elements[i], &b = m.elements[j];
            const auto owners = std::minmax(a.owner, b.owner);
            if (!m.is_tested(owners))
                continue;
            const auto margin = m.margins.find(owners);
            const bool second_moves = m.groups[b.group].depth >= m.groups[a.group].depth;
            self_pairs.push_back({second_moves ? j : i, second_moves ? i : j,
                                  margin == m.margins.end() ? options.margin : margin->second});
        }
}

/// An answer that names a pair has to say which body or link it means.
void RobotChecker::Prepared::require_own_names() const {
    std::set<std::string_view> names;
    for (const Element& element : model().elements)
        names.insert(model().owners[element.owner].name);
    for (const SceneBody& body : bodies)
        if (names.contains(body.name))
            throw InvalidInput("scene: " + io::in_quotes(body.name) +
                               " is a body of the scene and a link or part of the robot; rename the body");
}

void RobotChecker::Prepared::add_scene(const Scene& scene) {
    bodies.assign(scene.bodies().begin(), scene.bodies().end());
    require_own_names();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        motions.push_back(std::make_shared<const scene::WorldMotion>(scene.motion_of(i)));
        const motion::MovingFrame& frame = *motions[i]->frame;
        if (motions[i]->rests && frame.is_refined())
            obstacles.push_back(obstacle_of(i, bodies[i].shape, *motions[i]));
        else
            movers.push_back(i);
    }
    for (std::size_t owner = 0; owner < model().owners.size(); ++owner)
        for (std::size_t body = 0; body < bodies.size() && !model().ignored_in_scene.empty(); ++body)
            if (model().ignored_in_scene.contains({model().owners[owner].name, bodies[body].name}))
                ignored.emplace(owner, body);
    if (obstacles.size() > few_obstacles)
        make_tree();
}

void RobotChecker::Prepared::make_tree() {
    std::vector<scene::SweptBody> boxes;
    boxes.reserve(obstacles.size());
    for (const Obstacle& obstacle : obstacles)
        boxes.push_back({obstacle.box, {}});
    tree.emplace(boxes);
}

} // namespace chasles
