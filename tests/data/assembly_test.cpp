// Real nuts on real bolts: micrometres of clearance, and only one free motion.

#include "tests/data/shared_data.h"

#include <cmath>
#include <numbers>

namespace chasles::test {
namespace {

constexpr double step_degrees = 10;

struct Thread {
    const char* nut;
    const char* bolt;
    double pitch;         ///< metres per turn
    double raised;        ///< in pitches, from the assembled state
    double first_contact; ///< degrees, when turned the other way
};

/// The nut turned by `degrees` along the thread from its raised pose.
Pose on_thread(const Thread& thread, double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    return {Eigen::Vector3d(0, 0, thread.pitch * (thread.raised + degrees / 360)),
            Eigen::Quaterniond(std::cos(half), 0, 0, std::sin(half))};
}

std::vector<Pose> turns(const Thread& thread, int steps, double step) {
    std::vector<Pose> poses;
    for (int i = 0; i <= steps; ++i)
        poses.push_back(on_thread(thread, i * step));
    return poses;
}

void expect_threads_to_run(const Thread& thread, const char* name) {
    const Polyhedron nut = Polyhedron::load(shared_data(thread.nut));
    const Polyhedron bolt = Polyhedron::load(shared_data(thread.bolt));
    const std::vector<Pose> off = turns(thread, 72, step_degrees);
    const Stopwatch watch;
    const PathContact up = first_contact_on_path({.moving = nut, .fixed = bolt, .motions = screws_along(off)});
    EXPECT_EQ(up.contact.verdict, Verdict::clear);
    print_figures("%s: two turns off: %s, %llu elementary tests, %.1f s", name,
                  up.contact.verdict == Verdict::clear ? "proven clear" : "CONTACT",
                  static_cast<unsigned long long>(up.contact.work.elementary_tests), watch.seconds());

    const std::vector<Pose> on = turns(thread, 30, -step_degrees);
    const PathContact down = first_contact_on_path({.moving = nut, .fixed = bolt, .motions = screws_along(on)});
    ASSERT_EQ(down.contact.verdict, Verdict::contact);
    EXPECT_TRUE(down.contact.certain);
    const double degrees = -step_degrees * (double(down.segment) + down.contact.time.lower);
    EXPECT_NEAR(degrees, thread.first_contact, 0.01);
    print_figures("%s: turned the other way: first contact at %.6f degrees (sampled: %.2f), bracket %.1g", name,
                  degrees, thread.first_contact, down.contact.time.upper - down.contact.time.lower);
}

TEST(Assembly, M16NutUnscrewsAndTouchesWhereItShould) {
    CHASLES_REQUIRE_DATA("assembly-factory");
    expect_threads_to_run({"assembly-factory/factory_nut_m16_loose_subdiv_3x.obj",
                           "assembly-factory/factory_bolt_m16_loose.obj", 0.002, 0.97, -136.80},
                          "M16 nut");
}

TEST(Assembly, M12NutUnscrewsAndTouchesWhereItShould) {
    CHASLES_REQUIRE_DATA("assembly-factory");
    expect_threads_to_run({"assembly-factory/factory_nut_m12_tight_subdiv_3x.obj",
                           "assembly-factory/factory_bolt_m12_tight.obj", 0.00175, 0.9275, -41.44},
                          "M12 nut");
}

} // namespace
} // namespace chasles::test
