// A body as FCL's mesh.
#pragma once

#include "bench/bodies.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <memory>

namespace chasles::bench {

template <class BoundingVolume = fcl::OBBRSSd>
std::shared_ptr<fcl::BVHModel<BoundingVolume>> fcl_model_of(const Polyhedron& body) {
    std::vector<fcl::Triangle> triangles;
    for (const auto& [a, b, c] : triangles_of(body))
        triangles.emplace_back(a, b, c);
    const std::vector<fcl::Vector3d> vertices(body.vertices().begin(), body.vertices().end());
    auto model = std::make_shared<fcl::BVHModel<BoundingVolume>>();
    model->beginModel(int(triangles.size()), int(vertices.size()));
    model->addSubModel(vertices, triangles);
    model->endModel();
    return model;
}

} // namespace chasles::bench
