// The distance of two bodies by FCL.
#pragma once

#include "tests/support/triangle_tree.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>

namespace chasles::test {

/// Bodies that overlap have the distance 0 or less.
class FclDistance {
public:
    FclDistance(const Polyhedron& moving, const Polyhedron& fixed)
        : moving_(model_of(moving)), fixed_(model_of(fixed)) {}

    [[nodiscard]] double operator()(const Pose& at) const {
        fcl::DistanceResultd found;
        fcl::distance(moving_.get(), at.isometry(), fixed_.get(), fcl::Transform3d::Identity(),
                      fcl::DistanceRequestd(false, false, 0, 0), found);
        return found.min_distance;
    }

private:
    using Model = fcl::BVHModel<fcl::OBBRSSd>;

    static std::shared_ptr<const Model> model_of(const Polyhedron& body) {
        const TriangleTree tree(body);
        std::vector<fcl::Triangle> triangles;
        for (std::uint32_t i = 0; i < tree.size(); ++i)
            triangles.emplace_back(tree.corners(i)[0], tree.corners(i)[1], tree.corners(i)[2]);
        auto model = std::make_shared<Model>();
        model->beginModel(int(triangles.size()), int(body.vertex_count()));
        model->addSubModel(std::vector<fcl::Vector3d>(body.vertices().begin(), body.vertices().end()), triangles);
        model->endModel();
        return model;
    }

    std::shared_ptr<const Model> moving_;
    std::shared_ptr<const Model> fixed_;
};

} // namespace chasles::test
