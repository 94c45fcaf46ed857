// A body that is kept in touch with another one: it makes small steps, each asked with `hold`, and goes as far as the
// answer allows. Whatever it does, an independent distance has to stay above the hold.
#pragma once

#include "chasles/query/first_contact.h"
#include "tests/support/surface_distance.h"

#include <functional>
#include <gtest/gtest.h>

namespace chasles::test {

/// The distance of the surfaces with the moving body at a pose; 0 if they cross.
using DistanceAt = std::function<double(const Pose&)>;

/// By all pairs of triangles in extended precision; for small bodies. Polygons must be convex.
inline DistanceAt plain_distance(const Polyhedron& moving, const Polyhedron& fixed) {
    using Triangles = std::vector<Triangle3<long double>>;
    const auto triangles_of = [](const Polyhedron& body) {
        Triangles result;
        for (std::size_t f = 0; f < body.face_count(); ++f) {
            const auto face = body.face(f);
            const auto at = [&](std::size_t i) {
                return Point3<long double>(body.vertices()[face[i]].cast<long double>());
            };
            for (std::size_t i = 1; i + 1 < face.size(); ++i)
                result.push_back({at(0), at(i), at(i + 1)});
        }
        return result;
    };
    return [a = triangles_of(moving), b = triangles_of(fixed)](const Pose& pose) {
        const Eigen::Quaternion<long double> turn = Eigen::Quaterniond(pose.rotation).cast<long double>().normalized();
        const Point3<long double> shift = pose.translation.cast<long double>();
        long double least = std::numeric_limits<long double>::infinity();
        for (const auto& body : a) {
            Triangle3<long double> there;
            for (std::size_t i = 0; i < 3; ++i)
                there[i] = turn * body[i] + shift;
            for (const auto& other : b)
                least = std::min(least, squared_distance_of_triangles<long double>(there, other));
        }
        return static_cast<double>(std::sqrt(least));
    };
}

/// What happened to the steps.
struct SlideTally {
    int steps = 0;
    int clear = 0;
    int held = 0; ///< stopped where it would come nearer than the hold
    int new_contacts = 0;
    int stuck = 0;                                           ///< of these, stopped where they stood
    int touching = 0;                                        ///< contact_at_start
    double lowest = std::numeric_limits<double>::infinity(); ///< distance over hold, the least
    double seconds = 0;

    SlideTally& operator+=(const SlideTally& other) {
        steps += other.steps;
        clear += other.clear;
        held += other.held;
        new_contacts += other.new_contacts;
        stuck += other.stuck;
        touching += other.touching;
        lowest = std::min(lowest, other.lowest);
        seconds += other.seconds;
        return *this;
    }
};

/// Two bodies, what they keep, and where the moving one is.
struct SlidingBody {
    const Polyhedron& moving;
    const Polyhedron& fixed;
    double margin;
    double hold;
    double slack;        ///< of distances: of their computation, and 1e-12 of the scene
    DistanceAt distance; ///< the independent one
    Pose at;
    int samples = 4; ///< of each step, at which the distance is looked at
    SlideTally tally;

    /// Goes to where the bodies come within the margin; false if they do not.
    bool approach(const Pose& from, const Pose& to) {
        const ScrewMotion motion = ScrewMotion::between(from, to);
        const FirstContact found =
            first_contact({.moving = moving, .fixed = fixed, .motion = motion, .margin = margin});
        if (found.verdict != Verdict::contact)
            return false;
        at = motion.pose_at(found.time.upper);
        return true;
    }

    /// One step towards a pose; returns the answer.
    FirstContact step(const Pose& to) {
        const ScrewMotion motion = ScrewMotion::between(at, to);
        const double before = distance(at);
        const FirstContact found = first_contact({.moving = moving,
                                                  .fixed = fixed,
                                                  .motion = motion,
                                                  .margin = margin,
                                                  .hold = hold,
                                                  .find = Find::first_with_all_contacts});
        count(found);
        const double end = found.clear_until;
        const double kept = std::min(hold, before);
        for (int i = 1; i <= samples; ++i) {
            const double time = end * i / samples;
            const double there = distance(motion.pose_at(time));
            tally.lowest = std::min(tally.lowest, there / hold);
            EXPECT_GE(there, kept - slack) << "at time " << time << " of " << end << ", from " << before;
        }
        expect_reason(found, motion);
        at = found.verdict == Verdict::clear ? to : motion.pose_at(end);
        return found;
    }

private:
    void count(const FirstContact& found) {
        ++tally.steps;
        tally.clear += found.verdict == Verdict::clear ? 1 : 0;
        tally.touching += found.verdict == Verdict::contact_at_start ? 1 : 0;
        tally.stuck += found.verdict != Verdict::clear && found.clear_until == 0 ? 1 : 0;
        if (found.verdict == Verdict::clear) {
            EXPECT_EQ(found.clear_until, 1);
        }
    }

    /// A step that does not reach its goal would come nearer than the hold, or meets something new at the margin.
    void expect_reason(const FirstContact& found, const ScrewMotion& motion) {
        if (found.verdict != Verdict::contact)
            return;
        ASSERT_FALSE(found.contacts.empty());
        const double gap = found.contacts[0].gap;
        const bool is_new = gap > 0.5 * (margin + hold);
        ++(is_new ? tally.new_contacts : tally.held);
        if (is_new) {
            EXPECT_NEAR(gap, margin, slack + 1e-9 * margin) << "a new contact is at the margin";
            EXPECT_GT(found.contacts[0].approach_speed, -slack) << "and closing";
        } else {
            EXPECT_NEAR(distance(motion.pose_at(found.time.lower)), gap, slack + 1e-9 * margin)
                << "what was held comes to the hold";
        }
    }
};

} // namespace chasles::test
