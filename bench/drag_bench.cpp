// How long one update of a dragged body takes: hands at 60 Hz that press a body into others and move along.
//
// For each scene, without friction and with it, it prints the median, the 99th percentile and the slowest update in
// milliseconds, how many updates were in contact, and how many ended before they came to rest. Goals wander around a
// place where there is much to touch. The last columns are for forces for other goals, from the contacts of the last
// update.
//
//     drag_bench [--updates=600] [--only=SCENE] [--friction=MU] [--seconds=20] [--budget=0] [--rounds=8]
//
// No hand takes longer than `seconds` in all. `budget` bounds one update, in milliseconds (0: no
// bound). `rounds` bounds its steps: with one round, the times are those of single certified steps.
#include "bench/drag_cases.h"
#include "bench/timings.h"
#include "chasles/chasles.h"

#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>
#include <vector>

namespace chasles::bench {
namespace {

struct Limits {
    int updates = 600;
    double seconds = 20; ///< of one hand
    double budget = 0;   ///< of one update, ms
    int rounds = DragOptions{}.rounds;
    std::string_view only = {};
    std::vector<double> frictions = {0, 0.3};
};

/// What came of one hand.
struct Outcome {
    std::vector<double> updates; ///< ms
    std::vector<double> forces;  ///< for other goals near the last one, us
    int in_contact = 0;
    int unfinished = 0;
    std::size_t pieces = 0;
};

Outcome drag(const DragCase& hand, const Limits& limits, double friction) {
    Scene scene;
    scene.add({"fixed", hand.fixed});
    scene.add({"moving", hand.moving, Motion::at_rest(hand.start)});
    DragOptions options;
    options.friction = friction;
    options.rounds = limits.rounds;
    DraggedBody body(scene, "moving", options);
    Outcome outcome;
    double left = 1000 * limits.seconds;
    for (int i = 0; i < limits.updates && left > 0; ++i) {
        DragStep step;
        const Pose goal = goal_at(hand, i / 60.0);
        outcome.updates.push_back(least_microseconds(1, [&] { step = body.update(goal, limits.budget / 1000); }) /
                                  1000);
        left -= outcome.updates.back();
        outcome.in_contact += step.contacts.empty() ? 0 : 1;
        outcome.unfinished += step.state == DragState::moving ? 1 : 0;
        outcome.pieces += step.pieces.size();
        if (step.state == DragState::touching) {
            std::printf("%s: the bodies touch\n", hand.name.c_str());
            std::exit(1);
        }
        for (int k = 0; k < 4 && !step.contacts.empty(); ++k)
            outcome.forces.push_back(
                least_microseconds(1, [&] { (void)body.force(goal_at(hand, (i + k / 4.0) / 60)); }));
    }
    return outcome;
}

void print(const DragCase& hand, double friction, const Outcome& outcome) {
    const auto& [updates, forces, in_contact, unfinished, pieces] = outcome;
    std::printf("%-28s %8.1f %8zu %10d %10d %8.2f %8.3f %8.3f %8.3f %10.1f %8.1f\n", hand.name.c_str(), friction,
                updates.size(), in_contact, unfinished, double(pieces) / double(updates.size()), median(updates),
                quantile(updates, 0.99), quantile(updates, 1), median(forces), quantile(forces, 0.99));
    std::fflush(stdout);
}

void run_all(const Limits& limits) {
    std::printf("%-28s %8s %8s %10s %10s %8s %8s %8s %8s %10s %8s\n", "update, ms; force, us", "friction", "updates",
                "in contact", "unfinished", "pieces", "median", "99 %", "slowest", "force", "99 %");
    for (const std::string_view name : drag_case_names()) {
        if (!limits.only.empty() && name != limits.only)
            continue;
        const auto hand = drag_case(name);
        if (!hand)
            std::printf("%s: skipped, the data is missing\n", std::string(name).c_str());
        for (const double friction : limits.frictions)
            if (hand)
                print(*hand, friction, drag(*hand, limits, friction));
    }
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    chasles::bench::Limits limits;
    for (const std::string_view argument : std::span(argv, std::size_t(argc)).subspan(1)) {
        // options of Google Benchmark are for the other programs
        if (argument.starts_with("--updates="))
            limits.updates = std::max(1, std::atoi(argument.substr(10).data()));
        if (argument.starts_with("--seconds="))
            limits.seconds = std::max(0.1, std::atof(argument.substr(10).data()));
        if (argument.starts_with("--budget="))
            limits.budget = std::max(0.0, std::atof(argument.substr(9).data()));
        if (argument.starts_with("--rounds="))
            limits.rounds = std::max(1, std::atoi(argument.substr(9).data()));
        if (argument.starts_with("--friction="))
            limits.frictions = {std::atof(argument.substr(11).data())};
        if (argument.starts_with("--only="))
            limits.only = argument.substr(7);
    }
    chasles::bench::run_all(limits);
    return 0;
}
