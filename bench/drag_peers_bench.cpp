// A body in a hand by Chasles and by Bullet: the same scenes and the same hands. How deep do the bodies get into each
// other, do they go through each other, and how long does a step take?
//
// The hand gives 60 goals a second. Chasles makes one update of each; Bullet steps at 60, 240 and 1,000 Hz, with the
// hand interpolated, tied by springs or rigidly. Judges share no code with either: FCL for overlaps, and
// bench/penetration.h for depths (of closed bodies; vertices in the other body only, so a lower bound) and for points
// of the body that end up on the other side of a surface. Depths are shares of the body's diagonal.
//
//     drag_peers_bench [--seconds=5] [--only=SCENE]
#include "bench/bullet_hand.h"
#include "bench/drag_cases.h"
#include "bench/penetration.h"
#include "bench/timings.h"
#include "chasles/chasles.h"
#include "tests/data/fcl_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fcl/narrowphase/collision.h>
#include <numbers>
#include <span>
#include <string_view>

namespace chasles::bench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int goals_a_second = 60;
constexpr int samples_of_piece = 4;

/// How a scene is put to Bullet and to the judges.
struct PeerScene {
    std::string_view name;
    bool is_convex = false; ///< the dragged body
    bool has_core = false;  ///< the middle of its box is inside of it
    double pitch = 0;       ///< of a thread about z; 0: none
    double play = 0;        ///< along the thread
};

constexpr PeerScene scenes_of_peers[] = {{"box on a plate", true, true},
                                         {"box at a thin plate", true, true},
                                         {"peg of 64 sides in its hole", true, true},
                                         {"key in a maze", false, true},
                                         {"piano in a house"},
                                         {"nut on its bolt", false, false, 2, 0.06},
                                         {"M16 nut, loose", false, false, 0.002, 1.8e-4},
                                         {"bunny on bunny", false, true}};

/// What came of a hand.
struct Outcome {
    std::vector<double> times; ///< of steps, ms
    double deepest = 0;
    int overlaps = 0;
    int frames = 0;
    double through_at = -1; ///< seconds; negative: never
};

class Judge {
public:
    Judge(const DragCase& hand, const PeerScene& scene)
        : hand_(hand), scene_(scene), moving_model_(test::fcl_model_of(hand.moving)),
          fixed_model_(test::fcl_model_of(hand.fixed)), moving_(hand.moving), fixed_(hand.fixed), last_(hand.start) {
        const MeshReport box = hand.moving.report();
        const auto add = [&](const Vector3d& point) { markers_.push_back({point, 0, hand.start.isometry() * point}); };
        if (scene.has_core)
            add((box.lower + box.upper) / 2);
        const std::size_t step = std::max<std::size_t>(1, hand.moving.vertex_count() / 6);
        for (std::size_t i = 0; i < hand.moving.vertex_count() && !scene.has_core; i += step)
            add(hand.moving.vertices()[i]);
    }

    /// A pose between two goals, or at one.
    void reached(const Pose& pose) {
        turns_ += turns_between(last_, pose);
        for (Marker& marker : markers_)
            marker.crossings += fixed_.crossings(last_.isometry() * marker.point, pose.isometry() * marker.point);
        last_ = pose;
    }
    /// The last pose is at a goal.
    void judge(double time, Outcome& outcome) {
        ++outcome.frames;
        fcl::CollisionRequestd request;
        fcl::CollisionResultd result;
        fcl::collide(moving_model_.get(), last_.isometry(), fixed_model_.get(), fcl::Transform3d::Identity(), request,
                     result);
        outcome.overlaps += result.isCollision() ? 1 : 0;
        if (outcome.through_at < 0 && is_through(result.isCollision()))
            outcome.through_at = time;
        if (moving_.is_closed() && fixed_.is_closed())
            outcome.deepest = std::max(outcome.deepest, penetration(hand_.moving, moving_, hand_.fixed, fixed_, last_));
    }

private:
    static double turns_between(const Pose& from, const Pose& to) {
        const Quaterniond turn = Quaterniond(to.rotation) * Quaterniond(from.rotation).conjugate();
        return std::remainder(2 * std::atan2(turn.z(), turn.w()), 2 * std::numbers::pi) / (2 * std::numbers::pi);
    }

    struct Marker {
        Vector3d point; ///< of the body
        std::size_t crossings = 0;
        Vector3d last_free; ///< its place when the bodies last did not overlap
    };

    bool is_through(bool is_overlapping) {
        if (scene_.pitch > 0) {
            const double rise = last_.translation.z() - hand_.start.translation.z();
            return std::abs(rise - scene_.pitch * turns_) > scene_.play + 0.5 * scene_.pitch;
        }
        if (scene_.has_core)
            return markers_.front().crossings > 0;
        return !is_overlapping && has_changed_sides();
    }

    /// Whether a vertex has crossed the surface since the bodies last did not overlap, and not back the same way.
    bool has_changed_sides() {
        bool has_changed = false;
        for (Marker& marker : markers_) {
            const Vector3d here = last_.isometry() * marker.point;
            has_changed = has_changed || (marker.crossings > 0 && fixed_.crossings(marker.last_free, here) > 0);
            marker.crossings = 0;
            marker.last_free = here;
        }
        return has_changed;
    }

    const DragCase& hand_;
    const PeerScene& scene_;
    std::shared_ptr<const test::FclModel> moving_model_, fixed_model_;
    Surface moving_, fixed_;
    std::vector<Marker> markers_;
    Pose last_;
    double turns_ = 0;
};

/// The time of the processor, not of the clock: the machine has other work.
template <class Work>
double processor_milliseconds(const Work& work) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
    };
    const double start = now();
    work();
    return now() - start;
}

/// From where the body starts to where the hand goes, in the first half second.
Pose hand_at(const DragCase& hand, double time) {
    const Pose goal = goal_at(hand, time);
    const double share = std::min(1.0, 2 * time);
    return {hand.start.translation + share * (goal.translation - hand.start.translation),
            Quaterniond(hand.start.rotation).slerp(share, Quaterniond(goal.rotation))};
}

Outcome drag_by_chasles(const DragCase& hand, const PeerScene& scene_of, double seconds) {
    Scene scene;
    scene.add({"fixed", hand.fixed});
    scene.add({"moving", hand.moving, Motion::at_rest(hand.start)});
    DraggedBody body(scene, "moving");
    Judge judge(hand, scene_of);
    Outcome outcome;
    for (int i = 1; i <= int(seconds * goals_a_second); ++i) {
        DragStep step;
        const double time = double(i) / goals_a_second;
        const Pose goal = hand_at(hand, time);
        outcome.times.push_back(processor_milliseconds([&] { step = body.update(goal); }));
        for (const DragPiece& piece : step.pieces)
            for (int k = 1; k <= samples_of_piece; ++k)
                judge.reached(piece.motion.pose_at(piece.until * k / samples_of_piece));
        judge.judge(time, outcome);
    }
    return outcome;
}

Outcome drag_by_bullet(const DragCase& hand, const PeerScene& scene_of, double seconds, double rate, BulletTie tie) {
    BulletHand body(hand.moving, hand.fixed, hand.start, {rate, tie, scene_of.is_convex});
    Judge judge(hand, scene_of);
    Outcome outcome;
    int frames = 0;
    for (int i = 1; i <= int(seconds * rate); ++i) {
        const double time = i / rate;
        const Pose goal = hand_at(hand, time);
        outcome.times.push_back(processor_milliseconds([&] { body.step(goal); }));
        judge.reached(body.pose());
        if (int(time * goals_a_second + 1e-9) == frames)
            continue;
        ++frames;
        judge.judge(time, outcome);
    }
    return outcome;
}

void print(const char* who, double rate, const DragCase& hand, const Outcome& outcome) {
    const double size = (hand.moving.report().upper - hand.moving.report().lower).norm();
    char through[32] = "no";
    if (outcome.through_at >= 0)
        std::snprintf(through, sizeof through, "at %.2f s", outcome.through_at);
    char depth[32] = "not closed";
    if (hand.moving.report().closed && hand.fixed.report().closed)
        std::snprintf(depth, sizeof depth, "%.3f %%", 100 * outcome.deepest / size);
    std::printf("  %-18s %6.0f %12s %9.1f %% %12s %10.3f %10.3f\n", who, rate, depth,
                100.0 * outcome.overlaps / std::max(1, outcome.frames), through, median(outcome.times),
                quantile(outcome.times, 0.99));
    std::fflush(stdout);
}

void run(const PeerScene& scene, double seconds) {
    const auto hand = drag_case(scene.name);
    if (!hand)
        return void(std::printf("%s: skipped, the data is missing\n", std::string(scene.name).c_str()));
    std::printf("%s (Bullet: %s)\n", hand->name.c_str(), scene.is_convex ? "hull" : "GImpact");
    print("Chasles", goals_a_second, *hand, drag_by_chasles(*hand, scene, seconds));
    for (const BulletTie tie : {BulletTie::spring, BulletTie::fixed})
        for (const double rate : {60.0, 240.0, 1000.0})
            print(tie == BulletTie::spring ? "Bullet, springs" : "Bullet, rigid", rate, *hand,
                  drag_by_bullet(*hand, scene, seconds, rate, tie));
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    double seconds = 5;
    std::string_view only;
    for (const std::string_view argument : std::span(argv, std::size_t(argc)).subspan(1)) {
        if (argument.starts_with("--seconds="))
            seconds = std::max(0.1, std::atof(argument.substr(10).data()));
        if (argument.starts_with("--only="))
            only = argument.substr(7);
    }
    std::printf("%-27s %12s %11s %12s %10s %10s\n", "  who                    Hz", "deepest", "overlaps", "through",
                "median ms", "99 % ms");
    for (const auto& scene : chasles::bench::scenes_of_peers)
        if (only.empty() || scene.name == only)
            chasles::bench::run(scene, seconds);
    return 0;
}
