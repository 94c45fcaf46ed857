// Whether a vertex that moves into a body leaves it on the other side.
// Source: docs/derivations/38-radius.md, "Below zero".
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/mesh/connected_parts.h"

#include <Eigen/Core>
#include <optional>

namespace chasles {

/// Looks for faces on the straight ways of the vertices of a body.
class WayOut {
public:
    WayOut(const Body& body, double flat);

    /// A face, of the same connected part of the surface and not around the vertex, through which the way leads along
    /// its normal.
    [[nodiscard]] std::optional<std::uint32_t> face_on_way(std::uint32_t vertex, const Eigen::Vector3d& to);

private:
    [[nodiscard]] bool leads_through(std::uint32_t face, const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

    const Body& body_;
    double flat_;
    ConnectedParts parts_;
};

} // namespace chasles
