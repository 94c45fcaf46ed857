// chasles._core.view_page: the page of an answer. python/chasles/view.py writes it to a file.
#include "chasles/base/invalid_input.h"
#include "python/src/answer.h"
#include "python/src/bind.h"
#include "python/src/query_options.h"
#include "python/src/signals.h"
#include "python/src/without_gil.h"
#include "view/page.h"
#include "view/proven_verdict.h"
#include "view/sampled_track.h"

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

/// Any motion as a record of two bodies. It shows no numbers of the motion.
view::SceneRecord record_of(const Answer& answer, const Polyhedron& moving, const Polyhedron& fixed) {
    const Motion motion = plain(answer.motion);
    const FirstContact& found = answer.found;
    const view::PosedBodies bodies{[&](double time) {
                                       return std::vector{motion.pose_at(time), motion.fixed_pose_at(time)};
                                   },
                                   {view::box_around(moving), view::box_around(fixed)},
                                   view::cuts_of(motion)};
    std::vector<double> stops{0, 1};
    if (found.verdict != Verdict::clear && found.time.lower > 0 && found.time.lower < 1)
        stops.insert(stops.begin() + 1, found.time.lower);
    std::vector<view::SampledTrack> tracks = view::sampled_tracks(bodies, stops);
    view::SceneRecord record{.source = view::RecordSource::first_contact,
                             .margin = answer.margin,
                             .clear_until = found.clear_until,
                             .times = {0, 1}};
    for (std::size_t i = 0; i < tracks.size(); ++i)
        record.bodies.push_back({"", i == 0 ? moving : fixed, std::move(tracks[i].poses), std::move(tracks[i].times)});
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
