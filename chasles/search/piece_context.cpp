#include "chasles/search/piece_context.h"

#include "chasles/culling/body_ball.h"

namespace chasles::search {

namespace {

/// The largest coordinate of a body.
double reach(const Bvh& hierarchy) {
    const BvhNode& root = hierarchy.nodes()[0];
    double result = 0;
    for (int i = 0; i < 3; ++i) {
        const double extent = std::max(std::abs(double(root.lower[i])), std::abs(double(root.upper[i])));
        result = std::max(result, std::abs(hierarchy.centre()[i]) + extent);
    }
    return result;
}

/// With all that the maps are made of, and the margin.
double reach_of_moving(const PieceSearch& search) {
    return std::max(reach(search.moving.bvh()), search.frame.motion.reference_extent) +
           motion::rounding_extent(search.frame.motion) + search.margin;
}

/// Points that meet are within the margin of each other: so either body is seen as large as with it.
motion::Ball enlarged(motion::Ball ball, double margin) {
    ball.radius += margin;
    return ball;
}

culling::TimeTree time_tree(const PieceSearch& search, const motion::ControlMaps<double>& maps,
                            const elementary::ErrorScale& scale) {
    const motion::Ball moving = enlarged(culling::ball_around(search.moving.bvh()), search.margin);
    const motion::Ball fixed = enlarged(culling::ball_around(search.fixed.bvh()), search.margin);
    return {maps, motion::ChordDeviation(search.frame.motion, moving, fixed), moving, fixed, scale, search.margin};
}

} // namespace

PieceContext::PieceContext(const PieceSearch& search)
    : maps(motion::double_maps(search.frame.motion)),
      scale(elementary::error_scale(maps, reach_of_moving(search), reach(search.fixed.bvh()))),
      times(time_tree(search, maps, scale)) {}

} // namespace chasles::search
