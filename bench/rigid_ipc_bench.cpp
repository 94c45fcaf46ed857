// The first contact of each Rigid IPC fixture (docs/scenes-rigid-ipc.md) beside FCL's
// DynamicAABBTreeCollisionManager, which takes 10 and 100 discrete samples of the same motions and stops at the first
// overlap. The motions are one time step at the given velocities, and free falls. Each time is the least of several, on
// one thread. Poses at samples are part of FCL's times; its trees of triangles are not, and neither are ours.
#include "bench/fcl_scene.h"
#include "bench/timings.h"
#include "tests/data/rigid_ipc.h"

#include <algorithm>
#include <cstdio>

namespace chasles::bench {
namespace {

using test::RigidIpcFlight;

constexpr int calls = 7;

double milliseconds(const auto& work) {
    return least_microseconds(calls, work) / 1000;
}

/// FCL's samples of one scene.
struct Samples {
    double milliseconds = 0;
    double first = 2; ///< the time of the first overlap; 2 if none
};

Samples take_samples(FclScene& scene, int count) {
    Samples samples;
    samples.milliseconds = milliseconds([&] { samples.first = scene.first_sample(count); });
    return samples;
}

/// Sums over all fixtures.
struct Total {
    int contacts = 0;
    double chasles = 0;
    std::array<double, 2> samples{};
    std::array<int, 2> missed{};
};

/// Prints how late the samples see the contact at `time`, in parts of the motion.
void print_samples(const Samples& samples, bool touches, double time, int& missed) {
    std::printf("  %9.3f ms ", samples.milliseconds);
    if (samples.first > 1) {
        std::printf("%-12s", touches ? "missed" : "clear");
        missed += touches ? 1 : 0;
        return;
    }
    std::printf(touches && samples.first >= time ? "late %.4f " : "DISAGREE %g", samples.first - time);
}

void print_fixture(const test::RigidIpcFixture& fixture, double seconds, RigidIpcFlight flight, Total& total) {
    const Scene scene = rigid_ipc_scene(fixture, seconds, flight);
    SceneAnswer answer;
    const double first = milliseconds([&] { answer = scene.first_contact({.threads = 1}); });
    const bool touches = !answer.contacts.empty();
    FclScene fcl(scene);
    const std::array samples{take_samples(fcl, 10), take_samples(fcl, 100)};
    std::printf("%-38s %3zu bodies  %-11s at %.9f s  %9.3f ms   FCL", fixture.name.c_str(), scene.bodies().size(),
                touches ? "contact" : "clear until", answer.clear_until * seconds, first);
    total.contacts += touches ? 1 : 0;
    total.chasles += first;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        print_samples(samples[i], touches, answer.clear_until, total.missed[i]);
        total.samples[i] += samples[i].milliseconds;
    }
    std::printf("\n");
}

void print_flights(const char* title, const std::filesystem::path& folder, RigidIpcFlight flight) {
    std::printf("%s\n", title);
    Total total;
    for (const std::string& name : test::rigid_ipc_names(folder)) {
        const test::RigidIpcFixture fixture = test::read_rigid_ipc(folder, name);
        const double seconds = flight == RigidIpcFlight::even ? fixture.time_step : std::min(1.0, fixture.max_time);
        print_fixture(fixture, seconds, flight, total);
    }
    std::printf("%d contacts: Chasles %.1f ms; 10 samples %.1f ms, %d missed; 100 samples %.1f ms, %d missed\n\n",
                total.contacts, total.chasles, total.samples[0], total.missed[0], total.samples[1], total.missed[1]);
}

int run() {
    const std::filesystem::path folder = std::filesystem::path(CHASLES_DATA_DIR) / "rigid-ipc-scenes";
    if (!std::filesystem::exists(folder / "fixtures")) {
        std::printf("skipped: no folder rigid-ipc-scenes of real inputs\n");
        return 0;
    }
    print_flights("one time step at the given velocities", folder, RigidIpcFlight::even);
    print_flights("free fall for a second, or until the fixture ends", folder, RigidIpcFlight::falling);
    return 0;
}

} // namespace
} // namespace chasles::bench

int main() {
    return chasles::bench::run();
}
