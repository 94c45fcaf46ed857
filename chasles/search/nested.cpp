#include "chasles/search/nested.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/culling/cached_face.h"
#include "chasles/culling/nested_boxes.h"
#include "chasles/culling/winding.h"

namespace chasles::search {

namespace {

using algebra::DoubleDouble;
using algebra::ExactNumber;
using algebra::Matrix3;
using algebra::Vector3;
using culling::PlacedPair;
using culling::point_of;
using culling::WeightedPoint;

/// Both bodies at the start: x -> (rotation x + offset) / weight maps points of the moving body to the fixed frame, and
/// x -> (rotation^T x - inverse_offset) / weight those of the fixed body to the moving frame.
template <class S>
struct Start {
    Matrix3<S> rotation;
    Vector3<S> offset;
    Vector3<S> inverse_offset;
    S weight;
    S error; ///< of places, in the length unit

    Start(const motion::ControlMaps<S>& maps, S given_error) : weight(maps.weight[0]), error(std::move(given_error)) {
        for (int i = 0; i < 3; ++i) {
            offset[i] = maps.translation[i][0];
            inverse_offset[i] = maps.inverse_translation[i][0];
            for (int j = 0; j < 3; ++j)
                rotation.row[i][j] = maps.rotation.row[i][j][0];
        }
    }

    /// A vertex in the frame of the other body.
    [[nodiscard]] WeightedPoint<S> seen(const Body& body, bool is_moving, std::uint32_t vertex) const {
        const Vector3<S> point = point_of<S>(body, vertex);
        return {is_moving ? rotation * point + offset : rotation.transposed() * point - inverse_offset, weight, error};
    }
};

/// Maps that only enclose the true motion have its true ends. Points in the box around the moving body are within twice
/// its radius.
Start<double> start_of(const PieceContext& context) {
    const double margin = context.is_enclosed() ? context.moving().bvh().radius() : 0;
    return {context.maps(), elementary::position_error<double>(context.error_scale(margin))};
}

/// The moving body in the frame of the fixed one, for boxes.
PlacedPair placed(const PieceContext& context, const Start<double>& start) {
    const Bvh &moving = context.moving().bvh(), &fixed = context.fixed().bvh();
    const Vector3<double> centre =
        scale(start.rotation * motion::vector_in<double>(moving.centre()) + start.offset, 1 / start.weight) -
        motion::vector_in<double>(fixed.centre());
    culling::Placement place;
    for (int i = 0; i < 3; ++i) {
        place.offset[i] = centre[i];
        for (int j = 0; j < 3; ++j)
            place.rotation(i, j) = start.rotation.row[i][j] / start.weight;
    }
    return {context.moving(), context.fixed(), place, start.error};
}

/// Asks vertices in double, and where that does not tell as exactly as the motion is known.
class InsideTest {
public:
    InsideTest(PieceContext& context, const Start<double>& start) : context_(context), start_(start) {}

    /// Whether a vertex of a body lies inside of the other one; empty if it is too near the surface to tell.
    std::optional<bool> is_inside(bool is_moving, std::uint32_t vertex) {
        if (const auto inside = is_inside(start_, is_moving, vertex))
            return inside;
        if (const auto* maps = context_.exact_maps())
            return is_inside(Start<ExactNumber>(*maps, ExactNumber(0.0)), is_moving, vertex);
        if (const auto refined = context_.refined_start())
            return is_inside(
                Start<DoubleDouble>(refined->maps, elementary::position_error<DoubleDouble>(refined->scale)), is_moving,
                vertex);
        return std::nullopt;
    }

private:
    template <class S>
    [[nodiscard]] std::optional<bool> is_inside(const Start<S>& start, bool is_moving, std::uint32_t vertex) const {
        const Body& inner = is_moving ? context_.moving() : context_.fixed();
        const Body& outer = is_moving ? context_.fixed() : context_.moving();
        const WeightedPoint<double> rounded = start_.seen(inner, is_moving, vertex);
        const Vector3<double> near = scale(rounded.place, 1 / rounded.weight);
        const WeightedPoint<S> point = start.seen(inner, is_moving, vertex);
        return culling::is_inside<S>(outer, point, {near.x, near.y, near.z}, 2 * start_.error);
    }

    PieceContext& context_;
    const Start<double>& start_;
};

} // namespace

std::optional<Nested> nested_at_start(PieceContext& context) {
    if (!context.moving().volume().is_solid() && !context.fixed().volume().is_solid())
        return std::nullopt;
    const Start<double> start = start_of(context);
    const PlacedPair pair = placed(context, start);
    InsideTest test(context, start);
    std::optional<Nested> found;
    for (const bool is_moving : {true, false})
        for (const std::uint32_t vertex : points_to_ask(is_moving ? pair : pair.swapped())) {
            throw_if_cancelled();
            const std::optional<bool> inside = test.is_inside(is_moving, vertex);
            if (inside.value_or(!found))
                found = Nested{is_moving, vertex, inside.has_value()};
            if (inside.value_or(false))
                return found;
        }
    return found;
}

} // namespace chasles::search
