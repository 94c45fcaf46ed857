#include "tests/attack/check_elementary.h"

#include "chasles/elementary/edge_edge.h"
#include "tests/support/exact_reference.h"

#include <chrono>
#include <cstdio>

namespace chasles::attack {

namespace {

using algebra::DoubleDouble;
using algebra::FeasibleInterval;
using reference::Earliest;
using reference::Root;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class S>
constexpr algebra::Tolerance tolerance_of = {1e-12, 1e-12};
template <>
inline constexpr algebra::Tolerance tolerance_of<DoubleDouble> = {1e-12, 0x1p-90};

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

/// One precision, set up as a query sets it up.
template <class S>
class Stage {
public:
    Stage(const motion::ControlMaps<S>& maps, const elementary::ErrorScale& scale)
        : maps_(maps), accuracy_{scale, tolerance_of<S>} {}

    std::optional<FeasibleInterval> ask(const Question& question) {
        std::vector<algebra::Vector3<S>> a;
        std::vector<algebra::Vector3<S>> b;
        for (const Eigen::Vector3d& p : question.moving)
            a.push_back(in_scalar<S>(p));
        for (const Eigen::Vector3d& p : question.fixed)
            b.push_back(in_scalar<S>(p));
        switch (question.kind) {
        case QuestionKind::vertex_face: {
            const auto path = maps_.turn * a[0] + maps_.shift;
            return elementary::vertex_face<S>({path, maps_.weight}, elementary::face_shape<S>(b, {}), accuracy_,
                                              workspace_);
        }
        case QuestionKind::face_vertex: {
            const auto path = maps_.turn.transposed() * b[0] - maps_.inverse_shift;
            return elementary::vertex_face<S>({path, maps_.weight}, elementary::face_shape<S>(a, {}), accuracy_,
                                              workspace_);
        }
        case QuestionKind::edge_edge:
            return elementary::edge_edge<S>(maps_, elementary::edge_path(maps_, a[0], a[1]), {b[0], b[1] - b[0]},
                                            accuracy_, workspace_);
        }
        return std::nullopt;
    }

private:
    const motion::ControlMaps<S>& maps_;
    elementary::Accuracy accuracy_;
    elementary::Workspace<S> workspace_;
};

std::string judged(std::optional<Root>& truth, const std::optional<FeasibleInterval>& found, Tally& tally) {
    ++tally.queries;
    tally.touches += truth ? 1 : 0;
    tally.uncertain += found && !found->certain ? 1 : 0;
    if (!truth) {
        tally.false_alarms += found && found->certain ? 1 : 0;
        return found && found->certain ? "certain of a contact that is none" : "";
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
        return "";
    }
    tally.outside += behind ? 1 : 0;
    tally.widest = std::max(tally.widest, found->upper - found->lower);
    return behind ? "certain of a bracket that the touch is not in" : "";
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

std::string check(const QuestionGroup& group, StageTallies& tallies) {
    const Motion motion = group.posed.motion();
    const auto& rational = std::visit(
        [](const auto& m) -> const motion::RationalMotion<DoubleDouble>& { return m.frame().motion; }, motion);
    const auto exact_maps = motion::control_maps(rational);
    const auto maps = motion::rounded(exact_maps);
    const auto scale = elementary::error_scale(maps, reach(group.questions, &Question::moving),
                                               reach(group.questions, &Question::fixed));
    Stage<double> filter(maps, scale);
    Stage<DoubleDouble> refinement(exact_maps, scale);
    std::vector<std::optional<FeasibleInterval>> filtered;
    std::vector<std::optional<FeasibleInterval>> refined;
    const double start = now();
    for (const Question& question : group.questions)
        filtered.push_back(filter.ask(question));
    const double middle = now();
    for (const Question& question : group.questions)
        refined.push_back(refinement.ask(question));
    const double end = now();
    auto truths = truths_of(group);
    tallies.filter.seconds += middle - start;
    tallies.refinement.seconds += end - middle;
    tallies.filter.reference_seconds += now() - end;
    std::string wrong;
    for (std::size_t i = 0; i < truths.size(); ++i) {
        const std::string first = judged(truths[i], filtered[i], tallies.filter);
        const std::string second = judged(truths[i], refined[i], tallies.refinement);
        if (wrong.empty() && !(first + second).empty())
            wrong =
                "double: " + first + ", double-double: " + second + "\n" + described(group.posed, group.questions[i]);
    }
    return wrong;
}

} // namespace chasles::attack
