// Constant velocity beside FCL's sampled continuousCollide on the same motions (InterpMotion: slerp and a straight line
// of the body's origin; solver CCDC_NAIVE with 10 and 100 samples). FCL's conservative advancement takes some thousand
// times longer on these meshes and finds next to no contact, so it is left out. Prints for each case the median times,
// and how many contacts FCL misses: those of ours at which FCL's own discrete test finds an overlap within the next
// thousandth of the motion. A contact that FCL finds and we deny, or find later, is wrong.
#include "bench/bodies.h"
#include "bench/draw.h"
#include "bench/generated_bodies.h"
#include "chasles/chasles.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/math/motion/translation_motion.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <memory>
#include <numbers>

namespace chasles::bench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Model = fcl::BVHModel<fcl::OBBRSSd>;

constexpr std::size_t motions_of_case = 300;

struct Solver {
    const char* name;
    fcl::CCDSolverType type;
    std::size_t samples;
};
constexpr std::array solvers{Solver{"10 samples", fcl::CCDC_NAIVE, 10}, Solver{"100 samples", fcl::CCDC_NAIVE, 100}};

std::shared_ptr<Model> model_of(const Polyhedron& body) {
    auto model = std::make_shared<Model>();
    std::vector<fcl::Triangle> triangles;
    for (const auto& [a, b, c] : triangles_of(body))
        triangles.emplace_back(a, b, c);
    model->beginModel();
    model->addSubModel({body.vertices().begin(), body.vertices().end()}, triangles);
    model->endModel();
    return model;
}

struct Ends {
    Pose start;
    Pose goal;
};

/// Motions of a body past or towards its copy, which is at rest: from two lengths away to somewhere near the copy.
std::vector<Ends> motions_of(const Polyhedron& body, double turn) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : body.vertices())
        box.extend(vertex);
    const double length = box.sizes().maxCoeff();
    Draw draw(63);
    std::vector<Ends> motions;
    while (motions.size() < motions_of_case) {
        const Quaterniond start = draw.turn(0, std::numbers::pi);
        const Quaterniond goal = Quaterniond(Eigen::AngleAxisd(turn, draw.direction())) * start;
        const Vector3d from = 2 * length * draw.direction(), to = draw.between(-1, 1.5) * length * draw.direction();
        motions.push_back({Pose(box.center() + from - start * box.center(), start),
                           Pose(box.center() + to - goal * box.center(), goal)});
    }
    return motions;
}

bool overlaps_at(const std::shared_ptr<Model>& model, const Pose& pose) {
    fcl::CollisionResultd result;
    return fcl::collide<double>(model.get(), pose.isometry(), model.get(), fcl::Transform3d::Identity(),
                                fcl::CollisionRequestd(), result) > 0;
}

/// Whether FCL's discrete test sees the contact, too, soon after it.
bool is_confirmed(const std::shared_ptr<Model>& model, const Motion& motion, const FirstContact& found) {
    for (const double later : {1e-9, 1e-7, 1e-5, 1e-4, 3e-4, 1e-3})
        if (overlaps_at(model, motion.pose_at(std::min(1.0, found.time.upper + later))))
            return true;
    return false;
}

template <class Work>
double microseconds(const Work& work) {
    double least = 1e12;
    for (int call = 0; call < 3; ++call) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - start;
        least = std::min(least, taken.count());
    }
    return least;
}

double median(std::vector<double> numbers) {
    std::ranges::nth_element(numbers, numbers.begin() + std::ptrdiff_t(numbers.size() / 2));
    return numbers[numbers.size() / 2];
}

struct Tally {
    std::vector<double> ratios, times;
    std::size_t missed = 0;
    std::size_t wrong = 0;
};

void compare(const std::shared_ptr<Model>& model, const Ends& ends, const Solver& solver, const FirstContact& found,
             bool confirmed, double ours, Tally& tally) {
    fcl::ContinuousCollisionRequestd request;
    request.num_max_iterations = solver.samples;
    request.ccd_solver_type = solver.type;
    fcl::ContinuousCollisionResultd result;
    const double theirs = microseconds([&] {
        // Of FCL's constructors (0.7) the one from two poses leaves the reference uninitialised, and the one with a
        // reference computes no velocity.
        const Eigen::Isometry3d from = ends.start.isometry(), to = ends.goal.isometry();
        const fcl::InterpMotion<double> motion(from.linear(), from.translation(), to.linear(), to.translation(),
                                               Vector3d::Zero());
        const fcl::TranslationMotion<double> rest(fcl::Transform3d::Identity(), fcl::Transform3d::Identity());
        result = {};
        fcl::continuousCollide<double>(model.get(), &motion, model.get(), &rest, request, result);
    });
    tally.times.push_back(theirs);
    tally.ratios.push_back(theirs / ours);
    tally.missed += confirmed && !result.is_collide ? 1 : 0;
    const bool denied =
        result.is_collide && (found.verdict == Verdict::clear || result.time_of_contact < found.time.lower - 1e-9);
    tally.wrong += denied ? 1 : 0;
}

void print_case(const NamedBody& body, double turn) {
    constexpr double degree = std::numbers::pi / 180;
    const std::shared_ptr<Model> model = model_of(body.body);
    std::array<Tally, solvers.size()> tallies;
    std::vector<double> times;
    std::size_t contacts = 0;
    for (const Ends& ends : motions_of(body.body, turn * degree)) {
        const FirstContactQuery query{body.body, body.body, Motion::velocity(ends.start, ends.goal)};
        const FirstContact found = first_contact(query);
        if (found.verdict == Verdict::contact_at_start)
            continue;
        const bool confirmed = found.verdict == Verdict::contact && is_confirmed(model, query.motion, found);
        contacts += confirmed ? 1 : 0;
        const double ours = microseconds([&] {
            (void)first_contact({body.body, body.body, Motion::velocity(ends.start, ends.goal)}).verdict;
        });
        times.push_back(ours);
        for (std::size_t i = 0; i < solvers.size(); ++i)
            compare(model, ends, solvers[i], found, confirmed, ours, tallies[i]);
    }
    std::printf("%-15s %3.0f degrees: %zu motions, %zu contacts, ours %7.2f us", body.name.c_str(), turn, times.size(),
                contacts, median(times));
    for (std::size_t i = 0; i < solvers.size(); ++i)
        std::printf("; FCL %s %9.2f us (%.1f of ours), misses %zu, wrong %zu", solvers[i].name,
                    median(tallies[i].times), median(tallies[i].ratios), tallies[i].missed, tallies[i].wrong);
    std::printf("\n");
    std::fflush(stdout);
}

int run() {
    std::vector<NamedBody> bodies{{"torus 3.7k", bumpy_torus(43, 43)}};
    if (const auto file = data_file("meshes/spot.obj"))
        bodies.push_back({"spot 5.9k", Polyhedron::load(*file, {.triangulate = true})});
    for (const NamedBody& body : bodies)
        for (const double turn : {10.0, 90.0})
            print_case(body, turn);
    return 0;
}

} // namespace
} // namespace chasles::bench

int main() {
    return chasles::bench::run();
}
