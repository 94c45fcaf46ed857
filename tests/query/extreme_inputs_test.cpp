// Whole queries on extreme bodies and motions against exact rationals: no contact is missed, certain answers are true,
// and false alarms occur only within the bound.
#include "chasles/base/invalid_input.h"
#include "chasles/query/batch.h"
#include "chasles/query/least_distance.h"
#include "chasles/query/path.h"
#include "tests/query/bodies.h"
#include "tests/query/exact_answer.h"
#include "tests/support/exact_reference.h"
#include "tests/support/posed_motions.h"
#include "tests/support/refusal.h"
#include "tests/support/segment_distance.h"
#include "tests/support/trajectories.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using std::numbers::pi;
using Triangle = std::array<Eigen::Vector3d, 3>;

/// A triangle about the origin.
using Shape = Triangle (*)(Random&);

Eigen::Vector3d random_direction(Random& random) {
    return eigen(random.vector(1)).normalized();
}

Triangle ordinary(Random& random) {
    return {eigen(random.vector(1)), eigen(random.vector(1)), eigen(random.vector(1))};
}

/// A triangle almost without area: the third corner is 1e-15 to 1e-6 off the first side.
Triangle sliver(Random& random) {
    const Triangle t = ordinary(random);
    return {t[0], t[1], t[0] + random.uniform(0, 1) * (t[1] - t[0]) + eigen(random.vector(random.scaled(-15, -6)))};
}

/// A triangle with one tiny edge, or with three tiny edges.
Triangle with_tiny_edges(Random& random) {
    Triangle t = ordinary(random);
    t[1] = t[0] + eigen(random.vector(random.scaled(-14, -6)));
    if (random.chance(0.5))
        t[2] = t[0] + eigen(random.vector(random.scaled(-14, -6)));
    return t;
}

/// A triangle a hundred million times as long as wide.
Triangle needle(Random& random) {
    const Eigen::Vector3d along = random_direction(random);
    return {Eigen::Vector3d::Zero(), along, along + 1e-8 * random_direction(random)};
}

/// A triangle with coordinates from 1e-9 to 1e9.
Triangle mixed(Random& random) {
    Triangle t;
    for (Eigen::Vector3d& corner : t)
        corner = {random.scaled(-9, 9), random.scaled(-9, 9), random.scaled(-9, 9)};
    return t;
}

Eigen::Vector3d random_point_of(Random& random, const Triangle& t) {
    const double a = random.uniform(0, 1);
    const double b = random.uniform(0, 1 - a);
    return t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
}

struct Scene {
    Pose start;
    Pose goal;
    Body moving;
    Body fixed;
    double max_turn = pi;
    bool sweeps = false;

    [[nodiscard]] Motion motion() const {
        return sweeps ? Motion::sweep(start, goal) : Motion::screw(start, goal, max_turn);
    }
};

/// The parameters of the scenes of one test.
struct Recipe {
    Shape moving = ordinary;
    Shape fixed = ordinary;
    double angle = 0;
    double max_turn = pi;
    bool sweeps = false;
    double away = 0; ///< distance from the world's origin, and of the moving body from its frame's origin
};

double size_of(const Triangle& t) {
    return std::max({(t[1] - t[0]).norm(), (t[2] - t[0]).norm(), (t[2] - t[1]).norm()});
}

/// At half time a point of one body is at a point of the other body, up to the rounding of the coordinates.
Scene random_scene(Random& random, const Recipe& recipe) {
    Triangle fixed = recipe.fixed(random);
    const Triangle shape = recipe.moving(random);
    const double size = std::max(size_of(fixed), size_of(shape));
    const Eigen::Vector3d away = recipe.away * random_direction(random);
    for (Eigen::Vector3d& corner : fixed)
        corner += away;
    Scene scene;
    scene.max_turn = recipe.max_turn;
    scene.sweeps = recipe.sweeps;
    scene.start = Pose(away + eigen(random.vector(size)), random_rotation(random));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(recipe.angle, random_direction(random)));
    const double way = random.chance(0.5) ? size : size * std::abs(random.scaled(-6, 0));
    scene.goal =
        Pose(scene.start.translation + eigen(random.vector(way)), turn * Eigen::Quaterniond(scene.start.rotation));
    const double half_way = random.uniform(0.2, 0.9);
    const Eigen::Isometry3d back = scene.motion().pose_at(half_way).isometry().inverse();
    // Point to point, or nearly corner to corner after a short motion. In the second case about half of the bodies pass
    // each other.
    const bool passing = random.chance(0.5);
    const Eigen::Vector3d touching = passing ? shape[0] : random_point_of(random, shape);
    Eigen::Vector3d place = passing ? fixed[0] : random_point_of(random, fixed);
    if (passing)
        place += size * random.scaled(-17, -3) * random_direction(random);
    Triangle moving;
    for (std::size_t i = 0; i < 3; ++i)
        moving[i] = back * (place + (shape[i] - touching));
    scene.moving = triangle(moving[0], moving[1], moving[2]);
    scene.fixed = triangle(fixed[0], fixed[1], fixed[2]);
    return scene;
}

/// The exact pieces into which a query cuts the motion.
std::vector<RationalMotion<Rational>> exact_pieces(const Scene& scene) {
    if (scene.sweeps)
        return {sweep_of(SweepMotion::between(scene.start, scene.goal), exact(scene.start), exact(scene.goal),
                         Eigen::Vector3d::Zero())
                    .exactly};
    std::vector<RationalMotion<Rational>> pieces;
    for (const ScrewMotion& piece : ScrewMotion::between(scene.start, scene.goal, scene.max_turn).pieces()) {
        const motion::RelativeEnds ends = relative_ends_of(piece);
        pieces.push_back(motion::screw_between(exact(ends.start), exact(ends.goal)));
    }
    return pieces;
}

struct Tally {
    int scenes = 0;
    int contacts = 0;
    int at_start = 0;
    int certain = 0;
    int doubtful_alarms = 0; ///< uncertain contacts where there is no contact
    double furthest_alarm = 0;
    double bound = 0; ///< the largest bound of a scene, in the unit of the scene
};

/// The product of the 1-norms of two edges of a face, over the length of their cross product.
double slenderness(const Body& body) {
    const auto& v = body.vertices;
    const Eigen::Vector3d a = v[1] - v[0];
    const Eigen::Vector3d b = v[2] - v[0];
    return a.lpNorm<1>() * b.lpNorm<1>() / std::max(a.cross(b).norm(), 1e-300);
}

double reach(const Body& body) {
    double largest = 0;
    for (const Eigen::Vector3d& vertex : body.vertices)
        largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
    return largest;
}

/// Bodies that pass at a greater distance are separated. The bound is the larger of two: eight errors in double-double
/// over the sine of the slenderest corner (note 03, except for points just beyond its tip), and the root of the error
/// times the length of the edges (note 04).
double bound_of(const Scene& scene, const RationalMotion<Rational>& motion) {
    const auto maps = motion::rounded(motion::control_maps(rounded_to<DoubleDouble>(motion)));
    const auto scale = elementary::error_scale(maps, reach(scene.moving), reach(scene.fixed));
    const double error = elementary::relative_error<DoubleDouble>(scale) * scale.length;
    return std::max(8 * error * std::max(slenderness(scene.moving), slenderness(scene.fixed)),
                    std::sqrt(error * scale.length));
}

/// The distance of the two triangles, up to rounding.
double distance_at(const Scene& scene, const FirstContact& found) {
    Triangle a;
    Triangle b;
    for (std::size_t i = 0; i < 3; ++i) {
        a[i] = found.pose.isometry() * scene.moving.vertices[i];
        b[i] = scene.fixed.vertices[i];
    }
    double least = 1e300;
    for (std::size_t i = 0; i < 3; ++i) {
        least = std::min({least, distance_to_triangle(a[i], b), distance_to_triangle(b[i], a)});
        for (std::size_t j = 0; j < 3; ++j)
            least = std::min(least, distance_of_segments({a[i], a[(i + 1) % 3]}, {b[j], b[(j + 1) % 3]}));
    }
    return least;
}

void compare(const Scene& scene, Tally& tally) {
    const Polyhedron moving = scene.moving.polyhedron();
    const Polyhedron fixed = scene.fixed.polyhedron();
    const auto pieces = exact_pieces(scene);
    ExactAnswer truth;
    std::size_t index = 0;
    for (; index < pieces.size() && !truth.first; ++index) {
        const ExactAnswer answer = exact_answer(moving, fixed, pieces[index]);
        truth.first = answer.first;
        truth.overlaps = truth.overlaps || (index == 0 && answer.overlaps);
    }
    const auto whole = [&](double tau) { return (double(index) - 1 + tau) / double(pieces.size()); };
    const FirstContact found = first_contact({.moving = moving, .fixed = fixed, .motion = scene.motion()});
    ++tally.scenes;
    const double bound = bound_of(scene, pieces[0]);
    tally.bound = std::max(tally.bound, bound);
    tally.certain += found.certain && found.verdict != Verdict::clear ? 1 : 0;
    if (truth.overlaps) {
        ++tally.at_start;
        EXPECT_EQ(found.verdict, Verdict::contact_at_start) << "overlap missed";
    } else if (truth.first) {
        ++tally.contacts;
        ASSERT_NE(found.verdict, Verdict::clear) << "missed";
        EXPECT_LE(found.tau.lower, whole(truth.first->upper)) << "late";
        if (found.certain) {
            EXPECT_GE(found.tau.upper, whole(truth.first->lower) * (1 - 1e-15)) << "certain of an earlier contact";
        }
    } else if (found.verdict != Verdict::clear) {
        EXPECT_FALSE(found.certain) << "certain, but there is no contact";
        ++tally.doubtful_alarms;
        const double distance = distance_at(scene, found);
        tally.furthest_alarm = std::max(tally.furthest_alarm, distance);
        EXPECT_LE(distance, bound + 1e-15 * (reach(scene.moving) + reach(scene.fixed))) << "false alarm";
    }
}

/// Runs `count` scenes, checks that enough of them touch, and prints the counts.
void run(const char* what, std::uint64_t seed, int count, const Recipe& recipe) {
    Random random(seed);
    Tally tally;
    for (int i = 0; i < count * times_if_long(30); ++i) {
        SCOPED_TRACE(std::string(what) + ", case " + std::to_string(i));
        try {
            compare(random_scene(random, recipe), tally);
        } catch (const InvalidInput&) { // rounding has put the corners of a face on one line
        }
    }
    std::cout << what << ": " << tally.scenes << " scenes, " << tally.contacts << " contacts, " << tally.at_start
              << " at the start, " << tally.scenes - tally.contacts - tally.at_start << " clear, " << tally.certain
              << " certain, " << tally.doubtful_alarms << " doubtful alarms, the furthest at " << tally.furthest_alarm
              << "; bounds up to " << tally.bound << std::endl;
    EXPECT_GT(tally.scenes, count * times_if_long(30) / 2);
    EXPECT_GT(tally.contacts, tally.scenes / 5);
    EXPECT_EQ(tally.doubtful_alarms, 0) << "exact arithmetic decides every uncertain case";
    EXPECT_EQ(tally.certain, tally.contacts + tally.at_start);
}

constexpr int scenes = 30;

TEST(ExtremeInputs, FacesAlmostWithoutArea) {
    run("slivers", 761, scenes, {.moving = sliver, .fixed = sliver, .angle = 0.7});
    run("slivers and triangles, translated", 762, scenes, {.moving = sliver});
    run("triangles and slivers, cut", 763, scenes / 3, {.fixed = sliver, .angle = 0.5, .max_turn = pi / 18});
}

TEST(ExtremeInputs, EdgesAlmostOfZeroLength) {
    run("tiny edges", 764, scenes, {.moving = with_tiny_edges, .angle = 0.3});
    run("tiny edges on both", 765, scenes, {.moving = with_tiny_edges, .fixed = with_tiny_edges, .angle = 1e-9});
}

TEST(ExtremeInputs, NeedlesAHundredMillionTimesAsLongAsWide) {
    run("needles", 766, scenes, {.moving = needle, .angle = 1.5});
    run("needles on needles", 767, scenes, {.moving = needle, .fixed = needle, .angle = 0.2});
}

TEST(ExtremeInputs, CoordinatesFromABillionthToABillionInOneMesh) {
    run("mixed coordinates", 768, scenes, {.moving = mixed, .fixed = mixed, .angle = 0.4});
    run("mixed and ordinary", 769, scenes, {.fixed = mixed, .angle = 0.4});
}

TEST(ExtremeInputs, BodiesABillionUnitsAway) {
    run("far from the origin", 770, scenes, {.angle = 0.4, .away = 1e9});
    run("far slivers", 771, scenes, {.moving = sliver, .angle = 1e-6, .away = 1e9});
}

TEST(ExtremeInputs, TurnsFromNothingToPi) {
    for (const double angle : {1e-16, 1e-15, 1e-12, 1e-8, 1e-4, 0.1, 1.0, 2.0, 3.0, pi - 2.1e-3})
        run("screw in one piece", 772, scenes / 3, {.angle = angle});
    for (const double angle : {1e-16, 1.0, 3.0, pi})
        run("screw cut", 773, scenes / 3, {.angle = angle, .max_turn = pi / 6});
    for (const double angle : {1e-16, 1e-8, 1.0, 3.0, pi})
        run("sweep", 774, scenes / 3, {.angle = angle, .sweeps = true});
}

/// Whether bodies that move by -2 `way` ever touch. Unlike `exact_answer`, this test has no resolution limit.
bool ever_touch(const Body& moving, const Body& fixed, const Eigen::Vector3d& way) {
    const auto surface = [](const Body& body) {
        return reference::Surface::from_convex_faces(body.vertices, body.faces);
    };
    const auto at = [](const Eigen::Vector3d& place) {
        return reference::ExactPose{reference::exact(place), {1, reference::Triple{}}};
    };
    const reference::Surface first = surface(moving);
    const reference::Surface second = surface(fixed);
    return reference::ExactScene(first, second, reference::screw_path(at(way), at(-way))).first_touch().has_value();
}

/// Triangles around one point, with coordinates from 1e-170 to 1. One triangle falls through this point. Products of
/// four lengths underflow or lose digits.
TEST(ExtremeInputs, ProductsThatUnderflow) {
    Random random(775);
    const auto vanishing = [&] {
        const double smallest = random.uniform(-170, -40);
        Triangle t;
        for (Eigen::Vector3d& corner : t)
            corner = {random.scaled(smallest, smallest + 20), random.scaled(smallest, smallest + 20),
                      random.scaled(smallest, smallest + 20)};
        t[random.chance(0.5) ? 0 : 2] = eigen(random.vector(1));
        return triangle(t[0], t[1], t[2]);
    };
    int scenes_met = 0, contacts = 0, decided_exactly = 0;
    for (int i = 0; i < 40 * times_if_long(30); ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const Eigen::Vector3d way = random_direction(random);
        const Body moving = vanishing();
        const Body fixed = vanishing();
        try {
            const Polyhedron a = moving.polyhedron();
            const Polyhedron b = fixed.polyhedron();
            const bool touches = ever_touch(moving, fixed, way);
            const FirstContact found =
                first_contact({.moving = a,
                               .fixed = b,
                               .motion = ScrewMotion::between(Pose(way, Eigen::Quaterniond::Identity()),
                                                              Pose(-way, Eigen::Quaterniond::Identity()))});
            EXPECT_EQ(found.verdict != Verdict::clear, touches);
            EXPECT_TRUE(found.certain);
            ++scenes_met;
            contacts += touches ? 1 : 0;
            decided_exactly += found.work.exact > 0 ? 1 : 0;
        } catch (const InvalidInput&) { // a face without area
        }
    }
    std::cout << scenes_met << " scenes, " << contacts << " contacts, " << decided_exactly << " decided exactly\n";
    EXPECT_GT(contacts, scenes_met / 20);
    EXPECT_LT(contacts, scenes_met);
    EXPECT_GT(decided_exactly, scenes_met / 20);
}

/// A cube that comes from far away onto another one, and turns on the way. The goal is inside: a contact is certain.
TEST(ExtremeInputs, MotionsFromTooFarAwayAreRefusedUnlessTheyAreExact) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const auto asked = [&](const auto& motion_between, double from) {
        const Motion motion = motion_between(shifted(0.1, 0.2, from), turned({0.1, 0.2, 0}, {1, 2, 3}, 1.2));
        return first_contact({.moving = cube, .fixed = cube, .motion = motion});
    };
    const auto velocity = [](const Pose& start, const Pose& goal) { return Motion::velocity(start, goal); };
    const auto twist = [](const Pose& start, const Pose& goal) { return Motion::twist(start, goal); };
    const auto screw = [](const Pose& start, const Pose& goal) { return Motion::screw(start, goal); };
    const auto sweep = [](const Pose& start, const Pose& goal) { return Motion::sweep(start, goal); };
    const auto expect_exact = [&](const auto& motion, double from) {
        const FirstContact found = asked(motion, from);
        EXPECT_EQ(found.verdict, Verdict::contact) << from;
        EXPECT_TRUE(found.certain) << from;
        EXPECT_LE(found.clear_until, 1 - 0.4 / from) << from; // the corners reach the other cube before
        EXPECT_GE(found.time.upper, 1 - 1.8 / from) << from;
    };
    for (const double from : {1e3, 1e9, 2e9}) {
        expect_exact(velocity, from);
        expect_exact(twist, from);
    }
    for (const double from : {1e9, 1e12, 1e20}) {
        expect_exact(screw, from);
        expect_exact(sweep, from);
    }
    for (const double from : {1e11, 1e15, 1e30}) {
        EXPECT_EQ(refusal([&] { (void)asked(velocity, from); }).substr(0, 20), "motion: goes up to 1");
        EXPECT_NE(refusal([&] { (void)asked(twist, from); }).find("1e10 times the radius of the larger body, 0.866"),
                  std::string::npos);
    }
}

/// Batches and paths refuse them before they answer anything, and name them.
TEST(ExtremeInputs, AMotionFromTooFarAwayIsNamed) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    const auto towards = [&](double from) {
        return Motion::velocity(shifted(0, 0, from), turned({0, 0, 3}, {1, 2, 3}, 1.2));
    };
    const std::vector<Motion> motions{towards(7), towards(1e20), towards(8)};
    std::size_t done = 0;
    const auto count = [&](std::size_t rows) { done = rows; };
    const std::string why = "motions[1]: goes up to 1e+20 far";
    EXPECT_EQ(refusal([&] {
                  (void)first_contact_batch(
                      {.moving = cube, .fixed = cube, .motions = motions, .batch = {.progress = count}});
              }).substr(0, why.size()),
              why);
    EXPECT_EQ(refusal([&] {
                  (void)least_distance_batch(
                      {.moving = cube, .fixed = cube, .motions = motions, .batch = {.progress = count}});
              }).substr(0, why.size()),
              why);
    EXPECT_EQ(refusal([&] {
                  (void)first_contact_on_path({.moving = cube, .fixed = cube, .motions = motions, .progress = count});
              }).substr(0, why.size()),
              why);
    EXPECT_EQ(done, 0U);
    EXPECT_EQ(refusal([&] { check_motion(cube, cube, motions[0]); }), "accepted");
    EXPECT_EQ(refusal([&] { check_motion(cube, cube, motions[1]); }).substr(0, 7), "motion:");
}

} // namespace
} // namespace chasles::test
