// Compares the cost of a least distance with that of its proof alone: one query with that distance as margin. For each
// family of motions it prints medians. Where FCL is installed: its distances at 100 poses, and by how much the least of
// them is greater than the true one.
//
//     least_distance_bench [--questions=24]
#include "bench/bodies.h"
#include "bench/draw.h"
#ifdef CHASLES_BENCH_FCL
#include "bench/fcl_distance.h"
#endif
#include "bench/generated_bodies.h"
#include "bench/timings.h"
#include "chasles/chasles.h"
#include "chasles/mesh/body.h"
#include "scenes/spur_gear.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace chasles::bench {
namespace {

using Eigen::Vector3d;

/// How a body passes a copy of itself. Lengths count in radii of the body.
struct Family {
    const char* name;
    double from = 0; ///< the least distance of the middles
    double to = 0;
    double travel = 0;
    double turn = 0; ///< on the way, radians
};

constexpr Family families[] = {
    {"passes nearby", 1.6, 2.2, 2, 0.3}, {"passes at some distance", 2.5, 4, 2, 0.3},
    {"turns a lot", 2, 2.5, 1, 3},       {"short motion", 1.6, 2.2, 0.05, 0.01},
    {"through", 0.5, 1.5, 3, 0.3},
};

/// FCL's distances at 100 poses of some motions.
class Samples {
public:
    explicit Samples([[maybe_unused]] const Polyhedron& body)
#ifdef CHASLES_BENCH_FCL
        : fcl_(body, body)
#endif
    {
    }

    void ask([[maybe_unused]] const Motion& motion, [[maybe_unused]] double least) {
#ifdef CHASLES_BENCH_FCL
        constexpr std::size_t most = 5; // a motion may take a second
        if (times_.size() >= most)
            return;
        double sampled = 0;
        times_.push_back(least_microseconds(1, [&] { sampled = fcl_.least(motion, 100); }));
        excess_.push_back(sampled / least - 1);
#endif
    }
    [[nodiscard]] const std::vector<double>& times() const { return times_; }
    [[nodiscard]] const std::vector<double>& excess() const { return excess_; }

private:
#ifdef CHASLES_BENCH_FCL
    FclDistance fcl_;
#endif
    std::vector<double> times_;
    std::vector<double> excess_;
};

double greatest(const std::vector<double>& numbers) {
    return numbers.empty() ? 0 : *std::ranges::max_element(numbers);
}

void run(const NamedBody& body, const Family& family, int count, Samples samples) {
    Draw random(17);
    const double radius = body.body.body().bvh().radius();
    const Vector3d centre = body.body.body().bvh().centre();
    const auto beside = [&](const Eigen::Quaterniond& turn, const Vector3d& place) {
        return Pose{centre - turn * centre + radius * place, turn};
    };
    std::vector<double> times, margins, ratios;
    int touching = 0, wide = 0;
    double worst = 0;
    for (int i = 0; i < count; ++i) {
        const Eigen::Quaterniond turn = random.turn(0, 3);
        const Vector3d side = random.direction();
        const Vector3d along = side.cross(random.direction()).normalized();
        const Vector3d middle = random.between(family.from, family.to) * side;
        const Pose start = beside(turn, middle - family.travel * random.between(0, 1) * along);
        const Pose goal = beside(Eigen::AngleAxisd(family.turn, random.direction()) * turn,
                                 middle + family.travel * random.between(0, 1) * along);
        const LeastDistanceQuery query{body.body, body.body, ScrewMotion::between(start, goal), {}};
        LeastDistance least;
        const double time = least_microseconds(3, [&] { least = least_distance(query); });
        wide += least.certain ? 0 : 1;
        worst = std::max(worst, time);
        if (least.distance.upper <= 0) {
            ++touching;
            continue;
        }
        FirstContact clear;
        const double margin = least_microseconds(3, [&] {
            clear = first_contact({body.body, body.body, query.motion, {.margin = least.distance.lower}});
        });
        if (clear.verdict != Verdict::clear) {
            std::printf("nearer than the least distance\n");
            std::exit(1);
        }
        samples.ask(query.motion, least.distance.upper);
        times.push_back(time);
        margins.push_back(margin);
        ratios.push_back(time / margin);
    }
    std::printf("%-12s %-26s %10.1f %10.1f %7.2f %7.2f %8d %5d %12.1f %12.1f %8.1e %8.1e\n", body.name.c_str(),
                family.name, median(times), median(margins), median(ratios), greatest(ratios), touching, wide, worst,
                median(samples.times()), median(samples.excess()), greatest(samples.excess()));
}

int run_all(int count) {
    std::printf("%-12s %-26s %10s %10s %7s %7s %8s %5s %12s %12s %8s %8s\n", "body", "family", "least, us",
                "margin, us", "ratio", "worst", "touching", "wide", "worst, us", "FCL, us", "too far", "most");
    std::vector<NamedBody> bodies{
        {"box", peg({4, 1, 1})}, {"torus 4k", bumpy_torus(61, 30)}, {"gear", scenes::spur_gear({})}, large_body()};
    if (const auto small = small_gear())
        bodies.push_back({"small gear", *small});
    for (const NamedBody& body : bodies)
        for (const Family& family : families)
            run(body, family, count, Samples(body.body));
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
