// Clear motions of bodies that stay apart by 0.3 to 1 body size, with turns of 10 to 60 degrees: the queries that
// robots and scenes send most. Each time includes making the motion. Margin queries check the clearance of each motion.
#include "bench/bodies.h"
#include "bench/draw.h"
#include "bench/generated_bodies.h"
#include "chasles/chasles.h"
#include "chasles/culling/clearly_apart.h"
#include "chasles/culling/far_apart.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace chasles::bench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;
constexpr double least_clearance = 0.3;
constexpr double greatest_clearance = 1;

struct Ends {
    Pose start;
    Pose goal;
};

struct ClearCase {
    NamedBody body;
    std::vector<Ends> motions;
};

/// The middle and the longest side of the bounding box.
struct Extent {
    Vector3d centre;
    double length;
};

Extent extent_of(const Polyhedron& body) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : body.vertices())
        box.extend(vertex);
    return {box.center(), box.sizes().maxCoeff()};
}

FirstContact answer(const Polyhedron& body, const Ends& ends, double margin, Find find) {
    return first_contact({.moving = body,
                          .fixed = body,
                          .motion = ScrewMotion::between(ends.start, ends.goal),
                          .options = {.margin = margin, .find = find}});
}

/// Some 400 vertices of the body.
std::vector<Vector3d> some_vertices(const Polyhedron& body) {
    std::vector<Vector3d> chosen;
    const std::size_t step = std::max<std::size_t>(1, body.vertices().size() / 400);
    for (std::size_t i = 0; i < body.vertices().size(); i += step)
        chosen.push_back(body.vertices()[i]);
    return chosen;
}

/// The least distance of these vertices at nine times of the motion.
double sampled_distance(const std::vector<Vector3d>& vertices, const Ends& ends) {
    const ScrewMotion motion = ScrewMotion::between(ends.start, ends.goal);
    double least = INFINITY;
    for (int i = 0; i <= 8; ++i) {
        const Eigen::Isometry3d pose = motion.pose_at(i / 8.0).isometry();
        for (const Vector3d& vertex : vertices) {
            const Vector3d moved = pose * vertex;
            for (const Vector3d& other : vertices)
                least = std::min(least, (moved - other).squaredNorm());
        }
    }
    return std::sqrt(least);
}

/// Whether the least distance during the motion is in the range of this benchmark. Sampled distances are too large.
bool has_clearance(const Polyhedron& body, const std::vector<Vector3d>& vertices, const Ends& ends, double size) {
    const double sampled = sampled_distance(vertices, ends);
    return sampled >= least_clearance * size && sampled <= greatest_clearance * size &&
           answer(body, ends, least_clearance * size, Find::any).verdict == Verdict::clear;
}

/// Two copies of a body. The moving copy moves by half a body size in any direction and turns about its middle.
ClearCase case_of(NamedBody body, std::size_t count) {
    const auto [centre, length] = extent_of(body.body);
    Draw draw(31);
    const auto pose = [&](const Vector3d& place, const Quaterniond& orientation) {
        return Pose(Vector3d(centre + place - orientation * centre), orientation);
    };
    const std::vector<Vector3d> vertices = some_vertices(body.body);
    std::vector<Ends> motions;
    while (motions.size() < count) {
        const Quaterniond orientation = draw.turn(0, std::numbers::pi);
        const Vector3d from = draw.between(1, 3) * length * draw.direction();
        const Vector3d way = 0.5 * length * draw.direction();
        const Quaterniond goal = draw.turn(10 * degree, 60 * degree) * orientation;
        const Ends ends{pose(from, orientation), pose(from + way, goal)};
        if (has_clearance(body.body, vertices, ends, length))
            motions.push_back(ends);
    }
    return {std::move(body), std::move(motions)};
}

double microseconds_of(const Polyhedron& body, const Ends& ends, Find find) {
    const auto start = std::chrono::steady_clock::now();
    const FirstContact found = answer(body, ends, 0, find);
    const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - start;
    if (found.verdict != Verdict::clear)
        std::abort();
    return taken.count();
}

/// The value below which a share of the sorted numbers lies.
double at_share(const std::vector<double>& sorted, double share) {
    return sorted[std::min(sorted.size() - 1, std::size_t(share * double(sorted.size())))];
}

void print(const char* what, std::vector<double> times) {
    std::sort(times.begin(), times.end());
    std::printf("  %-34s median %6.2f us, 10 %% %6.2f, 90 %% %6.2f, 99 %% %6.2f\n", what, at_share(times, 0.5),
                at_share(times, 0.1), at_share(times, 0.9), at_share(times, 0.99));
}

/// `again`: the least of 20 calls in a row for each motion. `in turn`: one call for each motion, then the next motion.
void print_times(const ClearCase& test, Find find) {
    std::vector<double> again, in_turn;
    for (const Ends& ends : test.motions)
        in_turn.push_back(microseconds_of(test.body.body, ends, find));
    for (const Ends& ends : test.motions) {
        double least = microseconds_of(test.body.body, ends, find);
        for (int i = 1; i < 20; ++i)
            least = std::min(least, microseconds_of(test.body.body, ends, find));
        again.push_back(least);
    }
    const std::string name = find == Find::any ? "any" : "first";
    print((name + ", each motion once, in turn").c_str(), in_turn);
    print((name + ", each motion again and again").c_str(), again);
}

/// Which part of the query proves the motions clear.
void print_stages(const ClearCase& test) {
    const Body& body = test.body.body.body();
    int balls = 0, coarse = 0;
    for (const Ends& ends : test.motions) {
        const Motion motion = ScrewMotion::between(ends.start, ends.goal);
        if (culling::are_far_apart(body, body, motion.trajectory()))
            ++balls;
        else if (culling::are_clearly_apart(body, body, motion.trajectory()))
            ++coarse;
    }
    const double unit = 100 / double(test.motions.size());
    std::printf("%s, %zu clear motions: proven by balls %.0f %%, by the coarse motion %.0f %%, by the search %.0f %%\n",
                test.body.name.c_str(), test.motions.size(), unit * balls, unit * coarse,
                100 - unit * (balls + coarse));
}

int run() {
    std::vector<ClearCase> cases;
    cases.push_back(case_of({"torus 3.7k", bumpy_torus(43, 43)}, 300));
    cases.push_back(case_of({"torus 237k", bumpy_torus(344, 344)}, 300));
    if (const auto file = data_file("meshes/spot.obj"))
        cases.push_back(case_of({"spot 5.9k", Polyhedron::load(*file, {.triangulate = true})}, 300));
    cases.push_back(case_of(large_body(), 300));
    cases.push_back(case_of({"ellipsoid 0.3k", ellipsoid({0.5, 0.8, 0.6}, 2)}, 300));
    cases.push_back(case_of({"peg", peg({48, 1, 2})}, 300));
    for (const ClearCase& test : cases) {
        print_stages(test);
        for (const Find find : {Find::first, Find::any})
            print_times(test, find);
    }
    return 0;
}

} // namespace
} // namespace chasles::bench

int main() {
    return chasles::bench::run();
}
