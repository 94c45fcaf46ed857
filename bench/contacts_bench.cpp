// The cost of listing all contacts: the same questions with find = first and with find = first_with_all_contacts, one
// after the other. For each family of questions it prints medians, and how many lists took longer than three times the
// first contact and ten microseconds a contact. The verdicts and brackets are compared before they count.
//
//     contacts_bench [--questions=24]
#include "bench/bodies.h"
#include "bench/draw.h"
#include "bench/generated_bodies.h"
#include "chasles/chasles.h"
#include "chasles/mesh/body.h"
#include "scenes/spur_gear.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace chasles::bench {
namespace {

using Eigen::Vector3d;

/// Where two copies of a body start. Lengths count in radii of the body.
struct Family {
    const char* name;
    double from = 0; ///< the distance of the middles at the start
    double to = 0;
    double goal = 0; ///< the distance at the goal
    double turn = 0; ///< the greatest angle between the bodies at the start, radians
    double margin = 0;
};

constexpr Family families[] = {
    {"touch on the way", 2.2, 2.2, 0.9, 3, 0},
    {"overlap at the start", 0.2, 1, 0, 3, 0},
    {"coincide", 0, 0, 1, 0, 0},
    {"margin of 1e-3, on the way", 2.2, 2.2, 0.9, 3, 2e-3},
    {"margin of 0.1, on the way", 2.2, 2.2, 0.9, 3, 0.2},
    {"margin of 0.1, near it at the start", 1.6, 2.1, 0.9, 3, 0.2},
    {"margin of 0.5, within it at the start", 2, 2.5, 0.9, 3, 1},
    {"margin of 0.03, coincide", 0, 0, 1, 0, 0.06},
};

struct Times {
    double first = 0;
    double all = 0;
    std::size_t contacts = 0;
    bool is_cut = false;
};

/// The shortest of three runs in turns, microseconds.
Times time_of(FirstContactQuery query) {
    Times times{1e300, 1e300, 0, false};
    for (int run = 0; run < 3; ++run) {
        FirstContact answers[2];
        for (const bool lists : {false, true}) {
            query.options.find = lists ? Find::first_with_all_contacts : Find::first;
            const auto start = std::chrono::steady_clock::now();
            answers[lists] = first_contact(query);
            const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - start;
            double& shortest = lists ? times.all : times.first;
            shortest = std::min(shortest, taken.count());
        }
        if (answers[0].verdict != answers[1].verdict || answers[0].time.lower != answers[1].time.lower) {
            std::printf("the answers differ\n");
            std::exit(1);
        }
        times.contacts = answers[1].contacts.size();
        times.is_cut = answers[1].contacts_cut;
    }
    return times;
}

template <class Number>
Number median(std::vector<Number> numbers) {
    std::ranges::sort(numbers);
    return numbers[numbers.size() / 2];
}

void run(const NamedBody& body, const Family& family, int count) {
    Draw random(17);
    const double radius = body.body.body().bvh().radius();
    const Vector3d centre = body.body.body().bvh().centre();
    const auto beside = [&](const Eigen::Quaterniond& turn, const Vector3d& place) {
        return Pose{centre - turn * centre + radius * place, turn};
    };
    std::vector<double> first, all, ratios;
    std::vector<std::size_t> contacts;
    double worst = 0;
    int slow = 0, cut = 0;
    for (int i = 0; i < count; ++i) {
        const Eigen::Quaterniond turn = random.turn(0, family.turn);
        const Vector3d way = random.direction();
        const Pose start = beside(turn, random.between(family.from, family.to) * way);
        const Pose goal = beside(random.turn(0, 0.3) * turn, family.goal * way + 0.2 * random.direction());
        const Times times = time_of({.moving = body.body,
                                     .fixed = body.body,
                                     .motion = ScrewMotion::between(start, goal),
                                     .options = {.margin = family.margin * radius}});
        first.push_back(times.first);
        all.push_back(times.all);
        ratios.push_back(times.all / times.first);
        contacts.push_back(times.contacts);
        worst = std::max(worst, times.all);
        slow += times.all > 3 * times.first + 10 * double(times.contacts) ? 1 : 0;
        cut += times.is_cut ? 1 : 0;
    }
    std::printf("%-14s %-38s %10.1f %10.1f %7.2f %9zu %6d %6d %12.1f\n", body.name.c_str(), family.name, median(first),
                median(all), median(ratios), median(contacts), slow, cut, worst);
}

/// A box that lands flat on a plate, both of many triangles.
void run_flat(int times) {
    const Polyhedron box = subdivided(peg({4, 1, 1}), times);
    const Polyhedron plate = subdivided(peg({4, 3, 1}), times);
    const Times taken =
        time_of({.moving = box,
                 .fixed = plate,
                 .motion = ScrewMotion::between(Pose{{0.1, 0.2, 3}, {1, 0, 0, 0}}, Pose{{0.1, 0.2, 0}, {1, 0, 0, 0}})});
    std::printf("%-14s %-38s %10.1f %10.1f %7.2f %9zu %6d %6d %12.1f\n", "box on plate",
                (std::to_string(box.face_count()) + " triangles").c_str(), taken.first, taken.all,
                taken.all / taken.first, taken.contacts, taken.all > 3 * taken.first + 10 * double(taken.contacts),
                taken.is_cut, taken.all);
}

int run_all(int count) {
    std::printf("%-14s %-38s %10s %10s %7s %9s %6s %6s %12s\n", "body", "family", "first, us", "all, us", "ratio",
                "contacts", "slow", "cut", "worst, us");
    std::vector<NamedBody> bodies{{"torus 4k", bumpy_torus(61, 30)}, {"gear", scenes::spur_gear({})}, large_body()};
    if (const auto small = small_gear())
        bodies.push_back({"small gear", *small});
    for (const NamedBody& body : bodies)
        for (const Family& family : families)
            run(body, family, count);
    for (const int times : {0, 2, 4, 6})
        run_flat(times);
    return 0;
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    constexpr std::string_view option = "--questions=";
    int count = 24;
    for (const std::string_view argument : std::span(argv, std::size_t(argc)).subspan(1))
        if (argument.starts_with(option)) // options of Google Benchmark are for the other programs
            count = std::max(1, std::atoi(argument.substr(option.size()).data()));
    return chasles::bench::run_all(count);
}
