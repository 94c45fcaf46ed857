// Constant velocity beside FCL's sampled continuousCollide on the same motions (InterpMotion: slerp and a straight line
// of the body's origin; solver CCDC_NAIVE with 10 and 100 samples). Each answer of ours is first put to FCL's discrete
// test at a thousand times before the contact, or of the whole motion if it is clear; an overlap there refutes us.
// Prints for each case the median times, and how many contacts FCL misses: those of ours at which FCL's discrete test
// finds an overlap within the next thousandth of the motion. A contact that FCL finds and we deny, or find later, is
// wrong. With `--advancement`, FCL's conservative advancement is asked too, in a few motions of each case.
#include "bench/bodies.h"
#include "bench/draw.h"
#include "bench/fcl_model.h"
#include "bench/generated_bodies.h"
#include "bench/timings.h"
#include "chasles/chasles.h"

#include <algorithm>
#include <cstdio>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/math/motion/translation_motion.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>
#include <fcl/narrowphase/distance.h>
#include <memory>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

namespace chasles::bench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Model = fcl::BVHModel<fcl::OBBRSSd>;

constexpr std::size_t motions_of_case = 300;
constexpr std::size_t motions_of_large_body = 60;
constexpr std::size_t motions_of_advancement = 6;
constexpr int samples_of_check = 1000;

struct Solver {
    const char* name;
    fcl::CCDSolverType type;
    std::size_t samples;
};
const std::vector<Solver> sampling{{"10 samples", fcl::CCDC_NAIVE, 10}, {"100 samples", fcl::CCDC_NAIVE, 100}};
const std::vector<Solver> advancement{{"advancement", fcl::CCDC_CONSERVATIVE_ADVANCEMENT, 10}};

enum class Approach : std::uint8_t {
    into, ///< to somewhere near the copy
    past  ///< straight past the copy at a distance of 0.5 to 1 length
};
struct Case {
    Approach approach;
    double degrees;
    std::size_t motions;
};

struct Ends {
    Pose start;
    Pose goal;
};

/// The place of the body's middle at the start and at the goal, seen from its copy at rest, in lengths of the body.
std::pair<Vector3d, Vector3d> way_of(Draw& draw, Approach approach) {
    const Vector3d from = 2 * draw.direction();
    if (approach == Approach::into)
        return {from, draw.between(-1, 1.5) * draw.direction()};
    const Vector3d aside = draw.between(0.5, 1) * from.cross(draw.direction()).normalized();
    return {from + aside, aside - from};
}

/// Motions of a body towards its copy, which is at rest, from two lengths away.
std::vector<Ends> motions_of(const Polyhedron& body, const Case& asked) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : body.vertices())
        box.extend(vertex);
    const Vector3d centre = box.center();
    const double length = box.sizes().maxCoeff(), turn = asked.degrees * std::numbers::pi / 180;
    const auto pose = [&](const Vector3d& place, const Quaterniond& orientation) {
        return Pose(centre + length * place - orientation * centre, orientation);
    };
    Draw draw(63);
    std::vector<Ends> motions;
    while (motions.size() < asked.motions) {
        const Quaterniond start = draw.turn(0, std::numbers::pi);
        const Quaterniond goal = Quaterniond(Eigen::AngleAxisd(turn, draw.direction())) * start;
        const auto [from, to] = way_of(draw, asked.approach);
        motions.push_back({pose(from, start), pose(to, goal)});
    }
    return motions;
}

/// Of FCL's constructors (0.7) the one from two poses leaves the reference uninitialised, and the one from two poses
/// and a reference computes no velocity.
fcl::InterpMotion<double> interpolation(const Ends& ends) {
    const Eigen::Isometry3d from = ends.start.isometry(), to = ends.goal.isometry();
    return {from.linear(), from.translation(), to.linear(), to.translation(), Vector3d::Zero()};
}

/// How far FCL's motion is from ours at most, for a point of the body.
double difference(const Polyhedron& body, const Ends& ends, const Motion& motion) {
    const fcl::InterpMotion<double> theirs = interpolation(ends);
    double size = 0, most = 0;
    for (const Vector3d& vertex : body.vertices())
        size = std::max(size, vertex.norm());
    for (int i = 0; i <= 10; ++i) {
        theirs.integrate(0.1 * i);
        fcl::Transform3d pose;
        theirs.getCurrentTransform(pose);
        const Eigen::Matrix4d apart = pose.matrix() - motion.pose_at(0.1 * i).isometry().matrix();
        most = std::max(most, apart.topRightCorner<3, 1>().norm() + size * apart.topLeftCorner<3, 3>().norm());
    }
    return most;
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

/// Whether FCL's discrete test sees an overlap that our answer denies: at even times, and ever closer to the contact.
bool is_refuted(const std::shared_ptr<Model>& model, const Motion& motion, const FirstContact& found) {
    const double end = found.verdict == Verdict::clear ? 1 : found.time.lower;
    for (int i = 0; i < samples_of_check; ++i)
        if (overlaps_at(model, motion.pose_at(end * i / samples_of_check)))
            return true;
    for (const double sooner : {1e-12, 1e-10, 1e-8, 1e-6, 1e-5})
        if (sooner <= end && overlaps_at(model, motion.pose_at(end - sooner)))
            return true;
    return false;
}

struct Tally {
    std::vector<double> ratios, times;
    std::size_t missed = 0;
    std::size_t wrong = 0;
    std::size_t revoked = 0; ///< wrong ones at whose time FCL's own distance is not zero
    double latest = 0;       ///< the latest contact, in parts of the motion
};

bool is_apart_at(const std::shared_ptr<Model>& model, const Pose& pose) {
    fcl::DistanceResultd result;
    return fcl::distance<double>(model.get(), pose.isometry(), model.get(), fcl::Transform3d::Identity(),
                                 fcl::DistanceRequestd(), result) > 1e-9;
}

void compare(const std::shared_ptr<Model>& model, const Ends& ends, const Solver& solver, const FirstContact& found,
             bool confirmed, double ours, Tally& tally) {
    fcl::ContinuousCollisionRequestd request;
    request.num_max_iterations = solver.samples;
    request.ccd_solver_type = solver.type;
    fcl::ContinuousCollisionResultd result;
    const double theirs = least_microseconds(3, [&] {
        const fcl::InterpMotion<double> motion = interpolation(ends);
        const fcl::TranslationMotion<double> rest(fcl::Transform3d::Identity(), fcl::Transform3d::Identity());
        result = {};
        fcl::continuousCollide<double>(model.get(), &motion, model.get(), &rest, request, result);
    });
    tally.times.push_back(theirs);
    tally.ratios.push_back(theirs / ours);
    tally.missed += confirmed && !result.is_collide ? 1 : 0;
    if (!result.is_collide)
        return;
    const double time = result.time_of_contact;
    if (found.verdict == Verdict::contact)
        tally.latest = std::max(tally.latest, time - found.time.upper);
    if (found.verdict == Verdict::clear || time < found.time.lower - 1e-9) {
        ++tally.wrong;
        tally.revoked += is_apart_at(model, Motion::velocity(ends.start, ends.goal).pose_at(time)) ? 1 : 0;
    }
}

/// What one case comes to.
struct Totals {
    std::vector<double> times; ///< ours
    std::size_t contacts = 0, unconfirmed = 0, refuted = 0;
    double difference = 0;
};

void print_totals(const NamedBody& body, const Case& asked, const std::vector<Solver>& solvers, const Totals& totals,
                  const std::vector<Tally>& tallies) {
    std::printf("%-11s %s %2.0f degrees: %zu motions, %zu contacts (%zu more unconfirmed), refuted %zu, motions differ "
                "by %.0e, ours %.2f us",
                body.name.c_str(), asked.approach == Approach::into ? "into" : "past", asked.degrees,
                totals.times.size(), totals.contacts, totals.unconfirmed, totals.refuted, totals.difference,
                median(totals.times));
    for (std::size_t i = 0; i < solvers.size(); ++i)
        std::printf("; FCL %s %.2f us (%.1f of ours), misses %zu, late by up to %.3f, wrong %zu (%zu revoked by FCL's "
                    "distance)",
                    solvers[i].name, median(tallies[i].times), median(tallies[i].ratios), tallies[i].missed,
                    tallies[i].latest, tallies[i].wrong, tallies[i].revoked);
    std::printf("\n");
    std::fflush(stdout);
}

void print_case(const NamedBody& body, const Case& asked, const std::vector<Solver>& solvers) {
    const std::shared_ptr<Model> model = fcl_model_of(body.body);
    std::vector<Tally> tallies(solvers.size());
    Totals totals;
    for (const Ends& ends : motions_of(body.body, asked)) {
        const FirstContactQuery query{body.body, body.body, Motion::velocity(ends.start, ends.goal)};
        const FirstContact found = first_contact(query);
        if (found.verdict == Verdict::contact_at_start)
            continue;
        const bool touches = found.verdict == Verdict::contact;
        const bool confirmed = touches && is_confirmed(model, query.motion, found);
        totals.contacts += confirmed ? 1 : 0;
        totals.unconfirmed += touches && !confirmed ? 1 : 0;
        totals.refuted += is_refuted(model, query.motion, found) ? 1 : 0;
        totals.difference = std::max(totals.difference, difference(body.body, ends, query.motion));
        const double ours = least_microseconds(3, [&] {
            (void)first_contact({body.body, body.body, Motion::velocity(ends.start, ends.goal)}).verdict;
        });
        totals.times.push_back(ours);
        for (std::size_t i = 0; i < solvers.size(); ++i)
            compare(model, ends, solvers[i], found, confirmed, ours, tallies[i]);
    }
    print_totals(body, asked, solvers, totals, tallies);
}

int run(bool with_advancement) {
    std::vector<NamedBody> bodies{{"torus 3.7k", bumpy_torus(43, 43)}};
    if (const auto file = data_file("meshes/spot.obj"))
        bodies.push_back({"spot 5.9k", Polyhedron::load(*file, {.triangulate = true})});
    bodies.push_back(large_body());
    for (const NamedBody& body : bodies)
        for (const Approach approach : {Approach::into, Approach::past})
            for (const double degrees : {10.0, 90.0}) {
                const bool is_large = body.body.face_count() > 10'000;
                print_case(body, {approach, degrees, is_large ? motions_of_large_body : motions_of_case}, sampling);
                if (with_advancement && !is_large)
                    print_case(body, {approach, degrees, motions_of_advancement}, advancement);
            }
    return 0;
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    return chasles::bench::run(argc > 1 && std::string_view(argv[1]) == "--advancement");
}
