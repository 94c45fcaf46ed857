#include "bench/translation_cases.h"

#include "bench/draw.h"

#include <cmath>

namespace chasles::bench {

namespace {

using Eigen::Vector3d;

enum class Course { contact, near_miss, past };

Point point(const Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

class Maker {
public:
    explicit Maker(Course course) : course_(course) {}

    /// The vertex crosses the plane once, at `time`. The crossing is inside the face, with weights in sixteenths. Or it
    /// lies beyond an edge: a point of the edge, moved away from the third corner by a part of their distance.
    VertexFaceProblem vertex_face() {
        for (;;) {
            const Vector3d a = vector();
            const Vector3d b = vector();
            const Vector3d c = vector();
            const Vector3d normal = (b - a).cross(c - a);
            if (normal.norm() < 0.2 || std::abs(normal.dot(way)) < 0.1 * normal.norm())
                continue;
            const double first = sixteenths(1, 14);
            const double second = sixteenths(1, 15 - int(16 * first));
            Vector3d crossing = first * a + second * b + (1 - first - second) * c;
            if (course_ == Course::near_miss) {
                const Vector3d on_edge = first * a + (1 - first) * b;
                crossing = on_edge + beyond() * (on_edge - c);
            }
            const double time = draw_time();
            return {point(crossing - start_before(time)), {point(a), point(b), point(c)}, time};
        }
    }

    /// The lines intersect once, at `time`, at sixteenths of both edges, or before the start of the moving edge.
    EdgeEdgeProblem edge_edge() {
        for (;;) {
            const Vector3d along = vector();
            const Vector3d across = vector();
            const Vector3d normal = along.cross(across);
            if (normal.norm() < 0.2 || std::abs(normal.dot(way)) < 0.1 * normal.norm())
                continue;
            const Vector3d crossing = 0.5 * vector();
            const double share = course_ == Course::near_miss ? -beyond() : sixteenths(1, 15);
            const double time = draw_time();
            const Vector3d from = crossing - share * along - start_before(time);
            const Vector3d fixed_from = crossing - sixteenths(1, 15) * across;
            return {{point(from), point(from + along)}, {point(fixed_from), point(fixed_from + across)}, time};
        }
    }

private:
    double whole(int from, int to) { return std::floor(draw_.between(from, to + 1)); }
    double sixteenths(int from, int to) { return whole(from, to) / 16; }
    Vector3d vector() {
        const auto coordinate = [&] { return whole(-0x10000, 0x10000) * 0x1p-16; };
        const double x = coordinate();
        const double y = coordinate();
        return {x, y, coordinate()};
    }
    double beyond() { return std::ldexp(1, -int(whole(3, 26))); }
    double draw_time() { return whole(13, 243) * 0x1p-8; }
    [[nodiscard]] Vector3d start_before(double time) const {
        return (course_ == Course::past ? -2 - time : time) * way;
    }

    Course course_;
    Draw draw_{elementary_seed};
};

template <class Problem, class Make>
std::vector<TranslationCase<Problem>> cases_of(const std::string& kind, Make make) {
    const auto problems = [&](Course course) {
        Maker maker(course);
        std::vector<Problem> made;
        for (std::size_t i = 0; i < elementary_problems; ++i)
            made.push_back(make(maker));
        return made;
    };
    return {{kind + ", contact", true, problems(Course::contact)},
            {kind + ", near miss", false, problems(Course::near_miss)},
            {kind + ", past each other", false, problems(Course::past)}};
}

} // namespace

std::vector<TranslationCase<VertexFaceProblem>> vertex_face_translations() {
    return cases_of<VertexFaceProblem>("vertex/face", [](Maker& maker) { return maker.vertex_face(); });
}

std::vector<TranslationCase<EdgeEdgeProblem>> edge_edge_translations() {
    return cases_of<EdgeEdgeProblem>("edge/edge", [](Maker& maker) { return maker.edge_edge(); });
}

} // namespace chasles::bench
