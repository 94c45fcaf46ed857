// The slowest elementary detection that an adversarial search finds, and the median of ordinary detections. A detection
// is the work of a query for one pair: in double precision, and in double-double precision for an uncertain answer. The
// exact stage, which usually runs for one pair per query, is timed separately.
#include "bench/elementary_detector.h"
#include "bench/run_benchmarks.h"
#include "chasles/algebra/exact_feasible.h"
#include "chasles/motion/exact_motion.h"
#include "chasles/motion/motion.h"
#include "chasles/search/touch_stages.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <random>

namespace chasles::bench {
namespace {

using algebra::DoubleDouble;
using algebra::ExactNumber;

/// One motion in the form of each stage.
struct Stages {
    explicit Stages(const MotionFrame& frame)
        : exact(motion::exact_motion(frame)), fine(motion::control_maps(frame.motion)), rounded(motion::rounded(fine)),
          filter(rounded, rounded, search::filter_tolerance(1e-12)), refinement(fine, rounded, {}),
          decision(exact.maps, rounded, {1e-12, 1e-12}) {}

    motion::ExactMotion exact;
    motion::ControlMaps<DoubleDouble> fine;
    motion::ControlMaps<double> rounded;
    Detector<double> filter;
    Detector<DoubleDouble> refinement;
    Detector<ExactNumber> decision;
};

bool is_decided(const std::optional<algebra::FeasibleInterval>& found) {
    return !found || (found->certain && found->upper - found->lower <= 1e-12);
}

template <class Problem>
bool detect(Stages& stages, const Problem& problem) {
    const auto found = stages.filter(problem);
    if (is_decided(found))
        return true;
    stages.refinement.use(search::refinement_tolerance(1e-12, *found));
    return is_decided(stages.refinement(problem));
}

/// All numbers of a problem. The search changes them one by one.
std::array<double*, 12> numbers_of(VertexFaceProblem& p) {
    return {&p.vertex.x,  &p.vertex.y,  &p.vertex.z,  &p.face[0].x, &p.face[0].y, &p.face[0].z,
            &p.face[1].x, &p.face[1].y, &p.face[1].z, &p.face[2].x, &p.face[2].y, &p.face[2].z};
}
std::array<double*, 12> numbers_of(EdgeEdgeProblem& p) {
    return {&p.moving[0].x, &p.moving[0].y, &p.moving[0].z, &p.moving[1].x, &p.moving[1].y, &p.moving[1].z,
            &p.fixed[0].x,  &p.fixed[0].y,  &p.fixed[0].z,  &p.fixed[1].x,  &p.fixed[1].y,  &p.fixed[1].z};
}

template <class Problem>
struct Found {
    Problem problem{};
    std::size_t motion = 0;
    double nanoseconds = 0;
};

/// Hill climbing from many starting points, by changes that create coincidences and near coincidences.
template <class Problem>
class WorstSearch {
public:
    explicit WorstSearch(std::deque<Stages>& motions) : motions_(motions) {}

    Found<Problem> run(const std::vector<Problem>& ordinary, int beginnings, int steps) {
        Found<Problem> worst;
        for (int i = 0; i < beginnings; ++i) {
            Found<Problem> best{ordinary[random_() % ordinary.size()], random_() % motions_.size(), 0};
            for (int step = 0; step < steps; ++step) {
                Found<Problem> next = best;
                for (int changes = 1 + int(random_() % 3); changes > 0; --changes)
                    change(next);
                next.nanoseconds = cost(next, 3, 2);
                if (next.nanoseconds >= best.nanoseconds)
                    best = next;
            }
            best.nanoseconds = cost(best, 20, 10);
            if (best.nanoseconds > worst.nanoseconds)
                worst = best;
        }
        return worst;
    }

private:
    double cost(const Found<Problem>& found, int timings, int repeats) {
        return nanoseconds_of(timings, repeats, [&] { return detect(motions_[found.motion], found.problem); });
    }

    void change(Found<Problem>& found) {
        const auto numbers = numbers_of(found.problem);
        double& number = *numbers[random_() % numbers.size()];
        const double other = *numbers[random_() % numbers.size()];
        const double uniform = std::uniform_real_distribution<double>(-1, 1)(random_);
        switch (random_() % 8) {
        case 0:
            number = uniform;
            break;
        case 1:
            number = other;
            break;
        case 2:
            number = -other;
            break;
        case 3:
            number = std::round(number * 4) / 4;
            break;
        case 4:
            number += uniform * std::pow(10.0, -double(random_() % 17));
            break;
        case 5:
            number += std::copysign(std::ldexp(1.0, std::max(-100, std::ilogb(number) - 52)), uniform);
            break;
        case 6:
            number = 0;
            break;
        default:
            found.motion = random_() % motions_.size();
            break;
        }
        number = std::clamp(number, -elementary_extent, elementary_extent);
    }

    std::deque<Stages>& motions_;
    std::mt19937_64 random_{elementary_seed};
};

std::deque<Stages> motions() {
    std::deque<Stages> result;
    const auto add = [&](const Eigen::Vector3d& shift, const Eigen::Quaterniond& turn) {
        result.emplace_back(ScrewMotion::between(Pose(), Pose(shift, turn)).frame());
    };
    const Eigen::Vector3d away(0.3, 0.1, 0.25);
    add(away, Eigen::Quaterniond(1, 0.03, 0.04, 0.07));
    add(away, Eigen::Quaterniond::Identity());
    add({0.5, 0, 0}, Eigen::Quaterniond::Identity());
    add({0, 0, 0}, Eigen::Quaterniond(12, 0, 0, 1));
    add({0, 0, 0.5}, Eigen::Quaterniond(12, 0, 0, 1));
    add(away, Eigen::Quaterniond(1, 0, 0, 2));
    add(away, Eigen::Quaterniond(1, 1e-9, 0, 0));
    return result;
}

template <class Problem>
double median(Detector<double> filter, const std::vector<Problem>& problems) {
    std::vector<double> times;
    for (const Problem& problem : problems)
        times.push_back(nanoseconds_of(7, 50, [&] { return filter(problem); }));
    std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(times.size() / 2), times.end());
    return times[times.size() / 2];
}

template <class Problem>
void add(const std::string& name, std::deque<Stages>& motions, const std::vector<Problem>& ordinary,
         const Detector<double>& filter) {
    const double usual = median(filter, ordinary);
    const Found<Problem> worst = WorstSearch<Problem>(motions).run(ordinary, 40, 1500);
    std::printf("%-12s median %.0f ns, worst found %.0f ns, ratio %.1f (motion %zu):\n ", name.c_str(), usual,
                worst.nanoseconds, worst.nanoseconds / usual, worst.motion);
    Problem shown = worst.problem;
    for (const double* number : numbers_of(shown))
        std::printf(" %a", *number);
    std::printf("\n");
    benchmark::RegisterBenchmark((name + "/worst").c_str(), [&motions, worst, usual](benchmark::State& state) {
        for (auto _ : state)
            benchmark::DoNotOptimize(detect(motions[worst.motion], worst.problem));
        state.counters["median_ns"] = usual;
    });
    benchmark::RegisterBenchmark((name + "/exact").c_str(), [&motions, ordinary](benchmark::State& state) {
        std::size_t next = 0;
        for (auto _ : state)
            benchmark::DoNotOptimize(motions[0].decision(ordinary[next++ % ordinary.size()]));
    });
    benchmark::RegisterBenchmark((name + "/exact_worst").c_str(), [&motions, worst](benchmark::State& state) {
        for (auto _ : state)
            benchmark::DoNotOptimize(motions[worst.motion].decision(worst.problem));
    });
}

int run(int argc, char** argv) {
    static std::deque<Stages> all = motions();
    const ElementaryCases cases = elementary_cases();
    const Detector<double> filter(cases.maps, cases.maps, search::filter_tolerance(1e-12));
    add("vertex_face", all, cases.vertex_face_contacts, filter);
    add("edge_edge", all, cases.edge_edge_contacts, filter);
    return run_benchmarks(argc, argv);
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    return chasles::bench::run(argc, argv);
}
