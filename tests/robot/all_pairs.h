// All pairs of a robot and a scene, each by itself along a product of public motions.
#pragma once

#include "tests/robot/random_robot.h"
#include "tests/support/turn_to.h"

namespace chasles::test {

/// The motion of a link along a straight edge, as a product of hinges and polynomials.
class PlainMotions {
public:
    PlainMotions(const Robot& robot, const Configuration& start, const Configuration& goal)
        : robot_(robot), start_(start), goal_(goal) {}

    [[nodiscard]] Motion of(const std::string& link) const {
        for (const JointDescription& joint : robot_.description().joints)
            if (joint.child == link)
                return of(joint.parent) * Motion::at_rest(joint.origin) * moved(joint);
        return Motion::at_rest(robot_.base());
    }

private:
    struct Line {
        double from, way;
    };
    [[nodiscard]] Line line(const std::string& variable) const {
        const std::size_t index = robot_.variable(variable);
        const auto i = Eigen::Index(index);
        double way = goal_[i] - start_[i];
        if (robot_.variables()[index].is_continuous)
            way = std::remainder(way, 2 * std::numbers::pi);
        return {start_[i], way};
    }
    [[nodiscard]] Line line(const JointDescription& joint) const {
        if (!joint.mimic)
            return line(joint.name);
        const auto& joints = robot_.description().joints;
        const Line other = line(*std::ranges::find(joints, joint.mimic->joint, &JointDescription::name));
        return {joint.mimic->multiplier * other.from + joint.mimic->offset, joint.mimic->multiplier * other.way};
    }
    [[nodiscard]] Motion moved(const JointDescription& joint) const {
        const Eigen::Vector3d axis = joint.axis.normalized();
        switch (joint.type) {
        case JointType::fixed:
            return Motion::at_rest(Pose());
        case JointType::prismatic:
            return Motion::polynomial({line(joint).from * axis, line(joint).way * axis});
        case JointType::planar: {
            const Eigen::Quaterniond plane = turn_to(Eigen::Vector3d::UnitZ(), axis);
            const Line x = line(joint.name + "/x"), y = line(joint.name + "/y"), theta = line(joint.name + "/theta");
            return Motion::polynomial(
                       {plane * Eigen::Vector3d(x.from, y.from, 0), plane * Eigen::Vector3d(x.way, y.way, 0)}) *
                   Motion::hinge(Eigen::Vector3d::Zero(), axis, {theta.from, theta.way});
        }
        case JointType::floating: {
            const auto pose = [&](const Configuration& values) {
                const auto part = [&](const char* suffix) {
                    return values[Eigen::Index(robot_.variable(joint.name + suffix))];
                };
                return Pose({part("/trans_x"), part("/trans_y"), part("/trans_z")},
                            {part("/rot_w"), part("/rot_x"), part("/rot_y"), part("/rot_z")});
            };
            return Motion::velocity(pose(start_), pose(goal_));
        }
        default:
            return Motion::hinge(Eigen::Vector3d::Zero(), axis, {line(joint).from, line(joint).way});
        }
    }

    const Robot& robot_;
    const Configuration& start_;
    const Configuration& goal_;
};

/// Calls `use` with both shapes and the motion for each pair that is tested, of the robot and of the scene.
template <class Use>
void for_each_pair(const Robot& robot, const Scene& scene, const std::array<Configuration, 2>& ends, const Use& use) {
    const PlainMotions motions(robot, ends[0], ends[1]);
    const auto& links = robot.description().links;
    for (const LinkDescription& a : links)
        for (const CollisionDescription& shape : a.collisions) {
            const Motion motion = motions.of(a.name) * Motion::at_rest(shape.origin);
            for (const SceneBody& body : scene.bodies())
                use(shape.shape, body.shape, relative(motion, body.motion));
            for (const LinkDescription& b : links) {
                if (&b <= &a || !robot.is_tested(a.name, b.name))
                    continue;
                for (const CollisionDescription& other : b.collisions)
                    use(shape.shape, other.shape, relative(motion, motions.of(b.name) * Motion::at_rest(other.origin)));
            }
        }
}

inline Scene random_world(Random& random, int count) {
    Scene scene;
    std::mt19937 shapes(unsigned(random.integer(0, 1 << 30)));
    for (int i = 0; i < count; ++i) {
        const Pose start = random_pose(random, 4);
        scene.add(
            {"body " + std::to_string(i), random_octahedron(shapes).polyhedron(),
             random.chance(0.1) ? Motion::velocity(start, random_goal(random, start, 1, 2)) : Motion::at_rest(start)});
    }
    return scene;
}

} // namespace chasles::test
