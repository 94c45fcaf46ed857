// Which corners of two faces may come to each other's planes in an interval of time: what is asked before any of their
// features.
// Source: docs/derivations/13-face-sides.md.
#pragma once

#include "chasles/culling/cached_face.h"
#include "chasles/elementary/face_sides.h"

#include <algorithm>
#include <limits>

namespace chasles::culling {

/// On which side of the other face's plane the corners of a face are proven to stay.
class CornerSides {
public:
    /// `room` holds the sides, so that nothing is allocated.
    CornerSides(const Body& body, std::uint32_t face, const elementary::RelativePlane<double>& plane,
                const algebra::Restriction<3, double>& part, std::vector<int>& room)
        : corners_(body.face(face)), sides_(room) {
        sides_.clear();
        sides_.reserve(8);
        const auto band = part(plane.band);
        for (const std::uint32_t corner : corners_)
            sides_.push_back(plane.side_of(point_of<double>(body, corner), part, band));
    }

    [[nodiscard]] bool all_on_one_side() const {
        return sides_[0] != 0 && std::all_of(sides_.begin(), sides_.end(), [&](int side) { return side == sides_[0]; });
    }
    /// Whether the corner may come to the plane.
    [[nodiscard]] bool may_meet(std::uint32_t vertex) const { return side(vertex) == 0; }
    [[nodiscard]] bool may_meet(const Edge& edge) const {
        const int from = side(edge.from);
        return from == 0 || from != side(edge.to);
    }

private:
    [[nodiscard]] int side(std::uint32_t vertex) const {
        return sides_[static_cast<std::size_t>(std::find(corners_.begin(), corners_.end(), vertex) - corners_.begin())];
    }

    std::span<const std::uint32_t> corners_;
    std::vector<int>& sides_;
};

/// The planes of the faces that were asked about last; a pair of faces often shares one with the pair before.
class FacePlanes {
public:
    /// Points within `margin` of a plane count as coming to it.
    FacePlanes(const Body& moving, const Body& fixed, const elementary::ErrorScale& scale, double margin)
        : moving_(moving), fixed_(fixed), scale_(scale), margin_(margin) {}

    /// Sets the maps of an interval, which are kept by reference.
    void use(const motion::ControlMaps<double>& maps) {
        maps_ = &maps;
        of_moving_.face = of_fixed_.face = no_face;
    }
    using Restriction = algebra::Restriction<3, double>; ///< of the interval

    /// The corners of a moving face and the plane of a fixed one. Until the next call.
    CornerSides sides_of_moving(std::uint32_t moving_face, std::uint32_t fixed_face, const Restriction& part) {
        of_fixed_.see(fixed_face, [&] {
            const auto& shape = of_fixed_.held.shape_of(fixed_, fixed_face);
            return elementary::plane_of_fixed_face(*maps_, shape, scale_, reach_of(shape));
        });
        return {moving_, moving_face, of_fixed_.plane, part, of_fixed_.sides};
    }
    /// The other way round.
    CornerSides sides_of_fixed(std::uint32_t moving_face, std::uint32_t fixed_face, const Restriction& part) {
        of_moving_.see(moving_face, [&] {
            const auto& shape = of_moving_.held.shape_of(moving_, moving_face);
            return elementary::plane_of_moving_face(*maps_, shape, scale_, reach_of(shape));
        });
        return {fixed_, fixed_face, of_moving_.plane, part, of_moving_.sides};
    }

    /// With a margin: whether the way from one face to the other at `time`, in the interval, proves that they stay
    /// farther apart than the margin.
    [[nodiscard]] bool are_separated(std::uint32_t moving_face, std::uint32_t fixed_face, const Restriction& part,
                                     double time) const {
        if (margin_ <= 0)
            return false;
        const auto path = maps_->rotation * mean_corner(moving_, moving_face) + maps_->translation;
        elementary::FaceShape<double> front;
        front.normal = elementary::position_at(path, maps_->weight, time) - mean_corner(fixed_, fixed_face);
        front.size = norm1(front.normal);
        front.offset = -std::numeric_limits<double>::infinity();
        for (const std::uint32_t corner : fixed_.face(fixed_face))
            front.offset = std::max(front.offset, dot(front.normal, point_of<double>(fixed_, corner)));
        const auto plane = elementary::plane_of_fixed_face(*maps_, front, scale_, reach_of(front));
        const auto band = part(plane.band);
        return std::ranges::all_of(moving_.face(moving_face), [&](std::uint32_t corner) {
            return plane.side_of(point_of<double>(moving_, corner), part, band) > 0;
        });
    }

private:
    static Vector3<double> mean_corner(const Body& body, std::uint32_t face) {
        Vector3<double> sum{0, 0, 0};
        for (const std::uint32_t corner : body.face(face))
            sum = sum + point_of<double>(body, corner);
        return scale(sum, 1.0 / double(body.face(face).size()));
    }

    static constexpr std::uint32_t no_face = 0xffffffff;

    [[nodiscard]] double reach_of(const elementary::FaceShape<double>& face) const {
        return margin_ > 0 ? margin_ * length(face.normal) : 0;
    }

    struct LastPlane {
        std::uint32_t face = no_face;
        CachedFace<double> held;
        elementary::RelativePlane<double> plane;
        std::vector<int> sides; ///< of the other face's corners

        template <class Make>
        void see(std::uint32_t asked, Make make) {
            if (asked != face)
                plane = make();
            face = asked;
        }
    };

    const Body& moving_;
    const Body& fixed_;
    elementary::ErrorScale scale_;
    double margin_;
    const motion::ControlMaps<double>* maps_ = nullptr;
    LastPlane of_moving_;
    LastPlane of_fixed_;
};

} // namespace chasles::culling
