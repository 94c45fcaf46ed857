// Answers for people: the verdict first, then the motion, the time and the contacts.
#pragma once

#include "cli/commands.h"
#include "view/motion_numbers.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::cli {

/// The bodies of a question.
struct Pair {
    Polyhedron moving;
    Polyhedron fixed;
};

/// The answer of `check` as a short text of several lines. With a margin the report shows the gaps.
std::string report(const FirstContact& found, const view::MotionNumbers& motion, const QueryOptions& options,
                   const Pair& bodies);

/// The lines about the contact: time, certainty and features. `why_uncertain` is that of view/why_uncertain.h: the
/// times of `found` may be stamps, which do not tell it.
std::string report_contact(const FirstContact& found, double margin, const std::string& why_uncertain);

/// The lines about the least distance: distance, time, certainty and features. `time_was_over` here and below: before
/// the bracket was as narrow as asked.
std::string report_least(const LeastDistance& found, bool time_was_over);

/// The answer of `clearance` in the same form. The first line has the proven lower end of the distance.
std::string report(const LeastDistance& found, const view::MotionNumbers& motion, bool time_was_over);

/// The two parts of report(): the verdict and the motion in one line, and the details.
std::string headline(const FirstContact& found, double margin, std::string_view motion,
                     const std::optional<double>& hold = {});
std::string headline(const LeastDistance& found, std::string_view motion, bool time_was_over);
std::string details(const FirstContact& found, const view::MotionNumbers& motion, double margin,
                    const std::string& why_uncertain);

/// The line after a contact at the start of bodies that touch: how to let them. Empty for other answers, and where
/// neither body can have a radius below 0: one without faces, an open one, or one with a radius.
std::string way_out_line(const FirstContact& found, const QueryOptions& options, const Pair& bodies);

/// The line that names the page of these bodies, and what is not drawn on it.
std::string page_lines(const std::string& page, const std::vector<std::pair<std::string, Polyhedron>>& bodies);

/// The names and shapes of bodies of a scene or a record.
template <typename Bodies>
std::vector<std::pair<std::string, Polyhedron>> shapes_of(const Bodies& bodies) {
    std::vector<std::pair<std::string, Polyhedron>> shapes;
    for (const auto& body : bodies)
        shapes.emplace_back(body.name, body.shape);
    return shapes;
}

/// One line "  label     text". All lines are aligned.
std::string labelled(const std::string& label, const std::string& text);

/// `text` and the motion that it is about, in one line: "TEXT; motion: MOTION".
std::string naming_motion(const std::string& text, std::string_view motion);

/// The times that an answer is about: "during the whole motion", "until time 0.5" or "at the start".
std::string during(double until);

/// "UNKNOWN: the time was over; ...", where a question about the margin has proven this much.
std::string unknown_headline(double clear_until, double margin, const std::optional<double>& hold = {});

/// What is proven of a path at the limit: all segments before this one, and the start of this one.
struct ProvenPath {
    std::size_t segment;
    double clear_until;          ///< within the segment, or a stamp
    std::optional<double> stamp; ///< of the start of the segment, if times count in stamps
};
std::string unknown_headline(const ProvenPath& proven, double margin, const std::optional<double>& hold);

/// The exit status for an answer.
ExitStatus status_of(Verdict verdict);
ExitStatus status_of(const Bracket& least_distance, bool time_was_over);

/// The line of work counters.
std::string report(const Work& work);

/// "a, b, and 4 more": of `count` names at most so many of those that are given.
std::string shortened(const std::vector<std::string>& names, std::size_t most, std::size_t count);

/// "1 segment", "2 segments".
std::string counted(std::size_t count, const std::string& noun);

} // namespace chasles::cli
