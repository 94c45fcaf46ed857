// The separation test of two faces by their shortest connection: pairs that it separates stay farther apart than the
// margin, and it separates most such pairs.
#include "chasles/culling/face_planes.h"

#include "tests/query/bodies.h"
#include "tests/support/posed_motions.h"
#include "tests/support/surface_distance.h"

namespace chasles::culling {
namespace {

using namespace test;
using Corners = std::array<Eigen::Vector3d, 3>;

Corners random_corners(Random& random, double reach) {
    return {eigen(random.vector(reach)), eigen(random.vector(reach)), eigen(random.vector(reach))};
}

Polyhedron body_of(const Corners& corners) {
    return triangle(corners[0], corners[1], corners[2]).polyhedron();
}

TEST(FacePlanes, TheWayTellsFacesApartThatStayFartherThanTheMargin) {
    Random random(771);
    int separated = 0, open = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const double reach = std::abs(random.scaled(-2, 2));
        const PosedMotion posed = random_posed_motion(random, reach);
        const auto maps = motion::double_maps(posed.made);
        const Corners moving = random_corners(random, reach);
        const Corners fixed = random_corners(random, reach);
        const double width = std::ldexp(1.0, -random.integer(2, 14));
        const double from = width * random.integer(0, int(1 / width) - 1);
        double least = 1e300, greatest = 0;
        for (int i = 0; i <= 40; ++i) {
            Corners there;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vector3<double> corner{moving[k].x(), moving[k].y(), moving[k].z()};
                there[k] = eigen(elementary::position_at(maps.rotation * corner + maps.translation, maps.weight,
                                                         from + width * i / 40.0));
            }
            const double distance = std::sqrt(squared_distance_of_triangles<double>(there, fixed));
            least = std::min(least, distance);
            greatest = std::max(greatest, distance);
        }
        const Polyhedron moving_body = body_of(moving);
        const Polyhedron fixed_body = body_of(fixed);
        const elementary::ErrorScale scale = elementary::error_scale(
            maps, reach + posed.made.reference_extent + motion::rounding_extent(posed.made), reach);
        const auto are_separated = [&](double margin) {
            FacePlanes planes(moving_body.body(), fixed_body.body(), scale, margin);
            planes.use(maps);
            return planes.are_separated(0, 0, FacePlanes::Restriction(from, from + width), from + 0.5 * width);
        };
        const double rounding = 4 * elementary::error_unit<double> * scale.length;
        EXPECT_FALSE(are_separated(least + rounding)) << "their least distance is " << least;
        EXPECT_FALSE(are_separated(0)) << "the planes of the faces separate them, not their shortest connection";
        if (greatest - least <= 0.01 * least && rounding <= 0.001 * least)
            (are_separated(0.5 * least) ? separated : open) += 1;
    }
    std::cout << separated << " separated, " << open << " left open\n";
    EXPECT_GT(separated, 500);
    EXPECT_LT(open, separated);
}

} // namespace
} // namespace chasles::culling
