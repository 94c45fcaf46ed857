// Planes and directions between two faces keep the faces apart, or farther apart than a margin. Dense samples find
// nothing nearer, and most faces that are apart are proven to be.
#include "chasles/culling/face_planes.h"

#include "chasles/culling/time_tree.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/search/piece_context.h"
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

TEST(FacePlanes, DirectionsTellFacesApartThatStayFartherThanTheMargin) {
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
        const motion::Ball ball{Eigen::Vector3d::Zero(), 2 * reach + least};
        const motion::ChordDeviation chords(posed.made, ball, ball);
        const double deviation = std::max(chords.of_moving(from, from + width), chords.of_fixed(from, from + width));
        const auto part = motion::restricted(maps, from, from + width);
        const auto are_separated = [&](double margin) {
            FacePlanes planes(moving_body.body(), fixed_body.body(), margin);
            planes.use(part, scale);
            return planes.without_apart_on_chords(0, 0, Window(), deviation).is_empty();
        };
        const double rounding = 4 * elementary::error_unit<double> * scale.length;
        EXPECT_FALSE(are_separated(least + rounding)) << "their least distance is " << least;
        if (greatest - least <= 0.01 * least && rounding + deviation <= 0.001 * least)
            (are_separated(0.5 * least) ? separated : open) += 1;
    }
    std::cout << separated << " separated, " << open << " left open\n";
    EXPECT_GT(separated, 500);
    EXPECT_LT(open, separated);
}

/// Motions in space that cubic motions only enclose.
Motion enclosed_motion(Random& random) {
    const auto hinge = [&] {
        return Motion::hinge(eigen(random.vector(2)), eigen(random.vector(1)), {0, random.uniform(-1, 1)});
    };
    return random.chance(0.5) ? hinge() * hinge() : relative(hinge(), hinge());
}

/// A small triangle around a point, and a large one through another point that meets it during an interval. The plane
/// lies across the axis about which the motion all but turns, or across another direction.
struct Touching {
    Corners small, large;

    Touching(Random& random, const Eigen::Vector3d& small_at, const Eigen::Vector3d& large_at,
             const Eigen::Vector3d& axis) {
        const double tilt = random.chance(0.5) ? 1e-4 : 1;
        const Eigen::Vector3d normal = (axis + tilt * eigen(random.vector(1))).normalized();
        const Eigen::Vector3d across = normal.unitOrthogonal(), beside = normal.cross(across);
        for (std::size_t k = 0; k < 3; ++k) {
            const double angle = 2.1 * double(k);
            small[k] = small_at + 1e-7 * eigen(random.vector(1));
            large[k] = large_at + 3 * (std::cos(angle) * across + std::sin(angle) * beside);
        }
    }
};

/// Chords leave the true motion by more than the maps do, also along the axis (note 36).
TEST(FacePlanes, FacesThatMeetOnEnclosedMotionsAreKept) {
    Random random(775);
    int count = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Motion motion = enclosed_motion(random);
        const auto pieces = motion.trajectory().pieces();
        const std::size_t index = std::size_t(random.integer(0, int(pieces->size()) - 1));
        const auto piece = pieces->at(index);
        const TimeRange interval{random.uniform(0, 0.4), random.uniform(0.6, 1)};
        const double share = random.uniform(0.3, 0.7), time = interval.at(share);
        const Eigen::Isometry3d there =
            piece->fixed_pose_at(time).isometry().inverse() * piece->pose_at(time).isometry();
        const Eigen::Vector3d point = eigen(random.vector(2));
        const auto enclosure = piece->enclosure({interval.lower, interval.upper});
        if (!enclosure)
            continue;
        const auto e = motion::in_double(enclosure->bounds.along.axis);
        const Eigen::Vector3d axis(e.x, e.y, e.z);
        const bool small_moves = random.chance(0.5);
        const Touching pair(random, small_moves ? point : there * point, small_moves ? there * point : point,
                            small_moves ? axis : there.linear().transpose() * axis);
        const Polyhedron moving = body_of(small_moves ? pair.small : pair.large);
        const Polyhedron fixed = body_of(small_moves ? pair.large : pair.small);
        for (const double margin : {0.0, 1e-5}) {
            const search::PieceContext context(moving.body(), fixed.body(), pieces->at(index));
            const PieceParts parts = context.parts(margin);
            PartMaps maps(parts);
            maps.set(interval);
            FacePlanes planes(moving.body(), fixed.body(), margin);
            planes.use(maps.maps(), maps.scale());
            const double deviation = context.time_tree(margin, parts).interval(interval).deviation;
            const Window left = planes.without_apart_on_chords(0, 0, Window(), deviation);
            EXPECT_FALSE(left.is_empty()) << trial << ", margin " << margin;
            EXPECT_LE(left.lower, share) << trial << ", margin " << margin;
        }
        ++count;
    }
    EXPECT_GT(count, 1000);
}

/// A scene of two triangles that move against each other in a part of a motion.
struct ChordScene {
    Corners moving;
    Corners fixed;
    Motion motion;
    TimeRange interval = {};
    Window when = {};
    double margin = 0;
    std::unique_ptr<const motion::AnyPiece> piece = motion.trajectory().pieces()->at(0);

    [[nodiscard]] double deviation() const {
        const motion::Ball ball{Eigen::Vector3d::Zero(), 5 + margin};
        const motion::ChordDeviation deviation(piece->cubic(), ball, ball);
        return std::max(deviation.of_moving(interval.lower, interval.upper),
                        deviation.of_fixed(interval.lower, interval.upper));
    }
    /// The window without its proven beginning. Points that touch leave their chords by at most `deviation`.
    [[nodiscard]] Window left(double deviation) const {
        const Polyhedron mover = body_of(moving);
        const Polyhedron target = body_of(fixed);
        const auto whole = motion::double_maps(piece->cubic());
        const auto maps = motion::restricted(whole, interval.lower, interval.upper);
        FacePlanes planes(mover.body(), target.body(), margin);
        planes.use(maps, elementary::error_scale(whole, 5 + margin, 5));
        return planes.without_apart_on_chords(0, 0, when, deviation);
    }
    [[nodiscard]] bool are_apart(double deviation) const { return left(deviation).is_empty(); }
    /// The least distance in a window, sampled.
    [[nodiscard]] double distance(const Window& sampled) const {
        double least = 1e300;
        for (int i = 0; i <= 40; ++i) {
            const double share = double(sampled.lower) + (sampled.upper - sampled.lower) * i / 40.0;
            const Eigen::Isometry3d pose = piece->pose_at(interval.at(share)).isometry();
            const Corners there{pose * moving[0], pose * moving[1], pose * moving[2]};
            least = std::min(least, squared_distance_of_triangles<double>(there, fixed));
        }
        return std::sqrt(least);
    }
};

/// Triangles of several sizes. The fixed one is put where the moving one is at some time of the interval, or near it.
ChordScene random_chord_scene(Random& random) {
    const double reach = 1.5 * std::ldexp(1.0, -random.integer(0, 3));
    const auto pose = [&] {
        return turned(eigen(random.vector(1)), eigen(random.vector(1)), random.uniform(-1.5, 1.5));
    };
    ChordScene scene{random_corners(random, reach), random_corners(random, reach),
                     ScrewMotion::between(pose(), pose())};
    const double width = std::ldexp(1.0, -random.integer(0, 5));
    const double lower = width * random.integer(0, int(1 / width) - 1);
    scene.interval = {lower, lower + width};
    const auto first = float(random.uniform(0, 1));
    scene.when = {first, float(random.uniform(double(first), 1))};
    const Eigen::Isometry3d there = scene.piece->pose_at(scene.interval.at(random.uniform(0, 1))).isometry();
    const Eigen::Vector3d shift = there * scene.moving[0] - scene.fixed[0] + eigen(random.vector(0.2 * reach));
    for (Eigen::Vector3d& corner : scene.fixed)
        corner += shift;
    return scene;
}

/// What the culler proves of random scenes, and what samples say.
struct ChordTally {
    int apart = 0, near = 0, cut = 0, cut_and_near = 0, wrong_without_deviation = 0;

    void count(const ChordScene& scene) {
        const auto comes_near = [&](const Window& left) {
            const Window dropped = left.is_empty() ? scene.when : Window{scene.when.lower, left.lower};
            return scene.distance(dropped) <= scene.margin;
        };
        const bool is_near = scene.distance(scene.when) <= scene.margin;
        const Window left = scene.left(scene.deviation());
        const Window careless = scene.left(0);
        const bool is_cut = left.lower > scene.when.lower;
        EXPECT_FALSE(is_cut && comes_near(left));
        EXPECT_TRUE(left.is_empty() || left.upper == scene.when.upper);
        apart += left.is_empty() ? 1 : 0;
        near += is_near ? 1 : 0;
        cut += is_cut && !left.is_empty() ? 1 : 0;
        cut_and_near += is_cut && is_near ? 1 : 0;
        wrong_without_deviation += careless.lower > scene.when.lower && is_near && comes_near(careless) ? 1 : 0;
    }
    void expect_many(int most) const {
        std::cout << apart << " apart, " << near << " come near, " << cut << " windows begin later, " << cut_and_near
                  << " of them before faces come near\n";
        EXPECT_GT(apart, most / 5);
        EXPECT_GT(near, most / 20);
        EXPECT_GT(cut, most / 60);
        EXPECT_GT(cut_and_near, most / 200);
        EXPECT_GT(wrong_without_deviation, 0) << "the deviation matters in none of these scenes";
    }
};

TEST(FacePlanes, OnChordsAreApartWhatDoesNotTouch) {
    constexpr int trials = 20000;
    Random random(772);
    ChordTally tally;
    for (int trial = 0; trial < trials; ++trial)
        tally.count(random_chord_scene(random));
    tally.expect_many(trials);
}

TEST(FacePlanes, OnChordsAreFartherApartThanTheMarginWhatStaysSo) {
    constexpr int trials = 20000;
    Random random(774);
    ChordTally tally;
    for (int trial = 0; trial < trials; ++trial) {
        ChordScene scene = random_chord_scene(random);
        scene.margin = std::abs(random.scaled(-3, 0));
        tally.count(scene);
    }
    tally.expect_many(trials);
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

/// A triangle that falls onto another one: its window begins just before points may come within the margin.
TEST(FacePlanes, OnChordsTheWindowBeginsAtTheContact) {
    const Corners below{Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, -1, 0), Eigen::Vector3d(0, 1, 0)};
    const auto pose_at = [](double height) { return Pose({0, 0, height}, Eigen::Quaterniond::Identity()); };
    for (const double margin : {0.0, 0.2}) {
        for (const double deviation : {0.0, 0.01, 0.1}) {
            for (const float first : {0.0F, 0.25F, 0.75F}) {
                ChordScene scene{below, below, ScrewMotion::between(pose_at(3), pose_at(-1))};
                scene.when = {first, 0.875F};
                scene.margin = margin;
                const double expected = std::max(double(first), 0.75 - (deviation + margin) / 4);
                const Window left = scene.left(deviation);
                EXPECT_LE(left.lower, expected);
                EXPECT_GT(left.lower, expected - 1e-5);
                EXPECT_EQ(left.upper, 0.875F);
            }
        }
    }
}

} // namespace
} // namespace chasles::culling
