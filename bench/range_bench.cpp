// Ranges of pairs of joints of robots among boxes, and what samples say of them: the time until 1 % is open, and
// whether FCL, or our own checker at rest, refutes a proven box. The robots are those of the folder robots of real
// inputs, the arm of examples/robot, and a gantry.
#include "bench/draw.h"
#include "bench/fcl_robot.h"
#include "chasles/mesh/primitives.h"
#include "chasles/robot/range.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace chasles;
using namespace chasles::bench;

struct NamedRobot {
    std::string name;
    Robot robot;
    double reach; ///< boxes lie within this distance, mesh unit
};

/// Three slides with a box each, and a wrist.
Robot gantry() {
    RobotDescription robot{"gantry"};
    const auto at = [](double x, double y, double z) {
        Pose pose;
        pose.translation = {x, y, z};
        return pose;
    };
    robot.links = {{"frame"},
                   {"bridge", {{make_box({0.1, 2, 0.1}), at(0, 0, 1)}}},
                   {"carriage", {{make_box({0.2, 0.2, 0.2}), at(0.2, 0, 1.2)}}},
                   {"quill", {{make_box({0.08, 0.08, 0.8}), at(0.2, 0, 0.7)}}},
                   {"tool", {{make_box({0.4, 0.1, 0.1}), at(0.1, 0, -0.05)}}}};
    const auto joint = [&](const char* name, JointType type, const char* parent, const char* child,
                           const Eigen::Vector3d& axis, double range) {
        JointDescription made{name, type, parent, child};
        made.axis = axis;
        made.lower = -range;
        made.upper = range;
        robot.joints.push_back(made);
    };
    joint("x", JointType::prismatic, "frame", "bridge", Eigen::Vector3d::UnitX(), 0.8);
    joint("y", JointType::prismatic, "bridge", "carriage", Eigen::Vector3d::UnitY(), 0.8);
    joint("z", JointType::prismatic, "carriage", "quill", Eigen::Vector3d::UnitZ(), 0.3);
    joint("turn", JointType::revolute, "quill", "tool", Eigen::Vector3d::UnitZ(), 3);
    robot.joints.back().origin = at(0.2, 0, 0.25);
    return Robot(robot);
}

/// The neutral configuration if the robot touches nothing there, otherwise a random one.
Configuration free_configuration(Draw& draw, const Robot& robot) {
    const RobotChecker checker(robot);
    Configuration found = robot.neutral();
    while (!checker.is_clear(found))
        for (std::size_t i = 0; i < robot.variables().size(); ++i)
            found[Eigen::Index(i)] =
                draw.between(std::max(robot.variables()[i].lower, -3.0), std::min(robot.variables()[i].upper, 3.0));
    return found;
}

/// Pairs that touch at the start are by design.
Robot without_contacts_at_start(Robot robot) {
    while (true) {
        const RobotAnswer found = RobotChecker(robot).first_contact(robot.neutral(), robot.neutral());
        if (found.verdict == Verdict::clear)
            return robot;
        robot.ignore(found.pair->first, found.pair->second);
    }
}

std::vector<NamedRobot> robots() {
    std::vector<NamedRobot> all{{"gantry", without_contacts_at_start(gantry()), 1.2}};
    const std::filesystem::path data = std::filesystem::path(CHASLES_DATA_DIR) / "robots";
    const std::filesystem::path arm = std::filesystem::path(CHASLES_SOURCE_DIR) / "examples/robot/arm.urdf";
    all.push_back({"arm", without_contacts_at_start(Robot::load(arm)), 1});
    if (!std::filesystem::exists(data)) {
        std::printf("skipped: no folder robots of real inputs\n");
        return all;
    }
    all.push_back({"panda", Robot::load(data / "panda/panda.urdf", {.srdf = data / "panda/panda.srdf"}), 1});
    all.push_back({"irb2400",
                   Robot::load(data / "abb_irb2400/abb_irb2400.urdf", {.srdf = data / "abb_irb2400/abb_irb2400.srdf"}),
                   2});
    all.push_back({"laikago", without_contacts_at_start(Robot::load(data / "laikago/urdf/laikago.urdf")), 0.6});
    return all;
}

/// Boxes that the robot does not touch in a configuration.
Scene boxes_around(Draw& draw, const NamedRobot& named, const Configuration& free, std::size_t count) {
    Scene scene;
    while (scene.bodies().size() < count) {
        Scene next = scene;
        const auto side = [&] { return named.reach * draw.between(0.05, 0.25); };
        const Eigen::Vector3d at = draw.direction() * named.reach * draw.between(0.4, 1);
        const Polyhedron box = make_box({side(), side(), side()});
        next.add({"box " + std::to_string(scene.bodies().size()), box, Motion::at_rest(Pose(at, draw.turn(0, 3)))});
        if (RobotChecker(named.robot, &next).is_clear(free))
            scene = next;
    }
    return scene;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Configuration sample(Draw& draw, const std::vector<ConfigurationBox>& boxes) {
    const ConfigurationBox& box = boxes[std::size_t(draw.between(0, double(boxes.size()))) % boxes.size()];
    Configuration q = box.lower;
    for (Eigen::Index i = 0; i < q.size(); ++i)
        q[i] = draw.between(box.lower[i], box.upper[i]);
    return q;
}

struct Refuted {
    std::size_t samples = 0;
    std::size_t by_fcl = 0;
    std::size_t by_checker = 0;
};

/// Of configurations in boxes that are proven clear, those that touch; or the other way round.
Refuted refuted(Draw& draw, const RobotChecker& checker, FclRobot& peer, const std::vector<ConfigurationBox>& boxes,
                std::size_t count, bool are_clear) {
    Refuted found;
    for (std::size_t i = 0; i < count && !boxes.empty(); ++i, ++found.samples) {
        const Configuration q = sample(draw, boxes);
        found.by_checker += checker.is_clear(q) != are_clear ? 1 : 0;
        found.by_fcl += are_clear && peer.collides(q) ? 1 : 0; // FCL's bodies are surfaces: it misses nested ones
    }
    return found;
}

void examine(Draw& draw, const NamedRobot& named, std::size_t count_of_boxes, std::span<const std::string> joints,
             std::size_t samples) {
    const Robot& robot = named.robot;
    const Configuration free = free_configuration(draw, robot);
    const Scene scene = boxes_around(draw, named, free, count_of_boxes);
    const RobotChecker checker(robot, &scene);
    const ConfigurationBox box = box_of_joints(robot, joints, free);
    const auto start = std::chrono::steady_clock::now();
    const RobotRange found = checker.range(box, {.tolerance = 0.01, .seconds = 10, .most_cells = 100'000'000});
    const double seconds = seconds_since(start);
    FclRobot peer(robot, scene);
    const Refuted clear = refuted(draw, checker, peer, found.clear, samples, true);
    const Refuted contact = refuted(draw, checker, peer, found.contact, samples / 10, false);
    const bool is_witness_free = found.witness && checker.is_clear(*found.witness);
    std::printf(
        "%-8s %-28s %6.2f s %7zu cells  clear %6.2f %% contact %6.2f %% open %6.2f %%  %5zu boxes  refuted %zu + "
        "%zu of %zu clear, %zu of %zu in contact%s\n",
        named.name.c_str(), (joints[0] + ", " + joints[1]).c_str(), seconds, found.cells, 100 * found.clear_share,
        100 * found.contact_share, 100 * found.open_share, found.clear.size(), clear.by_fcl, clear.by_checker,
        clear.samples, contact.by_checker, contact.samples, is_witness_free ? "  WITNESS IS CLEAR" : "");
    std::fflush(stdout);
}

} // namespace

/// The argument is the number of samples in clear boxes of each pair of joints; 2000 are 100,000 in all.
int main(int count, char** arguments) {
    const std::size_t samples = count > 1 ? std::size_t(std::atol(arguments[1])) : 2000;
    Draw draw(40);
    for (const NamedRobot& named : robots()) {
        if (named.name == "panda") {
            const std::vector<std::string> first{named.robot.variables()[0].name, named.robot.variables()[1].name};
            for (int i = 0; i < 3; ++i)
                examine(draw, named, 20, first, samples);
        }
        const std::size_t variables = named.robot.variables().size();
        for (int i = 0; i < 10; ++i) {
            const std::size_t a = std::size_t(draw.between(0, double(variables))) % variables;
            const std::size_t b =
                (a + 1 + std::size_t(draw.between(0, double(variables - 1))) % (variables - 1)) % variables;
            const std::vector<std::string> joints{named.robot.variables()[a].name, named.robot.variables()[b].name};
            examine(draw, named, 10, joints, samples);
        }
    }
}
