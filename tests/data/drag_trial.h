// Hands that jump, spin, press and wander, and FCL's opinion of every pose reached and of all ways between.
#pragma once

#include "bench/drag_cases.h"
#include "chasles/manipulation/dragged_body.h"
#include "tests/data/fcl_distance.h"
#include "tests/support/random_poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chasles::test {

/// What the updates of one case came to.
struct TrialTally {
    int updates = 0;
    int in_contact = 0;
    int sliding = 0; ///< in contact before and after, and has moved
    int reached = 0;
    int resting = 0;
    int far = 0;   ///< goals that are several sizes of the body away
    int spins = 0; ///< updates whose goal is turned by more than a quarter
    long pieces = 0;
    long samples = 0;     ///< of FCL
    double nearest = 1e9; ///< FCL's distance at a sample, in clearances that the library claims
    double slowest = 0;   ///< update, seconds
    double updating = 0;  ///< likewise in all
};

/// The body times a power of two, which changes no digit.
inline Polyhedron scaled(const Polyhedron& body, double power) {
    std::vector<Eigen::Vector3d> vertices(body.vertices().begin(), body.vertices().end());
    for (Eigen::Vector3d& vertex : vertices)
        vertex *= power;
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t f = 0; f < body.face_count(); ++f)
        faces.emplace_back(body.face(f).begin(), body.face(f).end());
    return Polyhedron::from_polygons(vertices, faces, {.triangulate = true});
}

/// FCL 0.7 finds the distance 0 between triangles of 1e-4 that are 5e-6 apart, and the right one if all lengths are 64
/// times as long. So it judges bodies of a size between 16 and 64.
class ScaledFclDistance {
public:
    ScaledFclDistance(const Polyhedron& moving, const Polyhedron& fixed, double radius)
        : power_(std::ldexp(16, -std::ilogb(radius))), distance_(scaled(moving, power_), scaled(fixed, power_)) {}

    [[nodiscard]] double operator()(const Pose& at) const {
        return distance_(Pose(power_ * at.translation, Eigen::Quaterniond(at.rotation))) / power_;
    }

private:
    double power_;
    FclDistance distance_;
};

/// FCL's distances along the pieces of an update.
class WayJudge {
public:
    WayJudge(const Polyhedron& moving, const Polyhedron& fixed)
        : distance_(moving, fixed, (moving.report().upper - moving.report().lower).norm() / 2) {
        const MeshReport box = moving.report();
        centre_ = (box.lower + box.upper) / 2;
        radius_ = (box.upper - box.lower).norm() / 2;
        slack_ = 1e-11 * (radius_ + centre_.norm() + fixed.report().lower.norm() + fixed.report().upper.norm());
    }

    /// The pieces lead from one pose to the other one, without a gap. At each sample the distance is at least the
    /// clearance. Where the bodies are far apart the next sample is as far as they can come without a contact; at least
    /// `samples` are taken of a piece that is near a contact all the way.
    void check(const Pose& before, const DragStep& step, int samples, TrialTally& tally) {
        Pose pose = before;
        for (const DragPiece& piece : step.pieces) {
            expect_equal(piece.motion.pose_at(0), pose);
            check(piece, samples, tally);
            pose = piece.motion.pose_at(piece.until);
        }
        expect_equal(step.pose, pose);
        tally.pieces += long(step.pieces.size());
        ++tally.samples;
        EXPECT_GT(distance_(step.pose), 0);
    }

private:
    void expect_equal(const Pose& a, const Pose& b) const {
        const double shift = (a.isometry() * centre_ - b.isometry() * centre_).norm();
        EXPECT_LE(shift + radius_ * (a.isometry().linear() - b.isometry().linear()).norm(), slack_);
    }

    void check(const DragPiece& piece, int samples, TrialTally& tally) {
        ASSERT_GT(piece.clearance, 0);
        const double speed = greatest_speed(piece.motion);
        const double least = piece.until / samples;
        for (double time = 0; time <= piece.until;) {
            const double found = distance_(piece.motion.pose_at(time));
            EXPECT_GE(found, piece.clearance - slack_) << "at " << time << " of " << piece.until;
            tally.nearest = std::min(tally.nearest, found / piece.clearance);
            ++tally.samples;
            const double free = speed > 0 ? (found - piece.clearance) / speed : 1;
            // the end is a sample
            const double next = time + std::max(least, free);
            time = time < piece.until ? std::min(next, piece.until) : 2;
        }
    }

    /// A bound of the speed of the body's points. The arc of a point is at most half pi times its chord.
    [[nodiscard]] double greatest_speed(const Motion& motion) const {
        const Eigen::Isometry3d from = motion.pose_at(0).isometry(), to = motion.pose_at(1).isometry();
        const double angle = Eigen::AngleAxisd(from.linear().transpose() * to.linear()).angle();
        return 0.5 * std::numbers::pi * (to * centre_ - from * centre_).norm() + angle * radius_;
    }

    ScaledFclDistance distance_;
    Eigen::Vector3d centre_;
    double radius_ = 0;
    double slack_ = 0;
};

/// A hand without patience.
class ViolentHand {
public:
    ViolentHand(const bench::DragCase& hand, Random& random) : hand_(hand), random_(random) {
        const MeshReport box = hand.moving.report();
        size_ = (box.upper - box.lower).norm();
    }

    /// The goal of the next update. A goal is kept for some updates.
    Pose goal(int update, const Pose& pose, TrialTally& tally) {
        if (update % 3 == 0)
            goal_ = next_goal(update, pose);
        const double angle = Eigen::Quaterniond(goal_.rotation)
                                 .normalized()
                                 .angularDistance(Eigen::Quaterniond(pose.rotation).normalized());
        tally.far += (goal_.translation - pose.translation).norm() > 3 * size_;
        tally.spins += angle > std::numbers::pi / 2;
        return goal_;
    }

private:
    /// Near home along a smooth way, around home, or anywhere.
    Pose next_goal(int update, const Pose& pose) {
        const double kind = random_.uniform(0, 1);
        if (kind < 0.4)
            return bench::goal_at(hand_, update / 60.0);
        if (kind < 0.7)
            return random_goal(random_, hand_.home, random_.uniform(-1, 1), 0.3 * size_);
        const double reach = random_.chance(0.2) ? 10 * size_ : random_.chance(0.5) ? size_ : 0.1 * size_;
        // the shortest way of several turns is at most half a turn
        const double turn = random_.chance(0.3) ? 6 * std::numbers::pi : random_.chance(0.5) ? 0.3 : 0;
        return random_goal(random_, pose, random_.uniform(-turn, turn), reach);
    }

    const bench::DragCase& hand_;
    Random& random_;
    double size_ = 0;
    Pose goal_;
};

} // namespace chasles::test
