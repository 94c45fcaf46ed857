// Nanoseconds of one elementary detection: rejected by signs, solved in double precision, or refined in double-double
// precision. Each detection computes paths and shapes from the points of its features; rows with "ready" reuse paths
// and shapes computed in advance. Each problem is timed separately to show the spread. Answers are checked before
// timing.
#include "bench/elementary_detector.h"
#include "bench/run_benchmarks.h"
#include "chasles/search/touch_stages.h"

#include <algorithm>
#include <cstdio>

namespace chasles::bench {
namespace {

using algebra::DoubleDouble;
using algebra::FeasibleInterval;
using Answer = std::optional<FeasibleInterval>;

/// A problem with its answer from the filter, the input of the refinement.
template <class Problem>
struct Found : Problem {
    FeasibleInterval found;
};

template <class Problem>
std::vector<Found<Problem>> found_by(Detector<double> filter, const std::vector<Problem>& problems) {
    std::vector<Found<Problem>> all;
    for (const Problem& problem : problems)
        all.push_back({problem, filter(problem).value_or(FeasibleInterval{})});
    return all;
}

class Refinement {
public:
    explicit Refinement(const ElementaryCases& cases) : detect_(cases.exact_maps, cases.maps, {}) {}

    template <class Problem>
    Answer operator()(const Found<Problem>& problem) {
        detect_.use(search::refinement_tolerance(1e-12, problem.found));
        return detect_(problem);
    }

private:
    Detector<DoubleDouble> detect_;
};

template <class Ready, class Problem>
std::vector<Ready> made_ready(const Detector<double>& detector, const std::vector<Problem>& problems) {
    std::vector<Ready> all(problems.size());
    for (std::size_t i = 0; i < problems.size(); ++i)
        detector.make_ready(problems[i], all[i]);
    return all;
}

/// The first test of a query for a vertex (docs/derivations/13-face-sides.md).
struct SideOfPlane {
    int operator()(const ReadyVertexFace& ready) const { return ready.plane.side_of(ready.vertex); }
};

/// The problem is built from a known contact. The answer must not be later than this contact, up to the rounding of the
/// problem. Brackets are far narrower than this test demands, except for edges that barely cross.
template <class Detect, class Problem>
bool finds_contacts(Detect detect, const std::vector<Problem>& problems) {
    return std::all_of(problems.begin(), problems.end(), [&](const Problem& problem) {
        const Answer found = detect(problem);
        return found && found->lower <= problem.tau + 1e-9 && found->upper - found->lower <= 1e-6;
    });
}

/// Rejects a pair without a search for roots.
template <class Problem>
bool rejects(Detector<double> detect, const std::vector<Problem>& problems) {
    const bool all = std::none_of(problems.begin(), problems.end(),
                                  [&](const Problem& problem) { return detect(problem).has_value(); });
    return all && detect.root_brackets() == 0;
}

template <class Detect, class Problem>
void report_spread(benchmark::State& state, Detect& detect, const std::vector<Problem>& problems) {
    std::vector<double> times;
    for (const Problem& problem : problems)
        times.push_back(nanoseconds_of(7, 50, [&] { return detect(problem); }));
    std::sort(times.begin(), times.end());
    state.counters["median_ns"] = times[times.size() / 2];
    state.counters["p99_ns"] = times[times.size() * 99 / 100];
    state.counters["worst_ns"] = times.back();
}

template <class Detect, class Problem>
void add(const char* name, const Detect& detector, const std::vector<Problem>& problems) {
    benchmark::RegisterBenchmark(name, [detector, &problems](benchmark::State& state) {
        Detect detect = detector;
        report_spread(state, detect, problems);
        std::size_t next = 0;
        for (auto _ : state) {
            benchmark::DoNotOptimize(detect(problems[next]));
            next = next + 1 == problems.size() ? 0 : next + 1;
        }
    });
}

int run(int argc, char** argv) {
    const ElementaryCases cases = elementary_cases();
    const Detector<double> filter(cases.maps, cases.maps, search::filter_tolerance(1e-12));
    const Refinement refinement(cases);
    const auto vertex_face_found = found_by(filter, cases.vertex_face_contacts);
    const auto edge_edge_found = found_by(filter, cases.edge_edge_contacts);
    const auto vertex_face_ready = made_ready<ReadyVertexFace>(filter, cases.vertex_face_rejections);
    const auto edge_edge_ready = made_ready<ReadyEdgeEdge>(filter, cases.edge_edge_rejections);
    const std::pair<const char*, bool> checks[] = {
        {"vertex/face in double", finds_contacts(filter, cases.vertex_face_contacts)},
        {"vertex/face in double-double", finds_contacts(refinement, vertex_face_found)},
        {"vertex/face rejections", rejects(filter, cases.vertex_face_rejections)},
        {"edge/edge in double", finds_contacts(filter, cases.edge_edge_contacts)},
        {"edge/edge in double-double", finds_contacts(refinement, edge_edge_found)},
        {"edge/edge rejections", rejects(filter, cases.edge_edge_rejections)},
        {"the same with features ready", rejects(filter, vertex_face_ready) && rejects(filter, edge_edge_ready)}};
    std::printf("%zu problems of each kind, seed %u\n", elementary_problems, elementary_seed);
    bool right = true;
    for (const auto& [what, holds] : checks) {
        std::printf("%-28s %s\n", what, holds ? "checked" : "an answer is wrong");
        right = right && holds;
    }
    if (!right)
        return 1;
    add("vertex_face/rejection", filter, cases.vertex_face_rejections);
    add("vertex_face/rejection_ready", filter, vertex_face_ready);
    add("vertex_face/side_of_plane", SideOfPlane(), vertex_face_ready);
    add("vertex_face/solve", filter, cases.vertex_face_contacts);
    add("vertex_face/refinement", refinement, vertex_face_found);
    add("edge_edge/rejection", filter, cases.edge_edge_rejections);
    add("edge_edge/rejection_ready", filter, edge_edge_ready);
    add("edge_edge/solve", filter, cases.edge_edge_contacts);
    add("edge_edge/refinement", refinement, edge_edge_found);
    return run_benchmarks(argc, argv);
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    return chasles::bench::run(argc, argv);
}
