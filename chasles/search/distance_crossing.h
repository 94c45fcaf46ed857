// Times at which the distance of two features crosses the margin, and whether it is within it at the start.
// Source: docs/derivations/16-margin.md.
#pragma once

#include "chasles/algebra/first_feasible.h"
#include "chasles/culling/time_tree.h"
#include "chasles/search/feature_tests.h"

#include <algorithm>

namespace chasles::search {

/// Collects the first tau at which the distance is the margin, over all problems of a pair of features.
class FirstCrossing {
public:
    explicit FirstCrossing(const algebra::Tolerance& tolerance) : tolerance_(tolerance) {}

    template <int Degree, class S>
    void operator()(const algebra::FeasibilityProblem<Degree, S>& problem) {
        const auto tau = algebra::first_feasible(problem, tolerance_);
        if (tau && (!first_ || tau->lower < first_->lower))
            first_ = tau;
    }
    [[nodiscard]] const std::optional<FeasibleInterval>& first() const { return first_; }

private:
    algebra::Tolerance tolerance_;
    std::optional<FeasibleInterval> first_;
};

/// Collects whether the distance is within the margin at the start of the interval.
class WithinAtStart {
public:
    enum class Answer : std::uint8_t { no, uncertain, yes };

    template <int Degree, class S>
    void operator()(const algebra::FeasibilityProblem<Degree, S>& problem) {
        const S zero(0);
        const auto sign = [&](const S& value, const algebra::Bounded<Degree, S>& bounded) {
            const S band = bounded.error * problem.weight[0];
            return value > band ? Answer::yes : value < zero - band ? Answer::no : Answer::uncertain;
        };
        Answer answer = sign(zero - problem.function.polynomial[0], problem.function);
        for (const auto& constraint : problem.constraints)
            answer = std::min(answer, sign(constraint.first.polynomial[0], constraint.first));
        answer_ = std::max(answer_, answer);
    }
    [[nodiscard]] Answer answer() const { return answer_; }

private:
    Answer answer_ = Answer::no;
};

/// The distance tests over any part of a piece.
template <class S>
class PartTests {
public:
    /// The maps of the whole piece are kept by reference.
    PartTests(const FeatureTests<S>& tests, const motion::ControlMaps<S>& whole) : whole_(whole), tests_(tests) {}

    void use(const culling::TimeRange& part) {
        part_ = part;
        maps_ = part == culling::TimeRange() ? whole_ : motion::restricted(whole_, S(part.lower), S(part.upper));
        tests_.use(maps_, {});
    }
    [[nodiscard]] FeatureTests<S>& tests() { return tests_; }
    [[nodiscard]] const culling::TimeRange& part() const { return part_; }

    /// The first crossing in the part, in terms of the whole piece.
    std::optional<FeasibleInterval> first_crossing(const FeaturePair& features, const algebra::Tolerance& tolerance) {
        FirstCrossing collect(tolerance); // NOLINT(misc-const-correctness): changed through the generic lambda
        tests_.distance(features, [&](const auto& problem) { collect(problem); });
        return in_piece(collect.first());
    }

    /// A crossing in the part in terms of the whole piece. Ends of brackets are rounded outward.
    [[nodiscard]] std::optional<FeasibleInterval> in_piece(std::optional<FeasibleInterval> tau) const {
        constexpr double rounding = 0x1p-51;
        if (tau) {
            tau->lower = std::max(part_.lower, part_.at(tau->lower) * (1 - rounding));
            tau->upper = std::min(part_.upper, part_.at(tau->upper) * (1 + rounding));
        }
        return tau;
    }

private:
    const motion::ControlMaps<S>& whole_;
    culling::TimeRange part_{0, 0};
    motion::ControlMaps<S> maps_;
    FeatureTests<S> tests_;
};

} // namespace chasles::search
