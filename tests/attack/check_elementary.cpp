#include "tests/attack/check_elementary.h"

#include "chasles/algebra/exact_feasible.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/search/touch_stages.h"
#include "tests/support/exact_reference.h"

#include <chrono>
#include <cstdio>

namespace chasles::attack {

namespace {

using algebra::DoubleDouble;
using algebra::FeasibleInterval;
using reference::Earliest;
using reference::Root;

/// Runs `work` and adds its duration.
template <class Work>
auto timed(double& seconds, Work work) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    auto result = work();
    seconds += std::chrono::duration<double>(Clock::now() - start).count();
    return result;
}

constexpr double tolerance = 1e-12;
/// The exact stage also runs for one in so many questions that need no exact arithmetic.
constexpr std::size_t exact_share = 16;

double reach(const std::vector<Question>& questions, std::vector<Eigen::Vector3d> Question::*points) {
    double result = 0;
    for (const Question& question : questions)
        for (const Eigen::Vector3d& p : question.*points)
            result = std::max(result, p.cwiseAbs().maxCoeff());
    return result;
}

template <class S>
algebra::Vector3<S> in_scalar(const Eigen::Vector3d& p) {
    return {S(p.x()), S(p.y()), S(p.z())};
}

/// One precision, with the setup of a query.
template <class S>
class Stage {
public:
    Stage(const motion::ControlMaps<S>& maps, const elementary::ErrorScale& scale)
        : maps_(maps), accuracy_{scale, {}} {}

    std::optional<FeasibleInterval> ask(const Question& question, const algebra::Tolerance& how) {
        accuracy_.tolerance = how;
        std::vector<algebra::Vector3<S>> a;
        std::vector<algebra::Vector3<S>> b;
        for (const Eigen::Vector3d& p : question.moving)
            a.push_back(in_scalar<S>(p));
        for (const Eigen::Vector3d& p : question.fixed)
            b.push_back(in_scalar<S>(p));
        switch (question.kind) {
        case QuestionKind::vertex_face: {
            const auto path = maps_.rotation * a[0] + maps_.translation;
            return elementary::vertex_face<S>({path, maps_.weight}, elementary::face_shape<S>(b, {}), accuracy_,
                                              workspace_);
        }
        case QuestionKind::face_vertex: {
            const auto path = maps_.rotation.transposed() * b[0] - maps_.inverse_translation;
            return elementary::vertex_face<S>({path, maps_.weight}, elementary::face_shape<S>(a, {}), accuracy_,
                                              workspace_);
        }
        case QuestionKind::edge_edge:
            return elementary::edge_edge<S>(maps_, elementary::edge_path(maps_, a[0], a[1]),
                                            elementary::fixed_edge(b[0], b[1]), accuracy_, workspace_);
        }
        return std::nullopt;
    }

private:
    const motion::ControlMaps<S>& maps_;
    elementary::Accuracy accuracy_;
    elementary::Workspace<S> workspace_;
};

bool is_decided(const std::optional<FeasibleInterval>& found) {
    return !found || (found->certain && found->upper - found->lower <= tolerance);
}

/// Counts an answer. Returns the error of the answer, or null.
const char* fault_of(std::optional<Root>& truth, const std::optional<FeasibleInterval>& found, Tally& tally) {
    ++tally.queries;
    tally.touches += truth ? 1 : 0;
    tally.uncertain += found && !found->certain ? 1 : 0;
    if (!truth) {
        tally.false_alarms += found && found->certain ? 1 : 0;
        return found && found->certain ? "certain of a contact that is none" : nullptr;
    }
    if (!found) {
        ++tally.missed;
        return "missed";
    }
    const auto order = [&](double x) {
        Root there = Root::point(x);
        return compare(*truth, there);
    };
    if (order(found->lower) < 0) {
        ++tally.late;
        return "late";
    }
    const bool behind = order(found->upper) > 0;
    if (!found->certain) {
        tally.loose += behind ? 1 : 0;
        return nullptr;
    }
    tally.outside += behind ? 1 : 0;
    tally.widest = std::max(tally.widest, found->upper - found->lower);
    return behind ? "certain of a bracket that the touch is not in" : nullptr;
}

std::string judged(const char* stage, std::optional<Root>& truth, const std::optional<FeasibleInterval>& found,
                   Tally& tally) {
    const char* fault = fault_of(truth, found, tally);
    return fault ? std::string(stage) + ": " + fault + "; " : "";
}

/// The exact answers to all questions of a group.
std::vector<std::optional<Root>> truths_of(const QuestionGroup& group) {
    reference::Surface moving;
    reference::Surface fixed;
    for (const Question& question : group.questions) {
        moving.vertices.insert(moving.vertices.end(), question.moving.begin(), question.moving.end());
        fixed.vertices.insert(fixed.vertices.end(), question.fixed.begin(), question.fixed.end());
    }
    reference::ExactScene scene(moving, fixed, group.posed.paths().at(0));
    std::vector<std::optional<Root>> result;
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    for (const Question& question : group.questions) {
        Earliest earliest;
        if (question.kind == QuestionKind::vertex_face)
            scene.vertex_triangle(earliest, a, {b, b + 1, b + 2});
        else if (question.kind == QuestionKind::face_vertex)
            scene.triangle_vertex(earliest, {a, a + 1, a + 2}, b);
        else
            scene.edges(earliest, {a, a + 1}, {b, b + 1});
        a += static_cast<std::uint32_t>(question.moving.size());
        b += static_cast<std::uint32_t>(question.fixed.size());
        result.push_back(earliest.first());
    }
    return result;
}

std::string described(const PosedMotion& posed, const Question& question) {
    std::string text = question.kind == QuestionKind::edge_edge     ? "edge, edge"
                       : question.kind == QuestionKind::vertex_face ? "vertex, face"
                                                                    : "face, vertex";
    char buffer[200];
    const auto add = [&](const char* name, const Eigen::Vector3d& v) {
        std::snprintf(buffer, sizeof buffer, "\n  %s %a %a %a", name, v.x(), v.y(), v.z());
        text += buffer;
    };
    for (const Eigen::Vector3d& p : question.moving)
        add("moving", p);
    for (const Eigen::Vector3d& p : question.fixed)
        add("fixed", p);
    text += posed.kind == MotionKind::screw ? "\n  screw" : "\n  sweep";
    text += posed.is_relative ? ", both bodies move" : ", the fixed body stands still";
    for (const Pose* pose : {&posed.moving_start, &posed.moving_goal, &posed.fixed_start, &posed.fixed_goal}) {
        add("pose", pose->translation);
        std::snprintf(buffer, sizeof buffer, "  %a %a %a %a", pose->rotation.w(), pose->rotation.x(),
                      pose->rotation.y(), pose->rotation.z());
        text += buffer;
    }
    return text + "\n";
}

} // namespace

StageTallies& StageTallies::operator+=(const StageTallies& other) {
    filter += other.filter;
    refinement += other.refinement;
    exact += other.exact;
    return *this;
}

std::string check(const QuestionGroup& group, StageTallies& tallies) {
    const Motion motion = group.posed.motion();
    const auto piece = motion.trajectory().pieces()->at(0);
    const auto fine_maps = motion::control_maps(piece->cubic());
    const auto maps = motion::rounded(fine_maps);
    const auto exact = piece->exact().value();
    const auto scale = elementary::error_scale(maps, reach(group.questions, &Question::moving),
                                               reach(group.questions, &Question::fixed));
    Stage<double> filter(maps, scale);
    Stage<DoubleDouble> refinement(fine_maps, scale);
    Stage<algebra::ExactNumber> decision(exact.maps, scale);
    auto truths = timed(tallies.filter.reference_seconds, [&] { return truths_of(group); });
    std::string wrong;
    for (std::size_t i = 0; i < truths.size(); ++i) {
        const Question& question = group.questions[i];
        const auto filtered =
            timed(tallies.filter.seconds, [&] { return filter.ask(question, search::filter_tolerance(tolerance)); });
        const algebra::Tolerance how =
            filtered ? search::refinement_tolerance(tolerance, *filtered) : algebra::Tolerance{tolerance, 0x1p-90};
        const auto refined = timed(tallies.refinement.seconds, [&] { return refinement.ask(question, how); });
        std::string what = judged("double", truths[i], filtered, tallies.filter) +
                           judged("double-double", truths[i], refined, tallies.refinement);
        if (i % exact_share == 0 || !is_decided(refined)) {
            const auto decided = timed(tallies.exact.seconds, [&] {
                return decision.ask(question, {tolerance, tolerance});
            });
            what += judged("exact", truths[i], decided, tallies.exact);
        }
        if (wrong.empty() && !what.empty())
            wrong = what + "\n" + described(group.posed, question);
    }
    return wrong;
}

} // namespace chasles::attack
