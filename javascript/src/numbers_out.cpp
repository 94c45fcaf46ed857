// One after another; a list stands behind the number of its members.
#include "javascript/src/numbers_out.h"

#include <initializer_list>

namespace chasles::javascript {

// Static instead of in a namespace of their own, which would hide the functions of the same name in the header.
static void add(Numbers& out, std::initializer_list<double> numbers) {
    out.insert(out.end(), numbers);
}

static void write(Numbers& out, const Bracket& bracket) {
    add(out, {bracket.lower, bracket.upper});
}

static void write(Numbers& out, const Feature& feature) {
    add(out, {double(feature.first), double(feature.second)});
}

static void write(Numbers& out, const std::optional<Overlap>& overlap) {
    out.push_back(overlap ? 1 : 0);
    if (!overlap)
        return;
    out.push_back(overlap->edge_is_moving ? 1 : 0);
    write(out, overlap->edge);
    write(out, overlap->face);
    write(out, overlap->point);
}

static void write(Numbers& out, const std::optional<Inside>& inside) {
    out.push_back(inside ? 1 : 0);
    if (!inside)
        return;
    add(out, {inside->moving_is_inside ? 1.0 : 0.0, double(inside->vertex.first)});
    write(out, inside->point);
}

/// What both kinds of answers have.
template <typename Found>
static void write_contacts(Numbers& out, const Found& found) {
    write(out, found.time);
    write(out, found.tau);
    add(out, {found.certain ? 1.0 : 0.0, found.contacts_cut ? 1.0 : 0.0});
    write(out, found.pose);
    write(out, found.fixed_pose);
    write(out, found.contacts);
    write(out, found.overlap);
    write(out, found.inside);
    write(out, found.work);
}

void write(Numbers& out, const Eigen::Vector3d& vector) {
    add(out, {vector.x(), vector.y(), vector.z()});
}

void write(Numbers& out, const Pose& pose) {
    const Eigen::Quaterniond rotation = pose.rotation.normalized(); // as in the answers of the command line
    write(out, pose.translation);
    add(out, {rotation.w(), rotation.x(), rotation.y(), rotation.z()});
}

void write(Numbers& out, const Contact& contact) {
    out.push_back(double(contact.kind));
    write(out, contact.moving);
    write(out, contact.fixed);
    write(out, contact.point);
    write(out, contact.normal);
    add(out, {contact.gap, contact.approach_speed});
}

void write(Numbers& out, const std::vector<Contact>& contacts) {
    out.push_back(double(contacts.size()));
    for (const Contact& contact : contacts)
        write(out, contact);
}

void write(Numbers& out, const Work& work) {
    add(out, {double(work.node_pairs), double(work.face_pairs), double(work.elementary_tests),
              double(work.root_brackets), double(work.refined), double(work.exact)});
}

void write(Numbers& out, const view::MotionNumbers& motion) {
    add(out, {double(motion.kind), motion.angle, motion.slide});
    write(out, motion.axis_point);
    write(out, motion.axis_direction);
    write(out, motion.displacement);
}

void write(Numbers& out, const FirstContact& found) {
    out.push_back(double(found.verdict));
    write_contacts(out, found);
    write(out, found.held);
    out.push_back(found.clear_until);
}

void write(Numbers& out, const LeastDistance& found) {
    write(out, found.distance);
    write_contacts(out, found);
}

static void write(Numbers& out, const std::vector<Bracket>& intervals) {
    out.push_back(double(intervals.size()));
    for (const Bracket& interval : intervals)
        write(out, interval);
}

void write(Numbers& out, const DistanceProfile& found, const std::vector<double>& margins) {
    for (const auto* numbers : {&found.times, &found.lower, &found.upper}) {
        out.push_back(double(numbers->size()));
        out.insert(out.end(), numbers->begin(), numbers->end());
    }
    out.push_back(found.certain ? 1 : 0);
    out.push_back(double(margins.size()));
    for (const double margin : margins) {
        const Zones zones = found.zones(margin);
        out.push_back(margin);
        write(out, zones.inside);
        write(out, zones.doubt);
    }
    write(out, found.free());
    out.push_back(double(found.nearest.size()));
    out.insert(out.end(), found.nearest.begin(), found.nearest.end());
    write(out, found.work);
}

} // namespace chasles::javascript
