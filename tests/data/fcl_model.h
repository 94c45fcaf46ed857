// A body as FCL's mesh.
#pragma once

#include "tests/support/triangle_tree.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <memory>

namespace chasles::test {

using FclModel = fcl::BVHModel<fcl::OBBRSSd>;

inline std::shared_ptr<const FclModel> fcl_model_of(const Polyhedron& body) {
    const TriangleTree tree(body);
    std::vector<fcl::Triangle> triangles;
    for (std::uint32_t i = 0; i < tree.size(); ++i)
        triangles.emplace_back(tree.corners(i)[0], tree.corners(i)[1], tree.corners(i)[2]);
    auto model = std::make_shared<FclModel>();
    model->beginModel(int(triangles.size()), int(body.vertex_count()));
    model->addSubModel(std::vector<fcl::Vector3d>(body.vertices().begin(), body.vertices().end()), triangles);
    model->endModel();
    return model;
}

} // namespace chasles::test
