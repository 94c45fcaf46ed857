// Runs the exact reference for each piece until a piece touches. Compiled without sanitizers, because it is not under
// test.
#include "tests/fuzz/exact_answer.h"

#include "chasles/motion/screw_path.h"
#include "tests/support/exact_reference.h"
#include "tests/support/trajectories.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <gmp.h>
#include <optional>

namespace chasles::fuzz {
namespace {

using reference::Rational;
using reference::operator+;
using reference::operator-;

/// Memory for GMP, which makes a hundred thousand small allocations per query. The pool hides these allocations from
/// the sanitizers and never returns its memory.
class Pool {
public:
    static void install() { mp_set_memory_functions(take, take_more, give_back); }

private:
    static constexpr std::size_t step = 16;
    static constexpr std::size_t largest = 1024;
    using Piece = std::array<std::byte, step>;

    static std::vector<void*>& waiting(std::size_t size) {
        static auto& lists = *new std::array<std::vector<void*>, largest / step + 1>;
        return lists[(size + step - 1) / step];
    }
    static void* take(std::size_t size) {
        if (size > largest)
            return std::malloc(size);
        std::vector<void*>& list = waiting(size);
        if (list.empty()) {
            const std::size_t pieces = (size + step - 1) / step;
            auto* const block = new Piece[64 * pieces];
            for (std::size_t i = 0; i < 64; ++i)
                list.push_back(block + i * pieces);
        }
        void* const place = list.back();
        list.pop_back();
        return place;
    }
    static void give_back(void* place, std::size_t size) {
        size > largest ? std::free(place) : waiting(size).push_back(place);
    }
    static void* take_more(void* place, std::size_t old_size, std::size_t new_size) {
        void* const larger = take(new_size);
        std::memcpy(larger, place, std::min(old_size, new_size));
        give_back(place, old_size);
        return larger;
    }
};

Rational exact(const algebra::DoubleDouble& x) {
    return Rational(x.high()) + Rational(x.low());
}
reference::Triple exact(const algebra::Vector3<algebra::DoubleDouble>& v) {
    return {exact(v.x), exact(v.y), exact(v.z)};
}
reference::ExactPose exact(const motion::GeneralPose<algebra::DoubleDouble>& pose) {
    return {exact(pose.translation), {exact(pose.rotation.w), exact(pose.rotation.v)}};
}

reference::Surface surface_of(const Polyhedron& body) {
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t face = 0; face < body.face_count(); ++face)
        faces.emplace_back(body.face(face).begin(), body.face(face).end());
    return reference::Surface::from_convex_faces(body.vertices(), faces);
}

double below(const Rational& x) {
    const auto nearest = x.convert_to<double>();
    return Rational(nearest) > x ? std::nextafter(nearest, -2.0) : nearest;
}
double above(const Rational& x) {
    return -below(Rational(-x));
}

/// The time of a tau for one of the paper's motions (the inverse of f).
long double time_at(const reference::Turn& turn, const Rational& tau) {
    const Rational square = reference::inner(turn.v, turn.v) / (turn.w * turn.w);
    const long double tangent = std::sqrt(square.convert_to<long double>());
    const auto at = tau.convert_to<long double>();
    return tangent < 1e-12L ? at : std::atan(at * tangent) / std::atan(tangent);
}

Rational volume_of(const reference::Triple& a, const reference::Triple& b, const reference::Triple& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// How often a surface goes around a point that is not on it: how often a ray leaves, less how often it enters. Empty
/// where the ray meets an edge.
std::optional<int> winding_along(const reference::Triple& ray, const reference::Surface& surface,
                                 const reference::Triple& point) {
    int winding = 0;
    for (const auto& triangle : surface.triangles) {
        std::array<reference::Triple, 3> seen;
        for (std::size_t i = 0; i < 3; ++i)
            seen[i] = reference::exact(surface.vertices[triangle[i]]) - point;
        std::array<int, 3> sides{};
        Rational along = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Rational side = volume_of(ray, seen[i], seen[(i + 1) % 3]);
            sides[i] = side.sign();
            along += side;
        }
        const auto [least, most] = std::ranges::minmax(sides);
        if (least < 0 && most > 0)
            continue; // beside the triangle
        if (least == 0 || most == 0)
            return std::nullopt;
        if (volume_of(seen[0], seen[1], seen[2]).sign() == along.sign())
            winding += along.sign();
    }
    return winding;
}

int winding_around(const reference::Surface& surface, const reference::Triple& point) {
    for (int turn = 0;; ++turn)
        if (const auto winding = winding_along(
                {Rational(7919 + turn), Rational(104 + 31 * turn * turn), Rational(-1299 + 17 * turn)}, surface, point))
            return *winding;
}

bool has_closed_parts(const Polyhedron& body) {
    return body.report().solid_parts + body.report().inward_parts > 0;
}

/// Tests the pieces of a motion in order until a piece touches.
class ExactSearch {
public:
    ExactSearch(const Polyhedron& moving, const Polyhedron& fixed)
        : moving_(surface_of(moving)), fixed_(surface_of(fixed)), moving_is_solid_(has_closed_parts(moving)),
          fixed_is_solid_(has_closed_parts(fixed)) {}

    ExactAnswer along(const ScrewMotion& whole) {
        ExactAnswer answer;
        const motion::ScrewPieces pieces = whole.trajectory().pieces();
        const std::size_t count = pieces.size();
        for (std::size_t i = 0; i < count && !answer.touches; ++i) {
            const motion::RelativeEnds ends = pieces[i].relative_ends();
            const auto start = exact(ends.start);
            const auto goal = exact(ends.goal);
            const auto turn = reference::detail::shorter_turn(start, goal);
            look(answer, reference::screw_path(start, goal), {i, count},
                 [&](const Rational& tau) { return time_at(turn, tau); });
            if (i == 0 && !answer.at_start)
                look_inside(answer, start);
        }
        return answer;
    }

    /// The turn must have a rational length. `centre` is the centre of SweepMotion.
    ExactAnswer along(const SweepMotion& whole, const Eigen::Vector3d& centre) {
        ExactAnswer answer;
        const motion::RelativeEnds ends = test::relative_ends_of(whole);
        look(answer, reference::sweep_path(exact(ends.start), exact(ends.goal), reference::exact(centre)), {0, 1},
             [](const Rational& tau) { return tau.convert_to<long double>(); });
        if (!answer.at_start)
            look_inside(answer, exact(ends.start));
        return answer;
    }

private:
    struct Piece {
        std::size_t index;
        std::size_t count;
    };

    /// Surfaces do not meet there, so one corner of a part stands for all of it.
    void look_inside(ExactAnswer& answer, const reference::ExactPose& start) {
        const auto has_corner_in = [](const reference::Surface& inner, const reference::Surface& outer, auto place) {
            return std::ranges::any_of(inner.corners, [&](std::uint32_t corner) {
                return winding_around(outer, place(reference::exact(inner.vertices[corner]))) > 0;
            });
        };
        answer.moving_is_inside = fixed_is_solid_ && has_corner_in(moving_, fixed_, [&](const reference::Triple& v) {
                                      return turned(v, start.rotation) + start.translation;
                                  });
        answer.fixed_is_inside = moving_is_solid_ && has_corner_in(fixed_, moving_, [&](const reference::Triple& v) {
                                     return turned(v - start.translation, start.rotation.conjugate());
                                 });
    }

    template <class TimeAt>
    void look(ExactAnswer& answer, const reference::MotionPath<Rational>& path, const Piece& piece, TimeAt time_at) {
        reference::ExactScene scene(moving_, fixed_, path);
        auto first = scene.first_touch();
        if (!first)
            return;
        const Rational lower = first->narrowed();
        const Rational upper = lower + Rational(0x1p-60);
        const auto whole = [&](const Rational& part) {
            return Rational((Rational(piece.index) + part) / Rational(piece.count));
        };
        const auto whole_time = [&](const Rational& part) {
            return (static_cast<long double>(piece.index) + time_at(part)) / static_cast<long double>(piece.count);
        };
        answer.touches = true;
        answer.at_start = piece.index == 0 && scene.touches_at_start();
        answer.tau_lower = below(whole(lower));
        answer.tau_upper = above(whole(upper));
        answer.time_lower = static_cast<double>(whole_time(lower) * (1 - 0x1p-52L));
        answer.time_upper = static_cast<double>(whole_time(upper) * (1 + 0x1p-52L));
    }

    reference::Surface moving_;
    reference::Surface fixed_;
    bool moving_is_solid_;
    bool fixed_is_solid_;
};

} // namespace

ExactAnswer exact_answer(const Question& question) {
    [[maybe_unused]] static const bool is_installed = (Pool::install(), true); // before the first number is made
    ExactSearch search(question.moving, question.fixed);
    if (const auto* screw = std::get_if<ScrewMotion>(&question.motion))
        return search.along(*screw);
    return search.along(std::get<SweepMotion>(question.motion), question.centre);
}

} // namespace chasles::fuzz
