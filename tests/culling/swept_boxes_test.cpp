// Nodes over patches that touch at a known time are never separated at this time, for any motion. The windows in which
// they may touch are barely wider than necessary.
#include "chasles/culling/body_ball.h"
#include "chasles/culling/time_tree.h"
#include "chasles/mesh/body.h"
#include "tests/query/bodies.h"
#include "tests/support/posed_motions.h"
#include "tests/support/surface_distance.h"
#include "tests/support/trajectories.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using culling::TimeInterval;
using culling::TimeRange;
using culling::Window;

/// A few triangles close to a plane through the origin.
Body random_patch(Random& random, double size) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(random.uniform(0, 3), eigen(random.vector(1)).normalized()));
    const double thickness = random.chance(0.3) ? 0 : std::abs(random.scaled(-4, 0));
    Body body;
    const int triangles = random.integer(2, 4); // a root and its children at least
    for (int i = 0; i < 3 * triangles; ++i) {
        const auto v = random.vector(size);
        body.vertices.emplace_back(turn * Eigen::Vector3d(v.x, v.y, thickness * v.z));
    }
    for (std::uint32_t i = 0; i < std::uint32_t(triangles); ++i)
        body.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    return body;
}

/// The position of a body point at tau in the frame of the fixed body.
Eigen::Vector3d position(const motion::ControlMaps<DoubleDouble>& maps, const Eigen::Vector3d& point, double tau) {
    const Vector3<DoubleDouble> p{DoubleDouble(point.x()), DoubleDouble(point.y()), DoubleDouble(point.z())};
    const auto path = maps.rotation * p + maps.translation;
    const DoubleDouble weight = value_at(maps.weight, DoubleDouble(tau));
    Eigen::Vector3d result;
    for (int i = 0; i < 3; ++i)
        result[i] = double(value_at(path[i], DoubleDouble(tau)) / weight);
    return result;
}

/// Two patches that touch at `tau`. At this tau they are on opposite sides of a plane.
struct Scene {
    motion::RationalMotion<DoubleDouble> motion;
    motion::ControlMaps<double> maps;
    Polyhedron moving;
    Polyhedron fixed;
    double tau;

    static Scene random_scene(Random& random) {
        const double size = std::abs(random.scaled(-3, 3));
        const auto motion = random_posed_motion(random, size).made;
        const auto exactly = motion::control_maps(motion);
        const Body patch = random_patch(random, size * std::abs(random.scaled(-3, 0)));
        Body other = random_patch(random, size * std::abs(random.scaled(-3, 0)));
        const double tau = random.uniform(0, 1);
        const Eigen::Vector3d normal = eigen(random.vector(1)).normalized();
        const auto along = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
            return normal.dot(a) < normal.dot(b);
        };
        std::vector<Eigen::Vector3d> there;
        for (const Eigen::Vector3d& vertex : patch.vertices)
            there.push_back(position(exactly, vertex, tau));
        const Eigen::Vector3d touching = *std::max_element(there.begin(), there.end(), along);
        const Eigen::Vector3d lowest = *std::min_element(other.vertices.begin(), other.vertices.end(), along);
        for (Eigen::Vector3d& vertex : other.vertices)
            vertex += touching - lowest;
        return {motion, motion::double_maps(motion), patch.polyhedron(), other.polyhedron(), tau};
    }

    [[nodiscard]] TimeInterval interval(const TimeRange& range) const {
        const auto reach = [](const Polyhedron& body) {
            const motion::Ball ball = culling::ball_around(body.body().bvh());
            return ball.centre.cwiseAbs().maxCoeff() + ball.radius;
        };
        const motion::Ball a = culling::ball_around(moving.body().bvh());
        const motion::Ball b = culling::ball_around(fixed.body().bvh());
        const auto scale = elementary::error_scale(
            maps, std::max(reach(moving), motion.reference_extent) + motion::rounding_extent(motion), reach(fixed));
        return culling::TimeTree({maps, scale}, motion::ChordDeviation(motion, a, b), a, b).interval(range);
    }

    /// Two nodes of a hierarchy and their indices.
    struct Two {
        std::array<std::size_t, 2> at;
        culling::TwoNodes nodes;
    };

    /// Each node paired with itself, and the two children of each inner node.
    static std::vector<Two> twos(const Polyhedron& body) {
        const auto nodes = body.body().bvh().nodes();
        std::vector<Two> result;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            result.push_back({{i, i}, {&nodes[i], &nodes[i]}});
            if (const std::size_t child = nodes[i].first; !nodes[i].is_leaf())
                result.push_back({{child, child + 1}, {&nodes[child], &nodes[child + 1]}});
        }
        return result;
    }

    /// Calls `see` with every pair of nodes and its window, in all combinations.
    template <class See>
    void for_all_pairs(const TimeInterval& interval, See see) const {
        for (const Two& a : twos(moving))
            for (const Two& b : twos(fixed)) {
                const auto windows = interval.boxes.overlap_windows(a.nodes, b.nodes, {});
                for (std::size_t i : {0U, 1U})
                    for (std::size_t j : {0U, 1U})
                        see(a.at[i], b.at[j], windows[2 * i + j]);
            }
    }
};

/// A dyadic range around tau.
TimeRange random_range(Random& random, double tau) {
    const double width = std::ldexp(1.0, -random.integer(0, 10));
    const double lower = std::min(std::floor(tau / width) * width, 1 - width);
    return {lower, lower + width};
}

/// Whether the touching vertex is below a node.
bool holds(const Polyhedron& body, std::size_t node, const Eigen::Vector3d& vertex) {
    const BvhNode& top = body.body().bvh().nodes()[node];
    if (!top.is_leaf())
        return holds(body, top.first, vertex) || holds(body, top.first + 1U, vertex);
    for (const std::uint32_t corner : body.face(top.first))
        if (body.vertices()[corner] == vertex)
            return true;
    return false;
}

TEST(SweptBoxes, NodesThatTouchMayMeetThen) {
    Random random(751);
    int pairs = 0, narrow = 0;
    for (int trial = 0; trial < 3000 * times_if_long(30); ++trial) {
        const Scene scene = Scene::random_scene(random);
        const auto exactly = motion::control_maps(scene.motion);
        const TimeInterval interval = scene.interval(random_range(random, scene.tau));
        const double place = (scene.tau - interval.range.lower) / interval.range.width();
        // The touching vertices are nearest to each other at tau.
        double nearest = std::numeric_limits<double>::infinity();
        Eigen::Vector3d moving_vertex, fixed_vertex;
        for (const Eigen::Vector3d& a : scene.moving.vertices())
            for (const Eigen::Vector3d& b : scene.fixed.vertices())
                if (const double gap = (position(exactly, a, scene.tau) - b).norm(); gap < nearest) {
                    nearest = gap;
                    moving_vertex = a;
                    fixed_vertex = b;
                }
        scene.for_all_pairs(interval, [&](std::size_t a, std::size_t b, const Window& window) {
            if (!holds(scene.moving, a, moving_vertex) || !holds(scene.fixed, b, fixed_vertex))
                return;
            ++pairs;
            narrow += window.upper - window.lower < 0.1F ? 1 : 0;
            ASSERT_LE(double(window.lower), place) << "seed 751, trial " << trial;
            ASSERT_GE(double(window.upper), place) << "seed 751, trial " << trial;
        });
    }
    EXPECT_GT(pairs, 3000);
    EXPECT_GT(narrow, pairs / 20);
}

/// The distance of the faces below two nodes at tau.
double distance_below(const Scene& scene, const motion::ControlMaps<DoubleDouble>& maps, double tau, std::size_t a,
                      std::size_t b) {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t f = 0; f < scene.moving.face_count(); ++f)
        for (std::uint32_t g = 0; g < scene.fixed.face_count(); ++g) {
            const auto moving = scene.moving.body().face(f), fixed = scene.fixed.body().face(g);
            if (!holds(scene.moving, a, scene.moving.vertices()[moving[0]]) ||
                !holds(scene.fixed, b, scene.fixed.vertices()[fixed[0]]))
                continue;
            Triangle3<double> moved, there;
            for (std::size_t i = 0; i < 3; ++i) {
                const Eigen::Vector3d p = position(maps, scene.moving.vertices()[moving[i]], tau);
                const Eigen::Vector3d q = scene.fixed.vertices()[fixed[i]];
                moved[i] = {p.x(), p.y(), p.z()};
                there[i] = {q.x(), q.y(), q.z()};
            }
            least = std::min(least, std::sqrt(squared_distance_of_triangles<double>(moved, there)));
        }
    return least;
}

/// The gap of the faces below two nodes along a vector at tau, and the farthest distance of their corners.
std::array<double, 2> gap_below(const Scene& scene, const motion::ControlMaps<DoubleDouble>& maps, double tau,
                                std::size_t a, std::size_t b, const Eigen::Vector3d& along) {
    double gap = std::numeric_limits<double>::infinity(), farthest = 0;
    for (const Eigen::Vector3d& p : scene.moving.vertices())
        for (const Eigen::Vector3d& q : scene.fixed.vertices())
            if (holds(scene.moving, a, p) && holds(scene.fixed, b, q)) {
                const Eigen::Vector3d apart = position(maps, p, tau) - q;
                gap = std::min(gap, along.dot(apart));
                farthest = std::max(farthest, apart.norm());
            }
    return {gap, farthest};
}

TEST(SweptBoxes, GapsAreNoWiderThanTheFacesAreApart) {
    Random random(753);
    int pairs = 0, wide = 0, wide_along = 0, apart = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const Scene scene = Scene::random_scene(random);
        const auto maps = motion::control_maps(scene.motion);
        const TimeInterval interval = scene.interval(random_range(random, scene.tau));
        for (const Scene::Two& a : Scene::twos(scene.moving))
            for (const Scene::Two& b : Scene::twos(scene.fixed)) {
                const auto gaps = interval.boxes.widest_gaps(a.nodes, b.nodes);
                for (std::size_t i : {0U, 1U})
                    for (std::size_t j : {0U, 1U}) {
                        const std::size_t lane = 2 * i + j;
                        const auto distance = [&](double tau) {
                            return distance_below(scene, maps, tau, a.at[i], b.at[j]);
                        };
                        const double at_start = distance(interval.range.lower);
                        ASSERT_LE(double(gaps.start[lane]), at_start * (1 + 1e-9)) << "seed 753, trial " << trial;
                        const Eigen::Vector3d along(double(gaps.along[0][lane]), double(gaps.along[1][lane]),
                                                    double(gaps.along[2][lane]));
                        const auto [gap, farthest] =
                            gap_below(scene, maps, interval.range.lower, a.at[i], b.at[j], along);
                        ASSERT_LE(along.norm(), 1) << "seed 753, trial " << trial;
                        ASSERT_LE(double(gaps.start[lane]), gap + 0x1p-19 * farthest) << "seed 753, trial " << trial;
                        wide_along += double(gaps.start[lane]) > 0.5 * gap ? 1 : 0;
                        if (gaps.on_way[lane] > 0) {
                            ++apart;
                            ASSERT_GT(distance(scene.tau), 1e-12 * at_start) << "seed 753, trial " << trial;
                            ASSERT_GT(distance(interval.range.at(0.5)), 0) << "seed 753, trial " << trial;
                        }
                        ++pairs;
                        wide += double(gaps.start[lane]) > 0.5 * at_start ? 1 : 0;
                    }
            }
    }
    EXPECT_GT(wide, pairs / 4);
    EXPECT_GT(wide_along, pairs / 4);
    EXPECT_GT(apart, pairs / 10);
}

/// Resting patches of one flat triangle each, with random orientation: patches that a plane along a slab separates are
/// separated.
TEST(SweptBoxes, ParallelPatchesAreToldApartByTheirSlabs) {
    Random random(752);
    int apart = 0, boxes_apart = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const Eigen::Quaterniond turn = random_rotation(random).normalized();
        const auto sheet = [&](double height) {
            Body body;
            for (int i = 0; i < 6; ++i)
                body.vertices.emplace_back(turn *
                                           Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), height));
            body.faces = {{0, 1, 2}, {3, 4, 5}};
            return body.polyhedron();
        };
        const auto motion = cubic_of(ScrewMotion::between(Pose(), Pose()));
        const Scene scene{motion, motion::double_maps(motion), sheet(0), sheet(0.05), 0};
        const auto a = scene.moving.body().bvh().nodes();
        const auto b = scene.fixed.body().bvh().nodes();
        const auto windows = scene.interval({}).boxes.overlap_windows({&a[1], &a[2]}, {&b[0], &b[0]}, {});
        for (const std::size_t child : {0U, 2U})
            apart += windows[child].is_empty() ? 1 : 0;
        for (std::size_t child : {1U, 2U}) {
            bool free = false;
            for (std::size_t axis = 0; axis < 3; ++axis) // both bodies have the same centre up to the height
                free = free || a[child].lower[axis] > b[0].upper[axis] || b[0].lower[axis] > a[child].upper[axis];
            boxes_apart += free ? 1 : 0;
        }
    }
    EXPECT_GT(apart, 950);
    EXPECT_LT(boxes_apart, 300);
}

/// A box moves straight past a resting box. The window is exactly the time during which their projections overlap.
TEST(SweptBoxes, WindowsOfAStraightMotionAreExact) {
    const Polyhedron body = box({1, 1, 1}).polyhedron();
    const auto motion = cubic_of(ScrewMotion::between(Pose({-8, 0, 0}, Eigen::Quaterniond::Identity()),
                                                      Pose({8, 0, 0}, Eigen::Quaterniond::Identity())));
    const Scene scene{motion, motion::double_maps(motion), body, body, 0};
    const auto nodes = body.body().bvh().nodes();
    float first = 1, last = 0;
    for (const Window& window :
         scene.interval({}).boxes.overlap_windows({&nodes[1], &nodes[2]}, {&nodes[0], &nodes[0]}, {})) {
        first = std::min(first, window.lower);
        last = std::max(last, window.upper);
    }
    EXPECT_NEAR(double(first), 6.0 / 16, 1e-5);
    EXPECT_NEAR(double(last), 10.0 / 16, 1e-5);
}

TEST(SweptBoxes, WindowsStayWithinTheGivenOne) {
    const Polyhedron body = box({1, 1, 1}).polyhedron();
    const auto motion = cubic_of(ScrewMotion::between(Pose(), Pose({0, 0.1, 0}, Eigen::Quaterniond::Identity())));
    const Scene scene{motion, motion::double_maps(motion), body, body, 0};
    const auto nodes = body.body().bvh().nodes();
    for (const Window& window :
         scene.interval({}).boxes.overlap_windows({&nodes[0], &nodes[0]}, {&nodes[1], &nodes[2]}, {0.25F, 0.5F})) {
        EXPECT_EQ(window.lower, 0.25F);
        EXPECT_EQ(window.upper, 0.5F);
    }
}

TEST(PartAround, IsTheLeastOneThatHoldsWhatIsNeeded) {
    Random random(753);
    for (int trial = 0; trial < 10000; ++trial) {
        const double width = std::ldexp(1.0, -random.integer(0, 10));
        const double lower = width * random.integer(0, int(1 / width) - 1);
        const TimeRange interval{lower, lower + width};
        const double first = interval.at(random.uniform(0, 1));
        const double last = std::min(interval.upper, first + width * std::abs(random.scaled(-9, 0)));
        const TimeRange part = culling::part_around(interval, {first, last}, 0x1p-40);
        EXPECT_GE(part.lower, interval.lower);
        EXPECT_LE(part.upper, interval.upper);
        EXPECT_LE(part.lower, first);
        EXPECT_GE(part.upper, last);
        EXPECT_LE(part.width(), std::max(0x1p-40, 2.7 * (last - first)));
        EXPECT_EQ(std::exp2(std::round(std::log2(part.width()))), part.width());
    }
}

TEST(Window, IsCutOutward) {
    Random random(773);
    for (int trial = 0; trial < 10000; ++trial) {
        const auto lower = float(random.uniform(0, 1) * std::ldexp(1.0, -random.integer(0, 30)));
        const culling::Window when{lower, float(random.uniform(double(lower), 1))};
        const double width = double(when.upper) - when.lower;
        const double share = random.uniform(0, 1) * std::ldexp(1.0, -random.integer(0, 30));
        const double time = when.lower + share * width;
        const culling::Window left = culling::from_share(when, share);
        const culling::Window early = culling::until(when, time);
        EXPECT_LE(left.lower, time);
        EXPECT_GE(left.lower, when.lower);
        EXPECT_NEAR(left.lower, time, 2e-6 * time);
        EXPECT_EQ(left.upper, when.upper);
        EXPECT_GE(early.upper, std::min(time, double(when.upper)));
        EXPECT_LE(early.upper, when.upper);
        EXPECT_NEAR(early.upper, time, 2e-6 * time);
        EXPECT_EQ(early.lower, when.lower);
    }
}

} // namespace
} // namespace chasles::test
