// Dragged bodies in all scenes of bench/drag_cases.h. FCL judges each pose reached and the ways between: nothing comes
// nearer than claimed, so nothing penetrates, and no step leads through anything. CHASLES_LONG=1 in the environment: a
// hundred thousand updates in all.
#include "tests/data/shared_data.h"
#include "tests/support/posed_motions.h"

#ifdef CHASLES_TESTS_FCL
#include "tests/data/drag_trial.h"
#endif

namespace chasles::test {
namespace {

/// A case, and how much of it.
struct Trial {
    const char* name;
    int updates;      ///< in a test run
    int long_updates; ///< in the long one
    int samples;      ///< of FCL, at least, of a piece that is near a contact all the way
    bool has_free_goals = true;
};

void PrintTo(const Trial& trial, std::ostream* out) {
    *out << trial.name;
}

class DragTrial : public testing::TestWithParam<Trial> {};

#ifdef CHASLES_TESTS_FCL
void print(const TrialTally& tally, const Trial& trial, double seconds) {
    print_figures("%s: %d updates, %d in contact, %d sliding, %d reached, %d resting, %d far goals, %d spins; %ld "
                  "pieces, %ld samples of FCL, nearest %.6f of the clearance; slowest update %.1f ms, mean %.2f ms; "
                  "%.0f s in all",
                  trial.name, tally.updates, tally.in_contact, tally.sliding, tally.reached, tally.resting, tally.far,
                  tally.spins, tally.pieces, tally.samples, tally.nearest, 1e3 * tally.slowest,
                  1e3 * tally.updating / std::max(1, tally.updates), seconds);
}

TrialTally drag(const bench::DragCase& asked, const Trial& trial, int count) {
    Random random(21);
    Scene scene;
    scene.add({"fixed", asked.fixed});
    scene.add({"moving", asked.moving, Motion::at_rest(asked.start)});
    DraggedBody body(scene, "moving");
    WayJudge judge(asked.moving, asked.fixed);
    ViolentHand hand(asked, random);
    TrialTally tally;
    bool was_in_contact = false;
    for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
        SCOPED_TRACE("update " + std::to_string(i));
        const Pose before = body.pose(), goal = hand.goal(i, before, tally);
        const Stopwatch watch;
        const DragStep step = body.update(goal);
        tally.updating += watch.seconds();
        tally.slowest = std::max(tally.slowest, watch.seconds());
        EXPECT_NE(step.state, DragState::touching);
        judge.check(before, step, trial.samples, tally);
        ++tally.updates;
        tally.in_contact += !step.contacts.empty();
        tally.sliding += was_in_contact && !step.contacts.empty() && !step.pieces.empty();
        tally.reached += step.state == DragState::reached;
        tally.resting += step.state == DragState::resting;
        was_in_contact = !step.contacts.empty();
    }
    return tally;
}
#endif

TEST_P(DragTrial, NothingPenetratesAndNothingIsPassedThrough) {
#ifndef CHASLES_TESTS_FCL
    GTEST_SKIP() << "skipped: FCL is not installed";
#else
    const Trial& trial = GetParam();
    const auto asked = bench::drag_case(trial.name);
    if (!asked)
        GTEST_SKIP() << "skipped: the data of \"" << trial.name << "\" is missing";
    const Stopwatch watch;
    const TrialTally tally = drag(*asked, trial, times_if_long(2) == 2 ? trial.long_updates : trial.updates);
    print(tally, trial, watch.seconds());
    EXPECT_GT(tally.in_contact, 0.3 * tally.updates);
    EXPECT_GT(tally.sliding, tally.updates > 1 ? 0.1 * tally.updates : -1);
    if (tally.updates >= 200) {
        EXPECT_GT(tally.reached, trial.has_free_goals ? 0.03 * tally.updates : -1);
        EXPECT_GT(tally.far, 0.005 * tally.updates);
        EXPECT_GT(tally.spins, 0.005 * tally.updates);
    }
#endif
}

INSTANTIATE_TEST_SUITE_P(
    , DragTrial,
    testing::Values(Trial{"box on a plate", 300, 50000, 8}, Trial{"peg of 64 sides in its hole", 20, 3000, 3},
                    Trial{"nut on its bolt", 3, 400, 3, false}, Trial{"gear at a gear", 20, 3000, 3},
                    Trial{"key in a maze", 50, 15000, 4}, Trial{"bunny on bunny", 10, 3000, 4},
                    Trial{"piano in a house", 50, 16000, 4}, Trial{"round peg, loose", 10, 1500, 3},
                    Trial{"round peg, tight", 10, 1500, 3}, Trial{"rectangular peg, loose", 15, 3200, 3},
                    Trial{"rectangular peg, tight", 15, 3200, 3}, Trial{"M16 nut, loose", 2, 150, 2, false},
                    Trial{"M12 nut, tight", 1, 50, 2, false}),
    [](const auto& trial) {
        std::string name;
        for (const char letter : std::string(trial.param.name))
            if (std::isalnum(static_cast<unsigned char>(letter)))
                name += letter;
        return name;
    });

} // namespace
} // namespace chasles::test
