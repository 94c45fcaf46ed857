// What a checker keeps of a robot and a scene. Source: docs/derivations/29-robots.md, "Pairs".
#pragma once

#include "chasles/robot/model.h"
#include "chasles/scene/box_pairs.h"
#include "chasles/scene/pair_question.h"

#include <Eigen/Geometry>
#include <optional>
#include <set>
#include <utility>

namespace chasles {

namespace robot {

/// An element of the robot and another one, or an obstacle or a mover of the scene, during a part of a segment.
struct Task {
    enum class Kind : std::uint8_t { self, obstacle, mover };
    Kind kind = Kind::self;
    std::size_t first = 0;  ///< an element; of a self pair the index of the pair
    std::size_t second = 0; ///< an index in `obstacles` or in `movers`
    Bracket part;           ///< of the segment
};

} // namespace robot

/// A robot and a scene as they were when the checker was made.
struct RobotChecker::Prepared {
    /// A body of the scene that stands still.
    struct Obstacle {
        std::size_t body = 0; ///< its index in `bodies`
        motion::FixedPose pose;
        scene::Box box;         ///< in the world
        Eigen::Vector3d centre; ///< of a ball around it, in the world
        double radius = 0;
        double size = 0; ///< the sum of the sizes of all lengths
    };
    /// A shape of the robot, in the frame of its group.
    struct Extent {
        motion::GeneralPose<double> place;
        Eigen::Vector3d centre; ///< of the box and of the ball around it
        Eigen::Vector3d half;   ///< of the box, which is aligned with the frame of the shape
        double radius = 0;      ///< of the ball around `centre`
        double size = 0;        ///< the sum of the sizes of all lengths
    };
    /// Two elements that are tested against each other.
    struct SelfPair {
        std::size_t moving = 0;
        std::size_t fixed = 0;
        double margin = 0;
    };

    Prepared(const Robot& given, const Scene* scene, const RobotQuery& query);
    /// The same world and question, for a robot with the same links and parts in other places.
    Prepared(const Prepared& other, const robot::Model& changed);

    [[nodiscard]] const robot::Model& model() const { return robot.model(); }
    void prepare_robot();
    void add_self_pairs();
    void require_own_names() const;
    void add_scene(const Scene& scene);
    /// The question about a task: with its margin, and with `hold` if that is less.
    [[nodiscard]] QueryOptions options_of(const robot::Task& task) const;
    void make_tree();
    [[nodiscard]] bool is_ignored(std::size_t element, std::size_t body) const {
        return ignored.contains({model().elements[element].owner, body});
    }
    [[nodiscard]] const robot::Element& moving(const robot::Task& task) const {
        return model().elements[moving_index(task)];
    }
    [[nodiscard]] std::size_t moving_index(const robot::Task& task) const {
        return task.kind == robot::Task::Kind::self ? self_pairs[task.first].moving : task.first;
    }
    [[nodiscard]] const Polyhedron& fixed_shape(const robot::Task& task) const {
        return task.kind == robot::Task::Kind::self ? model().elements[self_pairs[task.first].fixed].shape
                                                    : bodies[body_of(task)].shape;
    }
    /// The body of the scene that a task is about.
    [[nodiscard]] std::size_t body_of(const robot::Task& task) const {
        return task.kind == robot::Task::Kind::mover ? movers[task.second] : obstacles[task.second].body;
    }

    Robot robot;
    QueryOptions options;
    std::vector<SceneBody> bodies; ///< of the scene
    std::vector<std::shared_ptr<const scene::WorldMotion>> motions;
    std::vector<Obstacle> obstacles;                       ///< that stand still
    std::vector<std::size_t> movers;                       ///< bodies that move
    std::set<std::pair<std::size_t, std::size_t>> ignored; ///< owners of elements, and bodies
    std::optional<scene::BoxTree> tree;                    ///< over the obstacles, if they are many
    std::vector<Extent> extents;                           ///< of each element
    std::vector<SelfPair> self_pairs;
    std::shared_ptr<const UntestedPairs> untested; ///< shared by all answers
};

namespace robot {

/// What the checker does not look at.
UntestedPairs untested_pairs(const RobotChecker::Prepared& prepared);

/// The pairs that boxes and large nodes do not prove apart during a segment, in order of time. They come within their
/// margins, or within the distance that is given in the place of all margins.
std::vector<Task> near_tasks(const RobotChecker::Prepared& prepared, const SegmentMotion& motion,
                             std::optional<double> distance = {});

} // namespace robot

} // namespace chasles
