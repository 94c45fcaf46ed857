// The corners of two faces that may touch the plane of the other face in an interval of time.
// The face culler uses them before any feature test.
// Source: docs/derivations/13-face-sides.md.
#pragma once

#include "chasles/culling/chord_plane.h"
#include "chasles/culling/face_separation.h"
#include "chasles/elementary/face_sides.h"

#include <algorithm>
#include <limits>

namespace chasles::culling {

/// The proven sides of the corners of one face on the plane of the other face.
class CornerSides {
public:
    /// `side_of(corner)` is 1 or -1 where a corner is proven to stay on that side, otherwise 0. The sides are stored in
    /// `storage`, which is reused.
    template <class SideOf>
    CornerSides(std::span<const std::uint32_t> corners, std::vector<int>& storage, SideOf side_of)
        : corners_(corners), sides_(storage) {
        sides_.clear();
        sides_.reserve(8);
        for (const std::uint32_t corner : corners_)
            sides_.push_back(side_of(corner));
    }

    /// Whether all corners are proven to stay on one side.
    [[nodiscard]] bool all_on_one_side() const {
        return sides_[0] != 0 && std::all_of(sides_.begin(), sides_.end(), [&](int side) { return side == sides_[0]; });
    }
    /// Whether corners are proven to stay on both sides.
    [[nodiscard]] bool some_on_each_side() const {
        return std::find(sides_.begin(), sides_.end(), 1) != sides_.end() &&
               std::find(sides_.begin(), sides_.end(), -1) != sides_.end();
    }
    /// Whether the corner may touch the plane.
    [[nodiscard]] bool may_meet(std::uint32_t vertex) const { return side(vertex) == 0; }
    /// Whether a point of the edge may touch the plane.
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

/// The planes of the last tested faces. Consecutive pairs of faces often share a face.
class FacePlanes {
public:
    /// Keeps the bodies by reference. Points within `margin` of a plane count as touching the plane.
    FacePlanes(const Body& moving, const Body& fixed, double margin)
        : moving_(moving), fixed_(fixed), margin_(margin), separation_(moving, fixed) {}

    /// Sets the maps of an interval, kept by reference, and the bound of their errors.
    void use(const motion::ControlMaps<double>& maps, const elementary::ErrorScale& scale) {
        maps_ = &maps;
        scale_ = scale;
        in_moving_ = elementary::in_moving_frame(scale, maps);
        for (LastPlane* const last : {&of_moving_, &of_fixed_})
            last->plane.face = last->chord.face = no_face;
        ends_ = IntervalEnds(maps);
        if (margin_ > 0)
            separation_.use(ends_);
    }
    [[nodiscard]] bool have_margin() const { return margin_ > 0; }
    using Restriction = algebra::Restriction<3, double>; ///< to a part of the interval

    /// The window without its beginning in which the faces are proven apart, where every corner moves on a chord over
    /// the interval; empty if they are all along. Points that touch leave their chords by at most `deviation`.
    Window without_apart_on_chords(std::uint32_t moving_face, std::uint32_t fixed_face, const Window& when,
                                   double deviation) {
        return margin_ > 0 ? without_separated(moving_face, fixed_face, when, deviation)
                           : without_apart_by_planes(moving_face, fixed_face, when, deviation);
    }

    /// The sides of a moving face's corners on the plane of a fixed face. Valid until the next call.
    CornerSides sides_of_moving(std::uint32_t moving_face, std::uint32_t fixed_face, const Restriction& part) {
        of_fixed_.plane.update(fixed_face, [&] {
            const auto& shape = of_fixed_.shape.shape_of(fixed_, fixed_face);
            return elementary::plane_of_fixed_face(*maps_, shape, scale_, offset_of(shape));
        });
        return sides_of(moving_, moving_face, of_fixed_, part);
    }
    /// The sides of a fixed face's corners on the plane of a moving face. Valid until the next call.
    CornerSides sides_of_fixed(std::uint32_t moving_face, std::uint32_t fixed_face, const Restriction& part) {
        of_moving_.plane.update(moving_face, [&] {
            const auto& shape = of_moving_.shape.shape_of(moving_, moving_face);
            return elementary::plane_of_moving_face(*maps_, shape, in_moving_, offset_of(shape));
        });
        return sides_of(fixed_, fixed_face, of_moving_, part);
    }

private:
    /// Without a margin, by the plane of one face.
    Window without_apart_by_planes(std::uint32_t moving_face, std::uint32_t fixed_face, const Window& when,
                                   double deviation) {
        const ChordPlane& of_fixed = of_fixed_.chord.update(fixed_face, [&] {
            const auto& shape = of_fixed_.shape.shape_of(fixed_, fixed_face);
            return seen_by_moving(shape.normal, shape.offset, band_of(shape, deviation));
        });
        const Window left = of_fixed.without_apart(moving_, moving_face, when);
        if (left.is_empty())
            return left;
        const ChordPlane& of_moving = of_moving_.chord.update(moving_face, [&] {
            const auto& shape = of_moving_.shape.shape_of(moving_, moving_face);
            const auto seen = [&](const MatrixPose& pose) {
                const Vector3<double> normal = pose.rotation * shape.normal;
                return SeenPlane{normal, 0 - dot(pose.translation, normal) - shape.offset};
            };
            return ChordPlane(seen(ends_.start), seen(ends_.end), band_of(shape, deviation));
        });
        return of_moving.without_apart(fixed_, fixed_face, left);
    }

    /// With a margin, by a direction between the faces at the beginning of the window, and again where this makes the
    /// window begin much later.
    Window without_separated(std::uint32_t moving_face, std::uint32_t fixed_face, Window when, double deviation) {
        constexpr int most_directions = 4;
        constexpr float much = 0.25F; // of the window
        for (int i = 0; i < most_directions; ++i) {
            const auto direction = separation_.direction(moving_face, fixed_face, when.lower, margin_);
            if (!direction)
                break;
            const auto half_space = half_space_at(fixed_face, *direction);
            const ChordPlane plane = seen_by_moving(half_space.normal, half_space.offset + offset_of(half_space),
                                                    band_of(half_space, deviation));
            const Window left = plane.without_above(moving_, moving_face, when);
            const bool is_much = left.lower - when.lower > much * (when.upper - when.lower);
            when = left;
            if (left.is_empty() || !is_much)
                break;
        }
        return when;
    }

    /// A plane of the fixed body on chords of the moving body.
    [[nodiscard]] ChordPlane seen_by_moving(const Vector3<double>& normal, double offset, double band) const {
        const auto seen = [&](const MatrixPose& pose) {
            return SeenPlane{pose.rotation.transposed() * normal, dot(pose.translation, normal) - offset};
        };
        return {seen(ends_.start), seen(ends_.end), band};
    }

    /// The plane that supports a fixed face along a direction.
    [[nodiscard]] elementary::FaceShape<double> half_space_at(std::uint32_t fixed_face,
                                                              const Vector3<double>& direction) const {
        elementary::FaceShape<double> plane;
        plane.normal = direction;
        plane.size = norm1(direction);
        plane.offset = -std::numeric_limits<double>::infinity();
        for (const std::uint32_t corner : fixed_.face(fixed_face))
            plane.offset = std::max(plane.offset, dot(direction, point_of<double>(fixed_, corner)));
        return plane;
    }

    static constexpr std::uint32_t no_face = 0xffffffff;

    /// The margin as an offset of the plane: margin * |normal|.
    [[nodiscard]] double offset_of(const elementary::FaceShape<double>& face) const {
        return margin_ > 0 ? margin_ * length(face.normal) : 0;
    }

    /// What was made of the last requested face.
    template <class Plane>
    struct OfLastFace {
        std::uint32_t face = no_face;
        Plane plane;

        /// Makes it if the requested face is another one.
        template <class Make>
        const Plane& update(std::uint32_t requested, Make make) {
            if (requested != face)
                plane = make();
            face = requested;
            return plane;
        }
    };

    /// The plane of the last requested face, in both forms.
    struct LastPlane {
        CachedFace<double> shape;
        OfLastFace<ChordPlane> chord;
        OfLastFace<elementary::RelativePlane<double>> plane;
        std::vector<int> sides; ///< of the corners of the other face
    };

    /// How far from a face's plane points must be on their chords to be proven off the face.
    [[nodiscard]] double band_of(const elementary::FaceShape<double>& face, double deviation) const {
        const double rounding = elementary::position_error<double>(scale_) * face.size;
        return elementary::with_underflow<double>(rounding + face.deviation + deviation * length(face.normal));
    }

    static CornerSides sides_of(const Body& body, std::uint32_t face, LastPlane& plane, const Restriction& part) {
        const elementary::RelativePlane<double>& relative = plane.plane.plane;
        const auto band = part(relative.band);
        return {body.face(face), plane.sides, [&, band](std::uint32_t corner) {
                    return relative.side_of(point_of<double>(body, corner), part, band);
                }};
    }

    const Body& moving_;
    const Body& fixed_;
    elementary::ErrorScale scale_;
    elementary::ErrorScale in_moving_; ///< in the frame of the moving body
    double margin_;
    const motion::ControlMaps<double>* maps_ = nullptr;
    IntervalEnds ends_;
    FaceSeparation separation_;
    LastPlane of_moving_;
    LastPlane of_fixed_;
};

} // namespace chasles::culling
