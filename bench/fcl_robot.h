// A robot and its world in FCL, for discrete tests of single configurations.
#pragma once

#include "bench/fcl_model.h"
#include "chasles/robot/robot.h"
#include "tests/support/plain_kinematics.h"

#include <algorithm>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace chasles::bench {

/// The world must stand still. Pairs that the robot does not test are not tested here, too.
class FclRobot {
public:
    using Poses = std::vector<Eigen::Isometry3d>; ///< of all shapes of the robot

    FclRobot(const Robot& robot, const Scene& world) : robot_(robot) {
        const auto& links = robot.description().links;
        for (const LinkDescription& link : links)
            for (const CollisionDescription& shape : link.collisions)
                shapes_.push_back({&link - links.data(), shape.origin.isometry(), object_of(shape.shape)});
        for (const SceneBody& body : world.bodies()) {
            obstacles_.push_back(object_of(body.shape));
            obstacles_.back()->setTransform(body.motion.pose_at(0).isometry());
            obstacles_.back()->computeAABB();
        }
        for (std::size_t i = 0; i < shapes_.size(); ++i)
            for (std::size_t j = i + 1; j < shapes_.size(); ++j)
                if (shapes_[i].link != shapes_[j].link &&
                    robot.is_tested(links[std::size_t(shapes_[i].link)].name, links[std::size_t(shapes_[j].link)].name))
                    pairs_.emplace_back(i, j);
    }

    /// By Eigen alone.
    [[nodiscard]] Poses poses(const Configuration& configuration) const {
        const auto& links = robot_.description().links;
        const test::PlainKinematics kinematics(robot_, configuration);
        std::vector<Eigen::Isometry3d> of_links;
        for (const LinkDescription& link : links)
            of_links.push_back(robot_.base().isometry() * kinematics.pose(link.name));
        Poses poses;
        for (const Shape& shape : shapes_)
            poses.push_back(of_links[std::size_t(shape.link)] * shape.origin);
        return poses;
    }

    bool collides(const Poses& poses) {
        place(poses);
        for (const Shape& shape : shapes_)
            for (const auto& obstacle : obstacles_)
                if (overlap(*shape.object, *obstacle))
                    return true;
        for (const auto& [i, j] : pairs_)
            if (overlap(*shapes_[i].object, *shapes_[j].object))
                return true;
        return false;
    }
    bool collides(const Configuration& configuration) { return collides(poses(configuration)); }

    /// The least distance of all pairs. Those whose boxes are farther apart than the nearest pair so far are left out.
    double distance(const Poses& poses) {
        place(poses);
        double least = std::numeric_limits<double>::max();
        for (const Shape& shape : shapes_)
            for (const auto& obstacle : obstacles_)
                least = std::min(least, distance(*shape.object, *obstacle, least));
        for (const auto& [i, j] : pairs_)
            least = std::min(least, distance(*shapes_[i].object, *shapes_[j].object, least));
        return least;
    }

private:
    using Object = std::unique_ptr<fcl::CollisionObjectd>;
    struct Shape {
        std::ptrdiff_t link;
        Eigen::Isometry3d origin;
        Object object;
    };

    /// Spheres and capsules are points and segments along z with a radius.
    static std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Polyhedron& shape) {
        const auto ends = shape.vertices();
        if (shape.radius() > 0 && ends.size() == 1)
            return std::make_shared<fcl::Sphered>(shape.radius());
        if (shape.radius() > 0 && ends.size() == 2)
            return std::make_shared<fcl::Capsuled>(shape.radius(), (ends[1] - ends[0]).norm());
        return fcl_model_of(shape);
    }
    Object object_of(const Polyhedron& shape) {
        auto& model = models_[&shape.body()];
        if (!model)
            model = geometry_of(shape);
        return std::make_unique<fcl::CollisionObjectd>(model);
    }
    void place(const Poses& poses) {
        for (std::size_t i = 0; i < shapes_.size(); ++i) {
            shapes_[i].object->setTransform(poses[i]);
            shapes_[i].object->computeAABB();
        }
    }
    static double distance(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b, double least) {
        if (a.getAABB().distance(b.getAABB()) >= least)
            return least;
        fcl::DistanceResultd result(least);
        return fcl::distance(&a, &b, fcl::DistanceRequestd(), result);
    }
    static bool overlap(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b) {
        if (!a.getAABB().overlap(b.getAABB()))
            return false;
        fcl::CollisionResultd result;
        return fcl::collide(&a, &b, fcl::CollisionRequestd(), result) > 0;
    }

    const Robot& robot_;
    std::map<const Body*, std::shared_ptr<fcl::CollisionGeometryd>> models_;
    std::vector<Shape> shapes_;
    std::vector<Object> obstacles_;
    std::vector<std::pair<std::size_t, std::size_t>> pairs_;
};

} // namespace chasles::bench
