// The meshes are closed, have the right size, lie on the helicoid, are invariant under a screw by one facet, and keep
// their bounds.
#include "scenes/threaded_fastener.h"

#include "chasles/base/invalid_input.h"
#include "tests/scenes/mesh_measures.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace chasles::scenes {
namespace {

using std::numbers::pi;

std::vector<ThreadedFastener> sizes() {
    ThreadedFastener coarse{.segments = 24};
    ThreadedFastener fine{.segments = 97};
    ThreadedFastener m5{5, 0.8, 12.3, 3.5, 4.7, 8, 0.05, 36};
    ThreadedFastener odd{10, 1.5, 17.77, 6, 8.31, 17, 0.123, 31};
    return {{}, coarse, fine, m5, odd};
}

double hexagon_area(double width_across_flats) {
    return std::numbers::sqrt3 / 2 * std::pow(width_across_flats, 2);
}

// The axial position of a point on the thread's profile, from the middle of a crest.
double axial_place(const MetricThread& thread, const Eigen::Vector3d& point) {
    return point.z() - thread.lead(std::atan2(point.y(), point.x()));
}

double radius(const Eigen::Vector3d& point) {
    return point.head<2>().norm();
}

// The faces of the thread: faces without a corner on an end plane or on the hexagon.
std::vector<std::size_t> thread_faces(const Polyhedron& body, const ThreadedFastener& size, double height) {
    std::vector<std::size_t> faces;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        const auto corners = corners_of(body, face);
        const bool is_inside = std::ranges::all_of(corners, [&](const Eigen::Vector3d& corner) {
            return corner.z() > 0 && corner.z() < height && radius(corner) < 0.51 * size.nominal_diameter;
        });
        if (is_inside)
            faces.push_back(face);
    }
    return faces;
}

// a(n) of the derivation, by sampling.
double angle_error(int segments) {
    const double half = pi / segments;
    double worst = 0;
    for (double s = 0; s <= 1; s += 1e-4)
        worst = std::max(worst, std::atan(s * std::tan(half)) - s * half);
    return worst;
}

template <class Visit>
void for_points_of(const Corners& corner, Visit&& visit) {
    constexpr int steps = 8;
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j) {
            visit((i * corner[0] + j * corner[1] + (steps - i - j) * corner[2]) / steps);
        }
    }
}

TEST(ThreadedFastener, BodiesAreClosedAndOriented) {
    for (const ThreadedFastener& size : sizes()) {
        for (const Polyhedron& body : {bolt(size), nut(size)}) {
            EXPECT_EQ(unpaired_edges(body), 0) << size.segments;
            EXPECT_GT(volume(body), 0) << size.segments;
            EXPECT_TRUE(body.report().closed);
            EXPECT_EQ(body.report().nonmanifold_edges, 0U);
            EXPECT_EQ(body.report().distinct_vertices, body.vertex_count());
        }
    }
}

TEST(ThreadedFastener, TheBoltIsABallAndTheNutARing) {
    const auto euler_characteristic = [](const Polyhedron& body) {
        const MeshReport report = body.report();
        return static_cast<int>(report.vertices + report.faces) - static_cast<int>(report.edges);
    };
    EXPECT_EQ(euler_characteristic(bolt({})), 2);
    EXPECT_EQ(euler_characteristic(nut({})), 0);
}

// Without diagonals the section of a faceted thread would be sin(2 pi/n) / (2 pi/n) of the exact section. The diagonals
// remove material from both bodies, at every flank less than where they cross (derivation 09).
TEST(ThreadedFastener, VolumesAreThoseOfTheProfile) {
    const auto lost = [](const MetricThread& thread, double height, int segments) {
        const double outer = thread.crest_radius();
        const double inner = thread.root_radius();
        const double depth = thread.pitch / segments * (outer - inner) / (2 * (outer + inner));
        return 2 * height / thread.pitch * pi * (outer * outer - inner * inner) * depth;
    };
    for (const ThreadedFastener& size : sizes()) {
        const double turn = 2 * pi / size.segments;
        const double hexagon = hexagon_area(size.width_across_flats);
        const double screw = size.bolt_thread().section_area() * size.bolt_length * std::sin(turn) / turn;
        const double hole = size.nut_thread().section_area() * size.nut_height * std::sin(turn) / turn;
        const double bolt_loss = hexagon * size.head_height + screw - volume(bolt(size));
        const double nut_loss = hexagon * size.nut_height - hole - volume(nut(size));
        EXPECT_GT(bolt_loss, 0);
        EXPECT_LT(bolt_loss, lost(size.bolt_thread(), size.bolt_length, size.segments));
        EXPECT_GT(nut_loss, 0);
        EXPECT_LT(nut_loss, lost(size.nut_thread(), size.nut_height, size.segments));
    }
}

TEST(ThreadedFastener, CornersLieOnTheHelicoid) {
    for (const ThreadedFastener& size : sizes()) {
        const Polyhedron screw = bolt(size);
        const MetricThread thread = size.bolt_thread();
        const auto faces = thread_faces(screw, size, size.bolt_length);
        EXPECT_GT(faces.size(), screw.face_count() / 2);
        for (const std::size_t face : faces) {
            for (const Eigen::Vector3d& corner : corners_of(screw, face)) {
                ASSERT_NEAR(radius(corner), thread.radius_at(axial_place(thread, corner)), 1e-12);
            }
        }
    }
}

// A screw by one facet maps the mesh onto itself, including the diagonals.
TEST(ThreadedFastener, IsUnchangedByAScrewOfOneFacet) {
    const ThreadedFastener size{.bolt_length = 12, .nut_height = 9, .segments = 24};
    const auto key = [](const Eigen::Vector3d& point) {
        return std::array<long, 3>{std::lround(point.x() * 1e7), std::lround(point.y() * 1e7),
                                   std::lround(point.z() * 1e7)};
    };
    const auto key_of = [&](const Corners& corner, const Eigen::Isometry3d& motion) {
        std::set<std::array<long, 3>> keys;
        for (const Eigen::Vector3d& point : corner)
            keys.insert(key(motion * point));
        return keys;
    };
    const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d one_facet(Eigen::AngleAxisd(2 * pi / size.segments, Eigen::Vector3d::UnitZ()));
    one_facet.translation().z() = size.pitch / size.segments;
    for (const auto& [body, height] : {std::pair{bolt(size), size.bolt_length}, {nut(size), size.nut_height}}) {
        std::set<std::set<std::array<long, 3>>> triangles;
        const auto faces = thread_faces(body, size, height);
        for (const std::size_t face : faces)
            triangles.insert(key_of(corners_of(body, face), still));
        int moved = 0;
        for (const std::size_t face : faces) {
            const Corners corner = corners_of(body, face);
            if (std::ranges::max(corner, {}, [](const auto& p) { return p.z(); }).z() > height - 0.1)
                continue;
            ASSERT_TRUE(triangles.contains(key_of(corner, one_facet))) << "face " << face;
            ++moved;
        }
        EXPECT_GT(moved, 500);
    }
}

// Derivation 09: the bolt exceeds its profile by at most a(n), the nut by at most a(n) and the chord error.
TEST(ThreadedFastener, FacetsKeepWithinTheirBoundsAndNearlyReachThem) {
    for (const ThreadedFastener& size : sizes()) {
        const double slack = size.bolt_thread().lead(angle_error(size.segments)) + 1e-12;
        const auto widest = [&](const MetricThread& thread, double at) {
            return std::max(thread.radius_at(at - slack), thread.radius_at(at + slack));
        };
        const auto narrowest = [&](const MetricThread& thread, double at) {
            return std::min(thread.radius_at(at - slack), thread.radius_at(at + slack));
        };
        const Polyhedron screw = bolt(size);
        for (const std::size_t face : thread_faces(screw, size, size.bolt_length)) {
            for_points_of(corners_of(screw, face), [&](const Eigen::Vector3d& point) {
                const MetricThread thread = size.bolt_thread();
                ASSERT_LE(radius(point), widest(thread, axial_place(thread, point)) + 1e-12);
            });
        }
        const Polyhedron ring = nut(size);
        double worst = 0;
        for (const std::size_t face : thread_faces(ring, size, size.nut_height)) {
            for_points_of(corners_of(ring, face), [&](const Eigen::Vector3d& point) {
                const MetricThread thread = size.nut_thread();
                worst = std::max(worst, narrowest(thread, axial_place(thread, point)) - radius(point));
            });
        }
        EXPECT_LE(worst, radial_facet_error(size) + 1e-12);
        EXPECT_GE(worst, 0.99 * radial_facet_error(size));
    }
}

TEST(ThreadedFastener, RefusesFacetsThatTakeAllOfTheClearance) {
    EXPECT_THROW((void)nut({.radial_clearance = 0.01, .segments = 48}), InvalidInput);
    EXPECT_THROW((void)bolt({.segments = 14}), InvalidInput);
    EXPECT_NO_THROW((void)nut({.radial_clearance = 0.02, .segments = 48}));
}

TEST(ThreadedFastener, RefusesSizesThatMakeNoBody) {
    EXPECT_THROW((void)bolt({.pitch = 0}), InvalidInput);
    EXPECT_THROW((void)bolt({.nominal_diameter = NAN}), InvalidInput);
    EXPECT_THROW((void)bolt({.nominal_diameter = 2, .pitch = 2}), InvalidInput);
    EXPECT_THROW((void)nut({.width_across_flats = 17}), InvalidInput);
    EXPECT_THROW((void)nut({.segments = 3}), InvalidInput);
}

} // namespace
} // namespace chasles::scenes
