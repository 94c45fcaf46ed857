// Simulated motions of CAD parts: the first contact lies between the two frames where a discrete test changes its
// result.

#include "tests/data/cad_frames.h"

namespace chasles::test {
namespace {

struct FirstStep {
    std::size_t step;
    FirstContact found;
};

/// The first step with a contact. Both bodies move.
FirstStep first_step(const std::string& set, const std::string& poses) {
    const Polyhedron moving = Polyhedron::load(shared_data("fcl-motions/" + set + "/obj1.obj"));
    const Polyhedron fixed = Polyhedron::load(shared_data("fcl-motions/" + set + "/obj2.obj"));
    const std::vector<Frame> frames = read_frames(shared_data("fcl-motions/" + set + "/" + poses));
    FirstStep result{0, {}};
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        const ScrewMotion motion =
            ScrewMotion::relative(frames[i].moving, frames[i + 1].moving, frames[i].fixed, frames[i + 1].fixed);
        result = {i, first_contact({.moving = moving, .fixed = fixed, .motion = motion})};
        if (result.found.verdict != Verdict::clear)
            break;
    }
    print_figures("%s %s: step %zu, %s, time %.15g (bracket %.1g), certain: %d", set.c_str(), poses.c_str(),
                  result.step, result.found.verdict == Verdict::contact ? "contact" : "contact at start or clear",
                  result.found.time.lower, result.found.time.upper - result.found.time.lower, result.found.certain);
    return result;
}

TEST(CadMotions, BevelGearsTouchWithinTheStep) {
    CHASLES_REQUIRE_DATA("fcl-motions");
    const FirstStep first = first_step("bevel-gears-coarse", "poses-step.csv");
    EXPECT_EQ(first.found.verdict, Verdict::contact);
    EXPECT_EQ(first.step, 0u);
    EXPECT_TRUE(first.found.certain);
}

TEST(CadMotions, RingMeetsPlateWithinTheStep) {
    CHASLES_REQUIRE_DATA("fcl-motions");
    const FirstStep first = first_step("ring-and-plate", "poses-scenario1.csv");
    EXPECT_EQ(first.found.verdict, Verdict::contact);
    EXPECT_TRUE(first.found.certain);
}

TEST(CadMotions, RingStartsInThePlate) {
    CHASLES_REQUIRE_DATA("fcl-motions");
    const FirstStep first = first_step("ring-and-plate", "poses-scenario2.csv");
    EXPECT_EQ(first.found.verdict, Verdict::contact_at_start);
    EXPECT_TRUE(first.found.overlap.has_value());
}

TEST(CadMotions, PolyhedronMeetsBlockBetweenFrames24And25) {
    CHASLES_REQUIRE_DATA("fcl-motions");
    const FirstStep first = first_step("polyhedron-and-block", "poses.csv");
    EXPECT_EQ(first.found.verdict, Verdict::contact);
    EXPECT_EQ(first.step, 24u);
    EXPECT_TRUE(first.found.certain);
}

} // namespace
} // namespace chasles::test
