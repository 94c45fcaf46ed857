// What a query does for one feature pair, in any scalar.
#pragma once

#include "bench/elementary_cases.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <optional>

namespace chasles::bench {

template <class S>
class Detector {
public:
    using Vector = algebra::Vector3<S>;
    using Answer = std::optional<algebra::FeasibleInterval>;

    Detector(const motion::ControlMaps<S>& maps, const motion::ControlMaps<double>& rounded,
             const algebra::Tolerance& tolerance)
        : maps_(maps), accuracy_{elementary::error_scale(rounded, elementary_reach, elementary_reach), tolerance} {}

    Answer operator()(const VertexFaceProblem& problem) {
        const Vector corners[] = {in_scalar(problem.face[0]), in_scalar(problem.face[1]), in_scalar(problem.face[2])};
        const auto position = maps_.turn * in_scalar(problem.vertex) + maps_.shift;
        return elementary::vertex_face<S>({position, maps_.weight}, elementary::face_shape<S>(corners, {}), accuracy_,
                                          workspace_);
    }

    Answer operator()(const EdgeEdgeProblem& problem) {
        const auto path = elementary::edge_path(maps_, in_scalar(problem.moving[0]), in_scalar(problem.moving[1]));
        const Vector from = in_scalar(problem.fixed[0]);
        const elementary::FixedEdge<S> fixed{from, in_scalar(problem.fixed[1]) - from};
        return elementary::edge_edge<S>(maps_, path, fixed, accuracy_, workspace_);
    }

    /// Asks with another tolerance from now on.
    void use(const algebra::Tolerance& tolerance) { accuracy_.tolerance = tolerance; }

    [[nodiscard]] std::uint64_t root_brackets() const { return workspace_.root_brackets; }

private:
    static Vector in_scalar(const Point& p) { return {S(p.x), S(p.y), S(p.z)}; }

    const motion::ControlMaps<S>& maps_;
    elementary::Accuracy accuracy_;
    elementary::Workspace<S> workspace_;
};

/// The least of a few timings: the machine is shared.
template <class Work>
double nanoseconds_of(int timings, int repeats, Work work) {
    using Clock = std::chrono::steady_clock;
    double least = 1e18;
    for (int timing = 0; timing < timings; ++timing) {
        const auto start = Clock::now();
        for (int i = 0; i < repeats; ++i)
            benchmark::DoNotOptimize(work());
        least = std::min(least, std::chrono::duration<double, std::nano>(Clock::now() - start).count() / repeats);
    }
    return least;
}

} // namespace chasles::bench
