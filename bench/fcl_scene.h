// A scene in FCL's DynamicAABBTreeCollisionManager, for discrete samples of the same motions.
#pragma once

#include "bench/fcl_model.h"
#include "chasles/scene/pair_question.h"
#include "chasles/scene/scene.h"

#include <algorithm>
#include <deque>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision.h>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace chasles::bench {

/// Keeps the scene by reference. Pairs that the scene ignores are ignored here, too.
class FclScene {
public:
    explicit FclScene(const Scene& scene) : scene_(scene) {
        std::map<const Body*, std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>> models;
        for (const SceneBody& body : scene.bodies()) {
            auto& model = models[&body.shape.body()];
            if (!model)
                model = fcl_model_of(body.shape);
            objects_.push_back(std::make_unique<fcl::CollisionObjectd>(model));
            place(objects_.size() - 1, 0);
        }
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            objects_[i]->setUserData(&indices_.emplace_back(i));
            manager_.registerObject(objects_[i].get());
        }
        manager_.setup();
    }

    /// Whether any bodies overlap at a time.
    bool collides_at(double time) { return !overlaps_at(time, true).empty(); }
    /// All pairs of bodies that overlap at a time, the smaller index first.
    std::vector<std::pair<std::size_t, std::size_t>> overlaps_at(double time) { return overlaps_at(time, false); }
    /// The first of so many samples, evenly from the start to the goal, at which bodies overlap; 2 if none.
    double first_sample(int samples) {
        for (int i = 0; i < samples; ++i)
            if (const double time = double(i) / (samples - 1); collides_at(time))
                return time;
        return 2;
    }
    /// Whose boxes overlapped at the last of the times.
    [[nodiscard]] std::size_t pairs() const { return pairs_; }
    /// Puts two bodies to where they are at a time.
    std::pair<const fcl::CollisionObjectd*, const fcl::CollisionObjectd*> pair_at(std::size_t a, std::size_t b,
                                                                                  double time) {
        place(a, time);
        place(b, time);
        return {objects_[a].get(), objects_[b].get()};
    }

private:
    struct Visit {
        FclScene& scene;
        bool first_only;
        std::vector<std::pair<std::size_t, std::size_t>> found = {};
    };

    void place(std::size_t i, const Eigen::Isometry3d& pose) {
        objects_[i]->setTransform(pose);
        objects_[i]->computeAABB();
    }
    void place(std::size_t i, double time) { place(i, scene_.bodies()[i].motion.pose_at(time).isometry()); }
    /// Of all bodies; computed once, as no user's time for FCL is spent on our motions.
    const std::vector<Eigen::Isometry3d>& poses_at(double time) {
        std::vector<Eigen::Isometry3d>& poses = poses_[time];
        if (poses.empty())
            for (const SceneBody& body : scene_.bodies())
                poses.push_back(body.motion.pose_at(time).isometry());
        return poses;
    }
    std::vector<std::pair<std::size_t, std::size_t>> overlaps_at(double time, bool first_only) {
        const std::vector<Eigen::Isometry3d>& poses = poses_at(time);
        for (std::size_t i = 0; i < objects_.size(); ++i)
            if (!scene_.motion_of(i).rests)
                place(i, poses[i]);
        manager_.update();
        pairs_ = 0;
        Visit visit{*this, first_only};
        manager_.collide(&visit, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* given) {
            auto& v = *static_cast<Visit*>(given);
            const std::size_t i = *static_cast<std::size_t*>(a->getUserData());
            const std::size_t j = *static_cast<std::size_t*>(b->getUserData());
            if (v.scene.scene_.is_ignored(i, j))
                return false;
            ++v.scene.pairs_;
            fcl::CollisionResultd result;
            if (fcl::collide(a, b, fcl::CollisionRequestd(), result) > 0)
                v.found.push_back(std::minmax(i, j));
            return v.first_only && !v.found.empty();
        });
        return visit.found;
    }

    std::map<double, std::vector<Eigen::Isometry3d>> poses_;
    const Scene& scene_;
    std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
    std::deque<std::size_t> indices_;
    fcl::DynamicAABBTreeCollisionManagerd manager_;
    std::size_t pairs_ = 0;
};

} // namespace chasles::bench
