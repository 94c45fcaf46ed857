// What other motions than the paper's screw cost: constant velocity and constant twist beside the screw between the
// same poses, in one run. Each time includes making the motion. A ratio is that of the least of several calls in turn.
#include "bench/bodies.h"
#include "bench/draw.h"
#include "bench/generated_bodies.h"
#include "chasles/chasles.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

namespace chasles::bench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;
constexpr std::size_t motions_of_case = 200;
constexpr int calls = 7;

struct Ends {
    Pose start;
    Pose goal;
    Vector3d centre; ///< of the body, which moves straight
};

enum class Kind : std::uint8_t { screw, velocity, twist };
constexpr std::array kinds{Kind::screw, Kind::velocity, Kind::twist};

Motion motion_between(const Ends& ends, Kind kind) {
    switch (kind) {
    case Kind::velocity:
        return ConstantVelocity::between(ends.start, ends.goal, ends.centre);
    case Kind::twist:
        return ConstantTwist::between(ends.start, ends.goal);
    default:
        return ScrewMotion::between(ends.start, ends.goal);
    }
}

FirstContact answer(const Polyhedron& body, const Ends& ends, Kind kind) {
    return first_contact({.moving = body, .fixed = body, .motion = motion_between(ends, kind)});
}

/// Motions of a body past or towards its copy, by some half of its length, with one turn about its middle.
std::vector<Ends> motions_of(const Polyhedron& body, double turn) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : body.vertices())
        box.extend(vertex);
    const Vector3d centre = box.center();
    const double length = box.sizes().maxCoeff();
    Draw draw(57);
    const auto pose = [&](const Vector3d& place, const Quaterniond& orientation) {
        return Pose(Vector3d(centre + place - orientation * centre), orientation);
    };
    std::vector<Ends> motions;
    while (motions.size() < motions_of_case) {
        const Quaterniond orientation = draw.turn(0, std::numbers::pi);
        const Vector3d from = draw.between(0.9, 1.5) * length * draw.direction();
        const Vector3d to = draw.between(0.2, 1.2) * length * draw.direction();
        const Ends ends{
            pose(from, orientation),
            pose(from + 0.5 * (to - from), Quaterniond(Eigen::AngleAxisd(turn, draw.direction())) * orientation),
            centre};
        if (answer(body, ends, Kind::screw).verdict != Verdict::contact_at_start)
            motions.push_back(ends);
    }
    return motions;
}

double median(std::vector<double> numbers) {
    if (numbers.empty())
        return 0;
    std::ranges::nth_element(numbers, numbers.begin() + std::ptrdiff_t(numbers.size() / 2));
    return numbers[numbers.size() / 2];
}

/// The least microseconds of several calls in turn, of each kind.
std::array<double, kinds.size()> times_of(const Polyhedron& body, const Ends& ends) {
    std::array<double, kinds.size()> least;
    least.fill(1e9);
    for (int call = 0; call < calls; ++call)
        for (const Kind kind : kinds) {
            const auto start = std::chrono::steady_clock::now();
            const FirstContact found = answer(body, ends, kind);
            const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - start;
            if (found.verdict == Verdict::unknown)
                std::abort();
            double& time = least[std::size_t(kind)];
            time = std::min(time, taken.count());
        }
    return least;
}

void print_case(const NamedBody& body, double turn) {
    struct Times {
        std::vector<double> screw, velocity, twist;
    };
    std::array<Times, 2> of_verdict; // clear, contact
    for (const Ends& ends : motions_of(body.body, turn)) {
        const bool touches = answer(body.body, ends, Kind::velocity).verdict != Verdict::clear;
        if (touches != (answer(body.body, ends, Kind::screw).verdict != Verdict::clear))
            continue;
        const auto [screw, velocity, twist] = times_of(body.body, ends);
        Times& times = of_verdict[touches ? 1 : 0];
        times.screw.push_back(screw);
        times.velocity.push_back(velocity / screw);
        times.twist.push_back(twist / screw);
    }
    for (const bool touches : {false, true}) {
        const Times& times = of_verdict[touches ? 1 : 0];
        std::printf("%-16s %3.0f degrees  %-8s %4zu motions  screw %8.2f us  velocity %5.2f  twist %5.2f times\n",
                    body.name.c_str(), turn / degree, touches ? "contact" : "clear", times.screw.size(),
                    median(times.screw), median(times.velocity), median(times.twist));
    }
}

int run() {
    std::vector<NamedBody> bodies;
    bodies.push_back({"ellipsoid 0.3k", ellipsoid({0.5, 0.8, 0.6}, 2)});
    bodies.push_back({"torus 3.7k", bumpy_torus(43, 43)});
    if (const auto file = data_file("meshes/spot.obj"))
        bodies.push_back({"spot 5.9k", Polyhedron::load(*file, {.triangulate = true})});
    bodies.push_back(large_body());
    for (const NamedBody& body : bodies)
        for (const double turn : {10 * degree, 90 * degree})
            print_case(body, turn);
    return 0;
}

} // namespace
} // namespace chasles::bench

int main() {
    return chasles::bench::run();
}
