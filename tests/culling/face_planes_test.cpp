// The separation test of two faces by their shortest connection: pairs that it separates stay farther apart than the
// margin, and it separates most such pairs.
#include "chasles/culling/face_planes.h"

#include "chasles/culling/time_tree.h"
#include "chasles/motion/any_trajectory.h"
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
            FacePlanes planes(moving_body.body(), fixed_body.body(), margin);
            planes.use(maps, scale);
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

/// A scene of two triangles that move against each other in a part of a motion.
struct ChordScene {
    Corners moving;
    Corners fixed;
    Motion motion;
    TimeRange interval = {};
    Window when = {};
    std::unique_ptr<const motion::AnyPiece> piece = motion.trajectory().pieces()->at(0);

    [[nodiscard]] double deviation() const {
        const motion::Ball ball{Eigen::Vector3d::Zero(), 3};
        const motion::ChordDeviation deviation(piece->cubic(), ball, ball);
        return std::max(deviation.of_moving(interval.lower, interval.upper),
                        deviation.of_fixed(interval.lower, interval.upper));
    }
    [[nodiscard]] bool are_apart(double deviation) const {
        const Polyhedron mover = body_of(moving);
        const Polyhedron target = body_of(fixed);
        const auto whole = motion::double_maps(piece->cubic());
        const auto maps = motion::restricted(whole, interval.lower, interval.upper);
        FacePlanes planes(mover.body(), target.body(), 0);
        planes.use(maps, elementary::error_scale(whole, 3, 3));
        return planes.are_apart_on_chords(0, 0, when, deviation);
    }
    /// The least distance in the window, sampled.
    [[nodiscard]] double distance() const {
        double least = 1e300;
        for (int i = 0; i <= 40; ++i) {
            const double share = double(when.lower) + (when.upper - when.lower) * i / 40.0;
            const Eigen::Isometry3d pose = piece->pose_at(interval.at(share)).isometry();
            const Corners there{pose * moving[0], pose * moving[1], pose * moving[2]};
            least = std::min(least, squared_distance_of_triangles<double>(there, fixed));
        }
        return std::sqrt(least);
    }
};

ChordScene random_chord_scene(Random& random) {
    const auto corners = [&] { return random_corners(random, 1.5); };
    const auto pose = [&] {
        return turned(eigen(random.vector(1)), eigen(random.vector(1)), random.uniform(-1.5, 1.5));
    };
    ChordScene scene{corners(), corners(), ScrewMotion::between(pose(), pose())};
    const double width = std::ldexp(1.0, -random.integer(0, 5));
    const double lower = width * random.integer(0, int(1 / width) - 1);
    scene.interval = {lower, lower + width};
    const auto first = float(random.uniform(0, 1));
    scene.when = {first, float(random.uniform(double(first), 1))};
    return scene;
}

TEST(FacePlanes, OnChordsAreApartWhatDoesNotTouch) {
    Random random(772);
    int apart = 0, touching = 0, wrong_without_deviation = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const ChordScene scene = random_chord_scene(random);
        const bool touches = scene.distance() <= 0;
        const bool is_apart = scene.are_apart(scene.deviation());
        EXPECT_FALSE(is_apart && touches) << "trial " << trial;
        apart += is_apart ? 1 : 0;
        touching += touches ? 1 : 0;
        wrong_without_deviation += touches && scene.are_apart(0) ? 1 : 0;
    }
    std::cout << apart << " apart, " << touching << " touch\n";
    EXPECT_GT(apart, 4000);
    EXPECT_GT(touching, 1000);
    EXPECT_GT(wrong_without_deviation, 0) << "the deviation matters in none of these scenes";
}

/// A triangle that stands still above another one, by more or less than what rounding and the deviation can explain.
TEST(FacePlanes, OnChordsTheBandCounts) {
    const Corners below{Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, -1, 0), Eigen::Vector3d(0, 1, 0)};
    for (const double height : {1e-3, 1e-6, 1e-11}) {
        Corners above = below;
        for (Eigen::Vector3d& corner : above)
            corner.z() += height;
        ChordScene scene{above, below, ScrewMotion::between(Pose(), Pose())};
        scene.interval = {0, 1};
        scene.when = {0, 1};
        EXPECT_TRUE(scene.are_apart(0.9 * height));
        EXPECT_FALSE(scene.are_apart(1.1 * height));
    }
}

} // namespace
} // namespace chasles::culling
