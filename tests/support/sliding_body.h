// A body that stays in contact with another body. It makes small steps with `hold` and moves as far as each answer
// allows. An independent distance must stay above the hold distance, and every stop must have a cause.
#pragma once

#include "chasles/query/first_contact.h"
#include "tests/support/triangle_tree.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace chasles::test {

/// The outcomes of the steps.
struct SlideTally {
    int steps = 0;
    int clear = 0;
    int held = 0;                                            ///< stopped at the hold distance
    int in_doubt = 0;                                        ///< uncertain contacts
    int stuck = 0;                                           ///< stopped at the start
    int touching = 0;                                        ///< contact_at_start
    double lowest = std::numeric_limits<double>::infinity(); ///< least ratio of distance to hold
    double peer_error = 0;                                   ///< greatest error of the other distance
    std::vector<double> seconds = {};                        ///< of each query
    std::vector<double> seconds_with_memory = {};            ///< of each query with a memory of both bodies

    SlideTally& operator+=(const SlideTally& other) {
        steps += other.steps;
        clear += other.clear;
        held += other.held;
        in_doubt += other.in_doubt;
        stuck += other.stuck;
        touching += other.touching;
        lowest = std::min(lowest, other.lowest);
        peer_error = std::max(peer_error, other.peer_error);
        seconds.insert(seconds.end(), other.seconds.begin(), other.seconds.end());
        seconds_with_memory.insert(seconds_with_memory.end(), other.seconds_with_memory.begin(),
                                   other.seconds_with_memory.end());
        return *this;
    }

    /// The time that this part of the queries does not exceed, in milliseconds. There must be a query.
    [[nodiscard]] static double milliseconds(std::vector<double> sorted, double part) {
        std::ranges::sort(sorted);
        return 1e3 * sorted[static_cast<std::size_t>(part * double(sorted.size() - 1))];
    }
};

/// The distance of the surfaces with the moving body at a pose; 0 or less if they cross.
using DistanceAt = std::function<double(const Pose&)>;

/// Two bodies, their margin and hold distance, and the pose of the moving body.
struct SlidingBody {
    const Polyhedron& moving;
    const Polyhedron& fixed;
    double margin;
    double hold;
    double slack;          ///< error bound of distances: of their computation, plus 1e-12 of the scene
    int samples = 4;       ///< samples of the distance per step
    DistanceAt peer = {};  ///< another distance (optional)
    double peer_slack = 0; ///< error bound of the other distance
    Pose at = {};
    SlideTally tally = {};
    TreePair surfaces = {moving, fixed};
    PairMemory memory = {moving, fixed};

    /// The distance over all pairs of triangles. The other distance limits the search.
    [[nodiscard]] double distance(const Pose& there) {
        return surfaces.distance(there, peer ? peer(there) + 1e-6 * margin : std::numeric_limits<double>::infinity());
    }

    /// Moves the body until the bodies are within the margin. Returns false if they stay farther apart.
    bool approach(const Pose& from, const Pose& to) {
        const ScrewMotion motion = ScrewMotion::between(from, to);
        const FirstContact found =
            first_contact({.moving = moving, .fixed = fixed, .motion = motion, .options = {.margin = margin}});
        if (found.verdict != Verdict::contact)
            return false;
        at = motion.pose_at(found.time.upper);
        return true;
    }

    /// One step towards a pose; returns the answer.
    FirstContact step(const Pose& to) {
        const ScrewMotion motion = ScrewMotion::between(at, to);
        const double before = distance(at);
        FirstContactQuery query{.moving = moving,
                                .fixed = fixed,
                                .motion = motion,
                                .options = {.margin = margin, .hold = hold, .find = Find::first_with_all_contacts}};
        const FirstContact found = timed(query, tally.seconds);
        query.memory = &memory;
        expect_same(timed(query, tally.seconds_with_memory), found);
        count(found);
        const double end = found.clear_until;
        for (int i = 1; i <= samples; ++i) {
            SCOPED_TRACE("time " + std::to_string(end * i / samples) + " of " + std::to_string(end));
            expect_apart(motion.pose_at(end * i / samples), before, i == samples);
        }
        expect_reason(found, motion, before);
        at = found.verdict == Verdict::clear ? to : motion.pose_at(end);
        return found;
    }

private:
    static FirstContact timed(const FirstContactQuery& query, std::vector<double>& seconds) {
        const auto asked = std::chrono::steady_clock::now();
        FirstContact found = first_contact(query);
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - asked).count());
        return found;
    }

    static double least_gap(const FirstContact& found) {
        double least = std::numeric_limits<double>::infinity();
        for (const Contact& contact : found.contacts)
            least = std::min(least, contact.gap);
        return least;
    }

    /// A memory changes no answer, up to the tolerance of time; contacts may come in another order. Contacts are those
    /// within the bracket, and a wider one may have more.
    void expect_same(const FirstContact& with, const FirstContact& without) const {
        EXPECT_EQ(with.verdict, without.verdict);
        EXPECT_EQ(with.certain, without.certain);
        EXPECT_NEAR(with.time.lower, without.time.lower, 2e-12);
        EXPECT_NEAR(with.time.upper, without.time.upper, 2e-12);
        EXPECT_NEAR(with.clear_until, without.clear_until, 2e-12);
        if (with.time.lower == without.time.lower && with.time.upper == without.time.upper) {
            EXPECT_EQ(with.contacts.size(), without.contacts.size());
        }
        EXPECT_EQ(with.contacts.empty(), without.contacts.empty());
        if (!with.contacts.empty() && !without.contacts.empty()) {
            EXPECT_NEAR(least_gap(with), least_gap(without), 1e-9 * margin);
        }
        EXPECT_EQ(with.held.size(), without.held.size());
    }

    void count(const FirstContact& found) {
        ++tally.steps;
        tally.clear += found.verdict == Verdict::clear ? 1 : 0;
        tally.touching += found.verdict == Verdict::contact_at_start ? 1 : 0;
        tally.stuck += found.verdict != Verdict::clear && found.clear_until == 0 ? 1 : 0;
        if (found.verdict == Verdict::clear) {
            EXPECT_EQ(found.clear_until, 1);
        }
    }

    /// Checks the other distance, if there is one. At the end of the step, checks the slow distance of all pairs too.
    void expect_apart(const Pose& there, double before, bool is_end) {
        const double kept = std::min(hold, before);
        const double other = peer ? peer(there) : 0;
        if (peer) {
            EXPECT_GE(other, kept - peer_slack) << "from " << before << ", as the other distance has it";
            tally.lowest = std::min(tally.lowest, other / hold);
        }
        if (peer && !is_end)
            return;
        const double own = distance(there);
        tally.lowest = std::min(tally.lowest, own / hold);
        EXPECT_GE(own, kept - slack) << "from " << before;
        if (peer)
            tally.peer_error = std::max(tally.peer_error, std::abs(other - own));
    }

    /// A step that does not reach its goal stops at the hold distance.
    void expect_reason(const FirstContact& found, const ScrewMotion& motion, double before) {
        if (found.verdict != Verdict::contact)
            return;
        ++tally.held;
        tally.in_doubt += found.certain ? 0 : 1;
        ASSERT_FALSE(found.contacts.empty());
        const double inexact = slack + 1e-9 * margin, gap = found.contacts[0].gap;
        EXPECT_NEAR(distance(motion.pose_at(found.time.lower)), gap, inexact);
        EXPECT_LE(gap, std::min(hold, before) + inexact) << "not above the hold distance";
    }
};

} // namespace chasles::test
