// Answers for people. The bracket of the time is printed with all its digits, other numbers with nine,
// and times in sentences as by chasles/base/number_text.h.
#include "cli/report.h"

#include "chasles/base/number_text.h"
#include "chasles/io/text_scan.h"
#include "cli/contact_table.h"
#include "view/names.h"
#include "view/proven_verdict.h"
#include "view/round_surface.h"
#include "view/why_uncertain.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace chasles::cli {
namespace {

double degrees(double radians) {
    return radians / std::numbers::pi * 180;
}

std::string text_of(const Bracket& bracket) {
    if (bracket.lower == bracket.upper)
        return fmt::format("{}", bracket.lower);
    return fmt::format("{:.16g} to {:.16g}", bracket.lower, bracket.upper);
}

/// With a margin the features are apart, and the table shows the gaps.
std::string contact_lines(const std::vector<Contact>& contacts, std::string label, bool shows_gaps) {
    std::string text;
    for (const std::string& line : contact_table(contacts, shows_gaps)) {
        text += labelled(label, line);
        label.clear();
    }
    return text;
}

std::string overlap_line(const Overlap& overlap) {
    const std::string edge_owner = overlap.edge_is_moving ? "moving" : "fixed";
    const std::string face_owner = overlap.edge_is_moving ? "fixed" : "moving";
    return labelled("overlap",
                    fmt::format("{} of the {} body passes through {} of the {} body at {}", edge_name(overlap.edge),
                                edge_owner, face_name(overlap.face), face_owner, vector_text(overlap.point)));
}

std::string inside_line(const Inside& inside) {
    const std::string inner = inside.moving_is_inside ? "moving" : "fixed",
                      outer = inside.moving_is_inside ? "fixed" : "moving";
    return labelled("inside", fmt::format("vertex {} of the {} body is inside of the {} body, at {}",
                                          inside.vertex.first, inner, outer, vector_text(inside.point)));
}

/// Whether its faces may move inwards.
bool can_shrink(const Polyhedron& shape) {
    const MeshReport report = shape.report();
    return shape.radius() == 0 && report.unpaired_edges == 0 && report.segments == 0;
}

/// What contact at the start is more than a touch.
template <typename Found>
std::string more_than_touch(const Found& found) {
    if (found.inside && found.certain)
        return found.inside->moving_is_inside ? ": the moving body is inside of the fixed one"
                                              : ": the fixed body is inside of the moving one";
    return found.overlap && found.overlap->certain ? ": the surfaces pass through each other" : "";
}

std::string motion_line(const view::MotionNumbers& motion) {
    const std::string turn = fmt::format("turns {:.9g} degrees", degrees(motion.angle));
    const std::string direction = vector_text(motion.axis_direction);
    const std::string way =
        view::moves_straight(motion.kind)
            ? fmt::format(" about {}, travels {:.9g} straight on", direction, motion.displacement.norm())
            : fmt::format(" and slides {:.9g}, axis {} through {}", motion.slide + 0.0, direction,
                          vector_text(motion.axis_point));
    const std::string in_world = motion.is_in_world ? ", in the world; the fixed body moves too" : "";
    return labelled(std::string(view::name_of(motion.kind)), turn + way + in_world);
}

std::string text_of(const view::Progress& progress, view::MotionKind kind) {
    return fmt::format("turned {:.9g} degrees, {} {:.9g}", degrees(progress.turned),
                       view::moves_straight(kind) ? "travelled" : "slid", progress.length + 0.0);
}

template <typename Found>
std::string report_certainty(const Found& found, const std::string& why_uncertain) {
    return labelled("certain", found.certain ? "yes" : "no: " + why_uncertain);
}

// `Found` is FirstContact or LeastDistance.
template <typename Found>
std::string report_time(const Found& found, const view::MotionNumbers& motion) {
    const view::Progress progress = view::progress_at(motion, found.time.lower, found.tau.lower);
    return labelled("so far", text_of(progress, motion.kind)) + labelled("time", text_of(found.time)) +
           (view::has_tau(motion.kind) ? labelled("tau", text_of(found.tau)) : "");
}

template <typename Found>
std::string report_features(const Found& found, const std::string& label, bool shows_gaps) {
    std::string text;
    if (!found.contacts.empty())
        text += contact_lines(found.contacts, label, shows_gaps);
    if (found.inside)
        text += inside_line(*found.inside);
    if (found.overlap)
        text += overlap_line(*found.overlap);
    else if (found.contacts_cut)
        text += labelled("", "the list is cut: there are more contacts");
    return text;
}

std::string report_contact_features(const FirstContact& found, double margin, const std::string& why_uncertain) {
    return report_certainty(found, why_uncertain) +
           report_features(found, margin > 0 ? "within" : "touching", margin > 0);
}

std::string report_nearest(const LeastDistance& found, bool time_was_over) {
    const bool is_apart = found.distance.upper > 0;
    return report_certainty(found, std::string(time_was_over ? "the time was over, and " : "") +
                                       "the bracket of the distance is wider than the tolerance") +
           report_features(found, is_apart ? "nearest" : "touching", is_apart);
}

constexpr const char* nothing_proven = "UNKNOWN: the time was over; nothing is proven";

/// Bodies that start within the margin may stay there if they are held.
std::string proven_headline(const std::string& when, double margin, const std::optional<double>& hold) {
    const std::string what =
        hold         ? fmt::format("comes within {:.9g}, or nearer than at the start if that is less,", *hold)
        : margin > 0 ? fmt::format("comes within {:.9g}", margin)
                     : "touches";
    return fmt::format("UNKNOWN: the time was over; proven that nothing {} {}", what, when);
}

double least_gap(const std::vector<Contact>& contacts) {
    double least = std::numeric_limits<double>::infinity();
    for (const Contact& contact : contacts)
        least = std::min(least, contact.gap);
    return least;
}

/// The level of a held contact: bodies that start nearer than the hold distance are held where they start.
std::string level_text(const FirstContact& found) {
    constexpr double rounding = 1e-6; // the level is below the distance of the start by roundings
    const double start = least_gap(found.held);
    return least_gap(found.contacts) < start * (1 - rounding)
               ? " at the hold distance,"
               : fmt::format(" at the distance of the start, {:.9g},", start);
}

std::string verdict_text(const FirstContact& found, double margin, const std::optional<double>& hold) {
    const std::string within = !found.held.empty() ? level_text(found)
                               : margin > 0        ? fmt::format(" within {:.9g}", margin)
                                                   : "";
    switch (found.verdict) {
    case Verdict::clear:
        if (!found.held.empty())
            return "CLEAR: proven that the bodies keep the hold distance, or that of the start if it is less, during "
                   "the whole motion";
        return fmt::format("CLEAR: proven that nothing {} during the whole motion",
                           margin > 0 ? "comes" + within : "touches");
    case Verdict::contact:
        return fmt::format("CONTACT{} at time {}", within, time_text(found.time.lower));
    case Verdict::unknown:
        return unknown_headline(found.clear_until, margin, hold);
    case Verdict::contact_at_start:
        break;
    }
    return fmt::format("CONTACT{} AT THE START{}", within, more_than_touch(found));
}

std::string verdict_text(const LeastDistance& found, bool time_was_over) {
    switch (view::proven_verdict(found)) {
    case Verdict::clear:
        return fmt::format("CLEARANCE {:.9g} at time {}", found.distance.lower, time_text(found.time.lower));
    case Verdict::contact:
        return "TOUCH at time " + time_text(found.time.lower);
    case Verdict::contact_at_start:
        return fmt::format("TOUCH AT THE START{}", more_than_touch(found));
    case Verdict::unknown:
        break;
    }
    return fmt::format("NO CLEARANCE PROVEN: {}at most {:.9g} at time {}", time_was_over ? "the time was over; " : "",
                       found.distance.upper, time_text(found.time.lower));
}

} // namespace

std::string during(double until) {
    if (until == 0)
        return "at the start";
    return until < 1 ? "until time " + time_text(until) : "during the whole motion";
}

std::string unknown_headline(double clear_until, double margin, const std::optional<double>& hold) {
    return clear_until > 0 ? proven_headline("before time " + time_text(clear_until), margin, hold) : nothing_proven;
}

std::string unknown_headline(const ProvenPath& proven, double margin, const std::optional<double>& hold) {
    if (proven.clear_until > proven.stamp.value_or(0))
        return proven_headline(proven.stamp
                                   ? fmt::format("before t = {}, in segment {}", proven.clear_until, proven.segment)
                                   : fmt::format("before time {} of segment {}", proven.clear_until, proven.segment),
                               margin, hold);
    return proven.segment > 0 ? proven_headline(fmt::format("before segment {}", proven.segment), margin, hold)
                              : nothing_proven;
}

ExitStatus status_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::clear:
        return is_clear;
    case Verdict::unknown:
        return is_unknown;
    case Verdict::contact:
    case Verdict::contact_at_start:
        break;
    }
    return is_contact;
}

ExitStatus status_of(const Bracket& least_distance, bool time_was_over) {
    if (least_distance.lower > 0)
        return is_clear;
    return time_was_over && least_distance.upper > 0 ? is_unknown : is_contact;
}

std::string headline(const FirstContact& found, double margin, std::string_view motion,
                     const std::optional<double>& hold) {
    return naming_motion(verdict_text(found, margin, hold), motion);
}

std::string headline(const LeastDistance& found, std::string_view motion, bool time_was_over) {
    return naming_motion(verdict_text(found, time_was_over), motion);
}

std::string naming_motion(const std::string& text, std::string_view motion) {
    return fmt::format("{}; motion: {}\n", io::one_line(text), motion);
}

std::string way_out_line(const FirstContact& found, const QueryOptions& options, const Pair& bodies) {
    const bool passes_through = found.overlap && found.overlap->certain;
    if (found.verdict != Verdict::contact_at_start || found.inside || passes_through)
        return {};
    const bool may_overlap = can_shrink(bodies.moving) || can_shrink(bodies.fixed);
    if (options.hold)
        return labelled(
            "hold",
            fmt::format("needs a gap above 0 at the start; move the bodies apart by a little more than {:.9g}{}",
                        *options.hold, may_overlap ? ", or allow an overlap by a radius below 0" : ""));
    return options.margin > 0 || !may_overlap
               ? ""
               : labelled("way out", "closed bodies that touch by design may have a radius below 0");
}

std::string page_lines(const std::string& page, const std::vector<std::pair<std::string, Polyhedron>>& bodies) {
    std::string text = labelled("page", page);
    for (const auto& [name, shape] : bodies)
        if (const std::string part = view::drawn_in_part(shape); !part.empty())
            text += labelled("drawn", part + " of " + name);
    return text;
}

std::string labelled(const std::string& label, const std::string& text) {
    return fmt::format("  {:<10}{}\n", label, io::one_line(text));
}

std::string shortened(const std::vector<std::string>& names, std::size_t most, std::size_t count) {
    std::string text;
    const std::size_t shown = std::min(names.size(), most);
    for (std::size_t i = 0; i < shown; ++i)
        text += (i > 0 ? ", " : "") + names[i];
    return count > shown ? fmt::format("{}{}{} more", text, shown > 0 ? ", and " : "", count - shown) : text;
}

std::string counted(std::size_t count, const std::string& noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string report(const Work& work) {
    return labelled("work", fmt::format("{}, {}, {}: {} searched for roots, {} refined, {} exact",
                                        counted(work.node_pairs, "box pair"), counted(work.face_pairs, "face pair"),
                                        counted(work.elementary_tests, "elementary test"), work.root_brackets,
                                        work.refined, work.exact));
}

std::string details(const FirstContact& found, const view::MotionNumbers& motion, double margin,
                    const std::string& why_uncertain) {
    std::string text = motion_line(motion);
    if (view::is_contact(found.verdict))
        text += report_time(found, motion) + report_contact_features(found, margin, why_uncertain);
    if (!found.held.empty())
        text += contact_lines(found.held, "held", true) + labelled("clear to", "time " + time_text(found.clear_until));
    return text + report(found.work);
}

std::string report_contact(const FirstContact& found, double margin, const std::string& why_uncertain) {
    return labelled("time", text_of(found.time)) + report_contact_features(found, margin, why_uncertain);
}

std::string report(const FirstContact& found, const view::MotionNumbers& motion, const QueryOptions& options,
                   const Pair& bodies) {
    return headline(found, options.margin, view::name_of(motion.kind), options.hold) +
           details(found, motion, options.margin, view::why_uncertain(found)) + way_out_line(found, options, bodies);
}

std::string report_least(const LeastDistance& found, bool time_was_over) {
    return labelled("distance", text_of(found.distance)) + labelled("time", text_of(found.time)) +
           report_nearest(found, time_was_over);
}

std::string report(const LeastDistance& found, const view::MotionNumbers& motion, bool time_was_over) {
    return headline(found, view::name_of(motion.kind), time_was_over) + motion_line(motion) +
           labelled("distance", text_of(found.distance)) + report_time(found, motion) +
           report_nearest(found, time_was_over) + report(found.work);
}

} // namespace chasles::cli
