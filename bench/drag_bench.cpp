// How long one update of a dragged body takes: hands at 60 Hz that press a body into others and move along.
//
// For each scene it prints the median, the 99th percentile and the slowest update in milliseconds, how many updates
// were in contact, and how many ended before they came to rest. Goals wander around a place where there is much to
// touch.
//
//     drag_bench [--updates=600]
#include "bench/drag_cases.h"
#include "bench/timings.h"
#include "chasles/chasles.h"

#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace chasles::bench {
namespace {

/// The time of a force for another goal, from the contacts of the last update. Microseconds.
void run_forces(const DragCase& hand, int updates, double friction) {
    Scene scene;
    scene.add({"fixed", hand.fixed});
    scene.add({"moving", hand.moving, Motion::at_rest(hand.start)});
    DragOptions options;
    options.friction = friction;
    DraggedBody body(scene, "moving", options);
    std::vector<double> times;
    std::size_t most_contacts = 0;
    for (int i = 0; i < updates; ++i) {
        const DragStep step = body.update(goal_at(hand, i / 60.0));
        most_contacts = std::max(most_contacts, step.contacts.size());
        for (int k = 0; k < 16 && !step.contacts.empty(); ++k)
            times.push_back(least_microseconds(1, [&] { (void)body.force(goal_at(hand, (i + k / 16.0) / 60)); }));
    }
    if (!times.empty())
        std::printf("  force, us, friction %.1f       %8.1f %8.1f %8.1f   (%zu contacts at most)\n", friction,
                    median(times), quantile(times, 0.99), quantile(times, 1), most_contacts);
}

void run(const DragCase& hand, int updates) {
    Scene scene;
    scene.add({"fixed", hand.fixed});
    scene.add({"moving", hand.moving, Motion::at_rest(hand.start)});
    DraggedBody body(scene, "moving");
    std::vector<double> times;
    int in_contact = 0, unfinished = 0;
    std::size_t pieces = 0;
    for (int i = 0; i < updates; ++i) {
        const Pose goal = goal_at(hand, i / 60.0);
        DragStep step;
        times.push_back(least_microseconds(1, [&] { step = body.update(goal); }) / 1000);
        in_contact += step.contacts.empty() ? 0 : 1;
        unfinished += step.state == DragState::moving ? 1 : 0;
        pieces += step.pieces.size();
        if (step.state == DragState::touching) {
            std::printf("%s: the bodies touch\n", hand.name.c_str());
            std::exit(1);
        }
    }
    std::printf("%-28s %8.3f %8.3f %8.3f %10d %10d %8.2f\n", hand.name.c_str(), median(times), quantile(times, 0.99),
                quantile(times, 1), in_contact, unfinished, double(pieces) / updates);
    for (const double friction : {0.0, 0.3})
        run_forces(hand, updates, friction);
}

void run_all(int updates) {
    std::printf("%-28s %8s %8s %8s %10s %10s %8s\n", "update, ms", "median", "99 %", "slowest", "in contact",
                "unfinished", "pieces");
    for (const std::string_view name : drag_case_names())
        if (const auto hand = drag_case(name))
            run(*hand, updates);
        else
            std::printf("%s: skipped, the data is missing\n", std::string(name).c_str());
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    constexpr std::string_view option = "--updates=";
    int updates = 600;
    for (const std::string_view argument : std::span(argv, std::size_t(argc)).subspan(1))
        if (argument.starts_with(option)) // options of Google Benchmark are for the other programs
            updates = std::max(1, std::atoi(argument.substr(option.size()).data()));
    chasles::bench::run_all(updates);
    return 0;
}
