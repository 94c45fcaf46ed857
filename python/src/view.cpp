// chasles._core.view_page: the page of an answer. python/chasles/view.py writes it to a file.
#include "chasles/base/invalid_input.h"
#include "chasles/base/sort.h"
#include "python/src/answer.h"
#include "python/src/bind.h"
#include "python/src/query_options.h"
#include "python/src/signals.h"
#include "python/src/without_gil.h"
#include "view/page.h"
#include "view/proven_verdict.h"

#include <algorithm>
#include <nanobind/stl/string.h>
#include <optional>
#include <vector>

namespace chasles::python {

namespace nb = nanobind;

namespace {

using namespace nb::literals;

/// The numbers of the kinds of motion whose numbers a page shows.
std::optional<view::MotionNumbers> shown_numbers(const TypedMotion& motion) {
    return std::visit(
        [](const auto& typed) -> std::optional<view::MotionNumbers> {
            if constexpr (requires { view::numbers_of(typed); })
                return view::numbers_of(typed);
            else
                return std::nullopt;
        },
        motion);
}

/// Equal steps as dense as a page of a screw has, and the time of the contact.
std::vector<double> shown_times(const FirstContact& found, std::size_t steps) {
    std::vector<double> times;
    for (std::size_t i = 0; i <= steps; ++i)
        times.push_back(double(i) / double(steps));
    if (found.verdict != Verdict::clear)
        times.push_back(found.time.lower);
    chasles::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

/// Any motion as a record of two bodies. It shows no numbers of the motion.
view::SceneRecord record_of(const Answer& answer, const Polyhedron& moving, const Polyhedron& fixed) {
    const Motion motion = plain(answer.motion);
    const FirstContact& found = answer.found;
    const std::vector<double> times = shown_times(found, view::sampled_poses(motion).moving.size() - 1);
    std::vector<Pose> moving_poses, fixed_poses;
    for (const double time : times) {
        moving_poses.push_back(motion.pose_at(time));
        fixed_poses.push_back(motion.fixed_pose_at(time));
    }
    view::SceneRecord record{.source = view::RecordSource::first_contact,
                             .margin = answer.margin,
                             .clear_until = found.clear_until,
                             .times = times};
    record.bodies = {{"", moving, view::pose_rows(moving_poses)}, {"", fixed, view::pose_rows(fixed_poses)}};
    if (found.verdict != Verdict::clear)
        record.contacts.push_back({.time = found.time.lower,
                                   .time_upper = found.time.upper,
                                   .certain = found.certain,
                                   .moving = 0,
                                   .fixed = 1,
                                   .contacts = found.contacts,
                                   .overlap = found.overlap,
                                   .inside = found.inside});
    return record;
}

std::string view_page(const Answer& answer, const std::string& title, const std::string& moving_name,
                      const std::string& fixed_name, bool curve) {
    view::require_answer(answer.found.verdict);
    if (answer.moving.is_none())
        throw InvalidInput(
            "view: the scene is clear, so the answer has no pair of bodies; scene.view(found) shows all");
    const Motion motion = plain(answer.motion);
    const std::optional<view::MotionNumbers> numbers = shown_numbers(answer.motion);
    const Polyhedron& moving = nb::cast<const Body&>(answer.moving).polyhedron;
    const Polyhedron& fixed = nb::cast<const Body&>(answer.fixed).polyhedron;
    const WithoutGil without_gil;
    const EndsBySignals ends_by_signals;
    std::optional<view::Curve> shown_curve;
    if (curve)
        shown_curve = view::curve_of(profile({moving, fixed, motion}), answer.margin);
    if (!numbers) {
        view::SceneRecord record = record_of(answer, moving, fixed);
        record.curve = std::move(shown_curve);
        record.title = title;
        record.bodies[0].name = moving_name;
        record.bodies[1].name = fixed_name;
        return view::scene_page(record);
    }
    const view::Scene scene{.moving = moving,
                            .fixed = fixed,
                            .motion = motion,
                            .numbers = *numbers,
                            .found = answer.found,
                            .margin = answer.margin,
                            .title = title,
                            .moving_name = moving_name,
                            .fixed_name = fixed_name,
                            .curve = std::move(shown_curve)};
    return view::page(scene);
}

} // namespace

void bind_view(nb::module_& module) {
    module.def("view_page", view_page, "found"_a, "title"_a, "moving_name"_a, "fixed_name"_a, "curve"_a,
               "A page of HTML in UTF-8 that shows the answer. The page needs no network.");
}

} // namespace chasles::python
