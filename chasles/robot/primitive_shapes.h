// The boxes and round bodies of a URDF file.
#pragma once

#include "chasles/mesh/primitives.h"

#include <map>
#include <string>
#include <tuple>

namespace chasles::robot {

/// Makes bodies that enclose shapes, each with the bound of its distance from the shape: cylinders become polyhedra,
/// and all other shapes are exact. Files have shapes without extent, as placeholders: a body needs some, so they become
/// 1e-6 thick, in the length unit of the file.
class PrimitiveShapes {
public:
    /// The deviation of cylinders as a part of their radius.
    explicit PrimitiveShapes(double deviation) : deviation_(deviation) {}

    static EnclosingPolyhedron box(const Eigen::Vector3d& sides);
    /// `kind` is "sphere", "cylinder" or "capsule". Equal bodies share their polyhedron. Throws InvalidInput for sizes
    /// that no body has.
    const EnclosingPolyhedron& round_body(const std::string& kind, double radius, double length);

private:
    using RoundBody = std::tuple<std::string, double, double>; ///< kind, radius, length
    [[nodiscard]] EnclosingPolyhedron made(const RoundBody& given) const;

    double deviation_;
    std::map<RoundBody, EnclosingPolyhedron> round_bodies_;
};

} // namespace chasles::robot
