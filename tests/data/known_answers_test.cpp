// 2,036 mesh pairs under screws whose first contacts are known to 15 digits, from a program that shares no formula
// with this one. Covers rotations from 1e-14 to 3.05 rad and motions down to 1e-7 of a body.

#include "tests/data/screw_known_answers.h"
#include "view/names.h"

#include <numbers>

namespace chasles::test {
namespace {

bool encloses(const Bracket& bracket, double value) {
    return bracket.lower <= value && value <= bracket.upper;
}

struct Tally {
    int cases = 0;
    int wrong_verdicts = 0;
    int outside_bracket = 0;
    int uncertain = 0;
    double widest = 0; ///< bracket of time
    Work work;
};

Polyhedron polyhedron(const Json& mesh) {
    return Polyhedron::from_polygons(vertices_of(mesh), faces_of(mesh));
}

void answer(const Json& one, Tally& tally) {
    const FirstContact found =
        first_contact({.moving = polyhedron(one["moving"]),
                       .fixed = polyhedron(one["fixed"]),
                       .motion = ScrewMotion::between(pose(one["start"]), pose(one["goal"]), std::numbers::pi)});
    ++tally.cases;
    tally.work += found.work;
    const Json& truth = one["truth"];
    if (truth["verdict"] != view::name_of(found.verdict)) {
        ++tally.wrong_verdicts;
        ADD_FAILURE() << one["id"] << ": " << view::name_of(found.verdict) << " instead of " << truth;
        return;
    }
    if (found.verdict == Verdict::clear)
        return;
    tally.uncertain += found.certain ? 0 : 1;
    tally.widest = std::max(tally.widest, found.time.upper - found.time.lower);
    if (!encloses(found.tau, truth["tau"]) || !encloses(found.time, truth["time"])) {
        ++tally.outside_bracket;
        ADD_FAILURE() << one["id"] << ": tau in [" << found.tau.lower << ", " << found.tau.upper << "] excludes "
                      << truth;
    }
}

TEST(KnownAnswers, EveryVerdictIsRightAndEveryTauIsInsideItsBracket) {
    CHASLES_REQUIRE_DATA("screw-known-answers");
    Tally tally;
    const Stopwatch watch;
    for_each_known_answer([&](const Json& one) { answer(one, tally); });
    EXPECT_EQ(tally.cases, 2036);
    EXPECT_LE(tally.widest, 1e-12);
    print_figures("screw-known-answers: %d cases, %d wrong verdicts, %d outside the bracket, %d not certain, "
                  "widest bracket %.2g, %.2f s",
                  tally.cases, tally.wrong_verdicts, tally.outside_bracket, tally.uncertain, tally.widest,
                  watch.seconds());
    print_figures("  %llu elementary tests, %llu searched for roots, %llu repeated in double-double",
                  static_cast<unsigned long long>(tally.work.elementary_tests),
                  static_cast<unsigned long long>(tally.work.root_brackets),
                  static_cast<unsigned long long>(tally.work.refined));
}

} // namespace
} // namespace chasles::test
