// The work of a query for one feature pair, in any scalar.
#pragma once

#include "bench/elementary_cases.h"
#include "chasles/elementary/face_sides.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <optional>

namespace chasles::bench {

/// Two features with the data that a query computes once per feature. Not movable: the shape of the face refers to the
/// corners.
struct ReadyVertexFace {
    algebra::Vector3<algebra::Bernstein<3, double>> position;
    std::array<Point, 3> corners;
    elementary::FaceShape<double> face;
    elementary::RelativePlane<double> plane; ///< the plane of the face
    Point vertex;
};
struct ReadyEdgeEdge {
    elementary::EdgePath<double> moving;
    elementary::FixedEdge<double> fixed;
};

template <class S>
class Detector {
public:
    using Vector = algebra::Vector3<S>;
    using Answer = std::optional<algebra::FeasibleInterval>;

    Detector(const motion::ControlMaps<S>& maps, const motion::ControlMaps<double>& rounded,
             const algebra::Tolerance& tolerance)
        : maps_(maps), accuracy_{elementary::error_scale(rounded, elementary_extent, elementary_extent), tolerance} {}

    Answer operator()(const VertexFaceProblem& problem) {
        const Vector corners[] = {in_scalar(problem.face[0]), in_scalar(problem.face[1]), in_scalar(problem.face[2])};
        const auto position = maps_.rotation * in_scalar(problem.vertex) + maps_.translation;
        return elementary::vertex_face<S>({position, maps_.weight}, elementary::face_shape<S>(corners, {}), accuracy_,
                                          workspace_);
    }

    Answer operator()(const EdgeEdgeProblem& problem) {
        const auto path = elementary::edge_path(maps_, in_scalar(problem.moving[0]), in_scalar(problem.moving[1]));
        const auto fixed = elementary::fixed_edge(in_scalar(problem.fixed[0]), in_scalar(problem.fixed[1]));
        return elementary::edge_edge<S>(maps_, path, fixed, accuracy_, workspace_);
    }

    Answer operator()(const ReadyVertexFace& ready) {
        return elementary::vertex_face<double>({ready.position, maps_.weight}, ready.face, accuracy_, workspace_);
    }
    Answer operator()(const ReadyEdgeEdge& ready) {
        return elementary::edge_edge<double>(maps_, ready.moving, ready.fixed, accuracy_, workspace_);
    }

    void make_ready(const VertexFaceProblem& problem, ReadyVertexFace& ready) const {
        ready.vertex = problem.vertex;
        ready.position = maps_.rotation * problem.vertex + maps_.translation;
        ready.corners = problem.face;
        ready.face = elementary::face_shape<double>(ready.corners, {});
        ready.plane = elementary::plane_of_fixed_face(maps_, ready.face, accuracy_.scale);
    }
    void make_ready(const EdgeEdgeProblem& problem, ReadyEdgeEdge& ready) const {
        ready.moving = elementary::edge_path(maps_, problem.moving[0], problem.moving[1]);
        ready.fixed = elementary::fixed_edge(problem.fixed[0], problem.fixed[1]);
    }

    /// Changes the tolerance of later detections.
    void use(const algebra::Tolerance& tolerance) { accuracy_.tolerance = tolerance; }

    [[nodiscard]] std::uint64_t root_brackets() const { return workspace_.root_brackets; }

private:
    static Vector in_scalar(const Point& p) { return {S(p.x), S(p.y), S(p.z)}; }

    const motion::ControlMaps<S>& maps_;
    elementary::Accuracy accuracy_;
    elementary::Workspace<S> workspace_;
};

/// The minimum of several timings, because other work on the machine only adds time.
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
