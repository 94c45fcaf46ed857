// Answers for people. Digits are those that mean something: all of the bracket around the time, nine of the rest.
#include "cli/report.h"

#include <fmt/format.h>
#include <numbers>

namespace chasles::cli {
namespace {

constexpr std::size_t most_contacts = 10;

double degrees(double radians) {
    return radians / std::numbers::pi * 180;
}

std::string text_of(const Eigen::Vector3d& vector) {
    // Adding zero turns -0 into 0, which is easier on the eye.
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", vector.x() + 0.0, vector.y() + 0.0, vector.z() + 0.0);
}

std::string text_of(const Bracket& bracket) {
    if (bracket.lower == bracket.upper)
        return fmt::format("{}", bracket.lower);
    return fmt::format("{:.16g} to {:.16g}", bracket.lower, bracket.upper);
}

std::string vertex(const Feature& feature) {
    return fmt::format("vertex {}", feature.first);
}
std::string face(const Feature& feature) {
    return fmt::format("face {}", feature.first);
}
std::string edge(const Feature& feature) {
    return fmt::format("edge {}-{}", feature.first, feature.second);
}

std::string pair_of(const Contact& contact) {
    if (contact.kind == ContactKind::edge_edge)
        return edge(contact.moving) + " on " + edge(contact.fixed);
    const bool is_vertex_moving = contact.kind == ContactKind::vertex_face;
    return is_vertex_moving ? vertex(contact.moving) + " on " + face(contact.fixed)
                            : face(contact.moving) + " on " + vertex(contact.fixed);
}

std::string report(const Contact& contact) {
    return labelled("touching", pair_of(contact) + "   (moving on fixed)") +
           labelled("", "at      " + text_of(contact.point)) + labelled("", "normal  " + text_of(contact.normal)) +
           labelled("", fmt::format("closing at {:.6g} per unit of time", contact.approach_speed + 0.0));
}

std::string report(const Overlap& overlap) {
    const std::string edge_owner = overlap.edge_is_moving ? "moving" : "fixed";
    const std::string face_owner = overlap.edge_is_moving ? "fixed" : "moving";
    return labelled("overlap", fmt::format("{} of the {} body passes through {} of the {} body", edge(overlap.edge),
                                           edge_owner, face(overlap.face), face_owner)) +
           labelled("", "at      " + text_of(overlap.point));
}

std::string report(const std::vector<Contact>& contacts) {
    std::string text;
    for (std::size_t i = 0; i < std::min(contacts.size(), most_contacts); ++i)
        text += report(contacts[i]);
    if (contacts.size() > most_contacts)
        text += labelled("", fmt::format("and {} more (--json lists them all)", contacts.size() - most_contacts));
    return text;
}

std::string progress_of(const MotionNumbers& motion, const FirstContact& found) {
    const double travel = motion.is_sweep ? motion.travel : motion.slide;
    return fmt::format("turned {:.9g} of {:.9g} degrees, {} {:.9g} of {:.9g}", degrees(turned_so_far(motion, found)),
                       degrees(motion.angle), motion.is_sweep ? "travelled" : "slid", travel * found.tau.lower + 0.0,
                       travel + 0.0);
}

std::string report_contact(const FirstContact& found, const MotionNumbers& motion) {
    std::string text = labelled("time", text_of(found.time)) + labelled("tau", text_of(found.tau)) +
                       labelled("so far", progress_of(motion, found)) + report(found.contacts);
    if (found.overlap)
        text += report(*found.overlap);
    return text + labelled("certain", found.certain ? "yes" : "no: the bodies may miss each other by a rounding error");
}

std::string report(const MotionNumbers& motion) {
    const std::string lengths = motion.is_sweep ? fmt::format("{:.9g} travelled", motion.travel)
                                                : fmt::format("{:.9g} slid", motion.slide + 0.0);
    return labelled("motion", fmt::format("{:.9g} degrees and {} along {} through {}", degrees(motion.angle), lengths,
                                          text_of(motion.axis_direction), text_of(motion.axis_point)));
}

} // namespace

std::string headline(Verdict verdict) {
    switch (verdict) {
    case Verdict::clear:
        return "CLEAR: proven that nothing touches on the whole way\n";
    case Verdict::contact:
        return "CONTACT\n";
    case Verdict::contact_at_start:
        break;
    }
    return "CONTACT AT THE START\n";
}

std::string labelled(const std::string& label, const std::string& text) {
    return fmt::format("  {:<10}{}\n", label, text);
}

std::string report(const Work& work) {
    return labelled("work", fmt::format("{} box pairs, {} face pairs, {} elementary tests, {} with roots, {} refined",
                                        work.node_pairs, work.face_pairs, work.elementary_tests, work.root_brackets,
                                        work.refined));
}

std::string report(const FirstContact& found, const MotionNumbers& motion) {
    const bool is_contact = found.verdict != Verdict::clear;
    return headline(found.verdict) + (is_contact ? report_contact(found, motion) : "") + report(motion) +
           report(found.work);
}

} // namespace chasles::cli
