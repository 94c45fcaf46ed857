#include "bench/elementary_cases.h"

#include <cmath>
#include <numbers>
#include <random>

namespace chasles::bench {

namespace {

using algebra::DoubleDouble;

motion::ControlMaps<DoubleDouble> ten_degrees() {
    using Vector = algebra::Vector3<DoubleDouble>;
    const double half = std::numbers::pi / 36;
    const double sine = std::sin(half);
    const motion::GeneralPose<DoubleDouble> start{Vector{0.1, -0.2, 0.05}, {1.0, {}}};
    const motion::GeneralPose<DoubleDouble> goal{Vector{0.4, -0.1, 0.3},
                                                 {std::cos(half), {0.36 * sine, 0.48 * sine, 0.8 * sine}}};
    return motion::control_maps(motion::screw_between(start, goal));
}

class Maker {
public:
    explicit Maker(const motion::ControlMaps<double>& maps) : maps_(maps) {}

    VertexFaceProblem vertex_face_contact() {
        VertexFaceProblem problem;
        problem.vertex = point();
        problem.tau = uniform(0.05, 0.95);
        const Point contact = moved(problem.vertex, problem.tau);
        const Point along = scale(point(), 0.3);
        const Point across = scale(point(), 0.3);
        problem.face = {contact - along - across, contact + along, contact + across};
        return problem;
    }

    /// The vertex stays on one side of the plane, because the face lies where the vertex never arrives.
    VertexFaceProblem vertex_face_rejection() {
        VertexFaceProblem problem = vertex_face_contact();
        const Point normal = cross(problem.face[1] - problem.face[0], problem.face[2] - problem.face[0]);
        for (Point& corner : problem.face)
            corner = corner + scale(normal, 1.5 / std::sqrt(dot(normal, normal)));
        return problem;
    }

    EdgeEdgeProblem edge_edge_contact() {
        EdgeEdgeProblem problem;
        problem.moving = {point(), point()};
        problem.tau = uniform(0.05, 0.95);
        const double share = uniform(0.1, 0.9);
        const Point contact =
            moved(problem.moving[0] + scale(problem.moving[1] - problem.moving[0], share), problem.tau);
        const Point along = scale(point(), 0.3);
        problem.fixed = {contact - along, contact + along};
        return problem;
    }

    /// The lines stay apart: they are far from parallel, and their distance exceeds the travel of the moving line.
    EdgeEdgeProblem edge_edge_rejection() {
        for (;;) {
            EdgeEdgeProblem problem = edge_edge_contact();
            const Point u = problem.moving[1] - problem.moving[0];
            const Point v = problem.fixed[1] - problem.fixed[0];
            const Point normal = cross(u, v);
            if (dot(normal, normal) < 0.5 * dot(u, u) * dot(v, v))
                continue;
            for (Point& end : problem.fixed)
                end = end + scale(normal, 1.5 / std::sqrt(dot(normal, normal)));
            return problem;
        }
    }

private:
    double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
    Point point() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }

    [[nodiscard]] Point moved(const Point& body_point, double tau) const {
        const auto position = maps_.rotation * body_point + maps_.translation;
        const double weight = value_at(maps_.weight, tau);
        return {value_at(position.x, tau) / weight, value_at(position.y, tau) / weight,
                value_at(position.z, tau) / weight};
    }

    const motion::ControlMaps<double>& maps_;
    std::mt19937_64 random_{elementary_seed};
};

template <class Make>
auto many(Make make) {
    std::vector<decltype(make())> all(elementary_problems);
    for (auto& problem : all)
        problem = make();
    return all;
}

} // namespace

ElementaryCases elementary_cases() {
    ElementaryCases cases{ten_degrees(), {}, {}, {}, {}, {}};
    cases.maps = motion::rounded(cases.exact_maps);
    Maker maker(cases.maps);
    cases.vertex_face_contacts = many([&] { return maker.vertex_face_contact(); });
    cases.vertex_face_rejections = many([&] { return maker.vertex_face_rejection(); });
    cases.edge_edge_contacts = many([&] { return maker.edge_edge_contact(); });
    cases.edge_edge_rejections = many([&] { return maker.edge_edge_rejection(); });
    return cases;
}

} // namespace chasles::bench
