// Real meshes slide and roll on each other in random small steps with `hold`. FCL's distances and all pairs of
// triangles check the answers: no step comes closer than the hold distance, no step stops without a cause, and every
// new contact is reported. CHASLES_LONG=1 in the environment: more than ten thousand steps.
#include "tests/data/shared_data.h"
#include "tests/data/slide.h"
#include "tests/support/grid.h"
#include "tests/support/posed_motions.h"

#ifdef CHASLES_TESTS_FCL
#include "tests/data/fcl_distance.h"
#endif

namespace chasles::test {
namespace {

enum class From { outside, above, inside };

struct SlideCase {
    const char* name;
    const char* moving;
    const char* fixed; ///< empty: a plate
    From from = From::outside;
};

/// A plate of triangles in the plane z = 0.
Polyhedron plate() {
    constexpr std::uint32_t count = 8;
    std::vector<Eigen::Vector3d> vertices;
    for (std::uint32_t i = 0; i <= count; ++i)
        for (std::uint32_t j = 0; j <= count; ++j)
            vertices.emplace_back(0.5 * i - 2, 0.5 * j - 2, 0);
    return Polyhedron::from_polygons(vertices, grid_triangles(count, count));
}

/// The body scaled by a power of two.
Polyhedron sized(const Polyhedron& body, int exponent) {
    std::vector<Eigen::Vector3d> vertices(body.vertices().begin(), body.vertices().end());
    for (Eigen::Vector3d& vertex : vertices)
        vertex *= std::ldexp(1.0, exponent);
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t f = 0; f < body.face_count(); ++f)
        faces.emplace_back(body.face(f).begin(), body.face(f).end());
    return Polyhedron::from_polygons(vertices, faces, {.triangulate = true});
}

/// A body of a pair as it is; any other body scaled to a size of about one.
Polyhedron body_of(const std::string& name, From from) {
    if (name.empty())
        return plate();
    const Polyhedron body = Polyhedron::load(shared_data(name));
    return from == From::outside ? sized(body, -std::ilogb(Ball(body).radius)) : body;
}

class Slides : public testing::TestWithParam<SlideCase> {
protected:
    static void TearDownTestSuite() {
        if (total_.steps > 0)
            print("all", total_);
    }

    static void print(const char* name, const SlideTally& tally) {
        const auto plain = [&](double part) { return SlideTally::milliseconds(tally.seconds, part); };
        const auto kept = [&](double part) { return SlideTally::milliseconds(tally.seconds_with_memory, part); };
        print_figures("%s: %d steps, %d clear, %d stopped at the hold, %d in doubt, %d stuck; least distance %.15g of "
                      "the hold, FCL off by %.2g; median query %.2f ms, 99 of 100 "
                      "within %.1f ms, slowest %.1f ms; with a memory %.3f, %.2f and %.1f ms",
                      name, tally.steps, tally.clear, tally.held, tally.in_doubt, tally.stuck, tally.lowest,
                      tally.peer_error, plain(0.5), plain(0.99), plain(1), kept(0.5), kept(0.99), kept(1));
    }

    /// Moves the body into the margin from the start of its case, in several attempts.
    static bool approach(SlidingBody& body, Random& random) {
        const Ball moving(body.moving);
        const Ball fixed(body.fixed);
        const From from = GetParam().from;
        if (from == From::inside) {
            body.at = Pose();
            return true;
        }
        for (int tries = 0; tries < 50; ++tries) {
            if (from == From::above) {
                const double most = 0.03 * fixed.radius; // some clearances
                const Eigen::Vector3d beside(random.uniform(-most, most), random.uniform(-most, most), 0);
                const Eigen::Vector3d up = fixed.radius * Eigen::Vector3d::UnitZ();
                const Eigen::Quaterniond straight = Eigen::Quaterniond::Identity();
                if (body.approach({beside + up, straight}, {beside, straight}))
                    return true;
                continue;
            }
            const Eigen::Quaterniond turn(random_pose(random, 1).rotation);
            const Eigen::Vector3d way = random_point(random, 1).normalized() * 1.1 * (moving.radius + fixed.radius);
            const Eigen::Vector3d there = fixed.middle + random_point(random, 0.3 * fixed.radius);
            const Eigen::Vector3d offset = turn.normalized() * moving.middle;
            if (body.approach({there + way - offset, turn}, {there - offset, turn}))
                return true;
        }
        return false;
    }

    /// A body with a random hold distance.
    static SlidingBody body_with(const Polyhedron& moving, const Polyhedron& fixed, Random& random,
                                 const DistanceAt& peer) {
        const double scene = Ball(moving).radius + Ball(fixed).radius;
        const double size = GetParam().from == From::outside ? 3e-2 : 1e-2;
        const double margin = Ball(moving).radius * size * std::pow(10, random.uniform(-1, 0));
        return {.moving = moving,
                .fixed = fixed,
                .margin = margin,
                .hold = random.uniform(0.02, 0.8) * margin,
                .slack = 2e-12 * scene,
                .peer = peer,
                .peer_slack = 2e-12 * scene};
    }

    inline static SlideTally total_;
};

TEST_P(Slides, ComeNoNearerThanTheHoldAndAreNotStoppedWithoutACause) {
    const SlideCase& asked = GetParam();
    CHASLES_REQUIRE_DATA("meshes");
    CHASLES_REQUIRE_DATA("assembly-factory");
#ifndef CHASLES_TESTS_FCL
    GTEST_SKIP() << "skipped: FCL is not installed";
#else
    Random random(2026);
    const Polyhedron moving = body_of(asked.moving, asked.from);
    const Polyhedron fixed = body_of(asked.fixed, asked.from);
    const FclDistance fcl(moving, fixed);
    const int count = 10 * times_if_long(50); // ten thousand in all
    SlideTally tally;
    while (tally.steps < count && !HasFailure()) {
        SlidingBody body = body_with(moving, fixed, random, fcl);
        ASSERT_TRUE(approach(body, random));
        for (int i = 0; i < 25 && tally.steps + body.tally.steps < count && !HasFailure(); ++i) {
            SCOPED_TRACE("step " + std::to_string(tally.steps + body.tally.steps));
            if (!Slide(body, random).step())
                break;
        }
        tally += body.tally;
    }
    EXPECT_GT(tally.clear, count / 10);
    EXPECT_EQ(tally.touching, 0);
    print(asked.name, tally);
    total_ += tally;
#endif
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, Slides,
    testing::Values(SlideCase{"LOnAPlate", "meshes/L.obj", ""},
                    SlideCase{"LOnATeapot", "meshes/L.obj", "meshes/teapot.obj"},
                    SlideCase{"SmallBunnyOnL", "meshes/bunny-lowpoly.obj", "meshes/L.obj"},
                    SlideCase{"OloidOnAPlate", "meshes/oloid.obj", ""},
                    SlideCase{"OloidOnAHeightField", "meshes/oloid.obj", "meshes/height-field.obj"},
                    SlideCase{"CowOnAnOloid", "meshes/spot.obj", "meshes/oloid.obj"},
                    SlideCase{"CloseCubesOnASmallBunny", "meshes/two-cubes-close.ply", "meshes/bunny-lowpoly.obj"},
                    SlideCase{"FarCubesOnAPlate", "meshes/two-cubes-far.ply", ""},
                    SlideCase{"CrossingCubesOnAWingNut", "meshes/two-cubes-intersecting.ply", "meshes/wing-nut.obj"},
                    SlideCase{"WingNutOnACow", "meshes/wing-nut.obj", "meshes/spot.obj"},
                    SlideCase{"TeapotOnAHeightField", "meshes/teapot.obj", "meshes/height-field.obj"},
                    SlideCase{"BunnyOnAPlate", "meshes/stanford-bunny.obj", ""}),
    [](const auto& its) { return its.param.name; });

constexpr const char* square_hole = "assembly-factory/factory_rectangular_hole_16mm_subdiv_3x.obj";
constexpr const char* loose_square = "assembly-factory/factory_rectangular_peg_16mm_loose_subdiv_3x.obj";
constexpr const char* tight_square = "assembly-factory/factory_rectangular_peg_16mm_tight_subdiv_3x.obj";
constexpr const char* round_hole = "assembly-factory/factory_round_hole_16mm_subdiv_3x.obj";
constexpr const char* loose_round = "assembly-factory/factory_round_peg_16mm_loose.obj";
constexpr const char* tight_round = "assembly-factory/factory_round_peg_16mm_tight.obj";

INSTANTIATE_TEST_SUITE_P(Pegs, Slides,
                         testing::Values(SlideCase{"LooseSquareInserted", loose_square, square_hole, From::above},
                                         SlideCase{"TightSquareInserted", tight_square, square_hole, From::above},
                                         SlideCase{"LooseRoundInserted", loose_round, round_hole, From::above},
                                         SlideCase{"TightRoundInserted", tight_round, round_hole, From::above},
                                         SlideCase{"LooseSquareInside", loose_square, square_hole, From::inside},
                                         SlideCase{"TightSquareInside", tight_square, square_hole, From::inside},
                                         SlideCase{"LooseRoundInside", loose_round, round_hole, From::inside},
                                         SlideCase{"TightRoundInside", tight_round, round_hole, From::inside}),
                         [](const auto& its) { return its.param.name; });

} // namespace
} // namespace chasles::test
