// The distance of two surfaces along an exact motion, sampled in extended precision. The samples can refute an answer,
// and give the least distance of bodies that pass each other.
#pragma once

#include "tests/support/exact_reference.h"
#include "tests/support/surface_distance.h"

#include <limits>

namespace chasles::reference {

class SampledDistance {
public:
    using Long = long double;

    SampledDistance(const Surface& moving, const Surface& fixed, const MotionPath<Rational>& path) {
        for_coefficients(path, path_, [](const Rational& from, Long& to, bool) { to = from.convert_to<Long>(); });
        add_triangles(moving, moving_);
        add_triangles(fixed, fixed_);
    }

    [[nodiscard]] Long at(Long tau) const {
        const auto value = [&](const auto& p) {
            Long result = 0;
            for (std::size_t i = p.size(); i-- > 0;)
                result = result * tau + p[i];
            return result;
        };
        Eigen::Matrix<Long, 3, 3> turn;
        Point3 shift;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j)
                turn(Eigen::Index(i), Eigen::Index(j)) = value(path_.turn[i][j]) / value(path_.weight);
            shift[Eigen::Index(i)] = value(path_.shift[i]) / value(path_.weight);
        }
        Long least = std::numeric_limits<Long>::infinity();
        for (const Triangle& body : moving_) {
            Triangle there;
            for (std::size_t i = 0; i < 3; ++i)
                there[i] = turn * body[i] + shift;
            for (const Triangle& other : fixed_)
                least = std::min(least, test::squared_distance_of_triangles<Long>(there, other));
        }
        return std::sqrt(least);
    }

    /// An approximation of the tau with the least distance, by `samples` and then by ternary search.
    [[nodiscard]] Long closest_tau(int samples) const {
        int best = 0;
        Long least = at(0);
        for (int i = 1; i <= samples; ++i)
            if (const Long distance = at(Long(i) / samples); distance < least) {
                least = distance;
                best = i;
            }
        Long lower = Long(std::max(best - 1, 0)) / samples;
        Long upper = Long(std::min(best + 1, samples)) / samples;
        for (int i = 0; i < 60; ++i) {
            const Long a = lower + (upper - lower) / 3;
            const Long b = upper - (upper - lower) / 3;
            if (at(a) < at(b))
                upper = b;
            else
                lower = a;
        }
        return (lower + upper) / 2;
    }

private:
    using Point3 = test::Point3<Long>;
    using Triangle = test::Triangle3<Long>;

    static void add_triangles(const Surface& surface, std::vector<Triangle>& triangles) {
        for (const auto& t : surface.triangles) {
            Triangle triangle;
            for (std::size_t i = 0; i < 3; ++i)
                triangle[i] = surface.vertices[t[i]].cast<Long>();
            triangles.push_back(triangle);
        }
    }

    MotionPath<Long> path_;
    std::vector<Triangle> moving_;
    std::vector<Triangle> fixed_;
};

} // namespace chasles::reference
