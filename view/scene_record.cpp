#include "view/scene_record.h"

#include "view/proven_verdict.h"
#include "view/sampled_track.h"

#include <algorithm>
#include <cmath>

namespace chasles::view {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& why) {
    throw InvalidInput("record: " + where + ": " + why);
}

std::string entry(const std::string& list, std::size_t index) {
    return list + "[" + std::to_string(index) + "]";
}

void require_ascending(const std::vector<double>& times, const std::string& name) {
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(times[i]))
            refuse(entry(name, i), "must be a finite number");
        if (i > 0 && !(times[i] > times[i - 1]))
            refuse(entry(name, i), "must be after the time before it");
    }
}

void require_valid_body(const SceneRecord& record, std::size_t index) {
    const RecordedBody& body = record.bodies[index];
    const std::string where = entry("bodies", index);
    require_ascending(body.times, where + ": times");
    const std::size_t count = body.times.empty() ? record.times.size() : body.times.size();
    if (body.poses.size() != count && body.poses.size() != 1)
        refuse(where, std::to_string(body.poses.size()) + " poses for " + std::to_string(count) + " times");
    for (const PoseRow& pose : body.poses)
        if (!std::ranges::all_of(pose, [](double number) { return std::isfinite(number); }))
            refuse(where, "a pose has a number that is not finite");
}

void require_valid_points(const RecordedContact& contact, const std::string& where) {
    for (const Contact& at : contact.contacts)
        if (!at.point.allFinite() || !at.normal.allFinite() || !std::isfinite(at.gap))
            refuse(where, "points, normals and gaps must be finite numbers");
}

void require_valid_contact(const SceneRecord& record, std::size_t index) {
    const RecordedContact& contact = record.contacts[index];
    const std::string where = entry("contacts", index);
    for (const std::size_t body : {contact.moving, contact.fixed})
        if (body >= record.bodies.size())
            refuse(where, "there is no body " + std::to_string(body) + ", only " +
                              std::to_string(record.bodies.size()) + " from 0");
    if (contact.moving == contact.fixed)
        refuse(where, "a body does not touch itself");
    if (!(contact.time >= record.times.front() && contact.time <= record.times.back()))
        refuse(where, "the time must be within the times of the record");
    if (!(contact.time_upper >= contact.time) || !std::isfinite(contact.time_upper))
        refuse(where, "the bracket must not end before it begins");
    require_valid_points(contact, where);
}

/// The times in (0, 1) at which each body is in contact.
std::vector<std::vector<double>> contact_times(const chasles::Scene& scene, const SceneAnswer& found) {
    std::vector<std::vector<double>> times(scene.bodies().size());
    for (const SceneContact& contact : found.contacts)
        for (const std::size_t body : {contact.moving, contact.fixed})
            times[body].push_back(contact.contact.time.lower);
    return times;
}

RecordedBody recorded_body(const SceneBody& body, const std::vector<double>& exact_times) {
    SampledTrack track = sampled_track(body.motion, box_around(body.shape), exact_times);
    if (track.times == std::vector<double>{0, 1})
        track.times.clear(); // those of the record
    return {body.name, body.shape, std::move(track.poses), std::move(track.times)};
}

RecordedContact recorded_contact(const SceneContact& event) {
    const FirstContact& found = event.contact;
    return {.time = found.time.lower,
            .time_upper = found.time.upper,
            .certain = found.certain,
            .moving = event.moving,
            .fixed = event.fixed,
            .contacts = found.contacts,
            .contacts_cut = found.contacts_cut,
            .overlap = found.overlap,
            .inside = found.inside};
}

} // namespace

SceneRecord scene_record(const chasles::Scene& scene, const SceneAnswer& found, RecordSource source) {
    require_answer(found.verdict);
    SceneRecord record{.source = source, .clear_until = found.clear_until, .times = {0, 1}};
    const std::vector<std::vector<double>> times = contact_times(scene, found);
    for (std::size_t i = 0; i < times.size(); ++i)
        record.bodies.push_back(recorded_body(scene.bodies()[i], times[i]));
    for (const SceneContact& event : found.contacts)
        record.contacts.push_back(recorded_contact(event));
    record.untested = found.untested;
    return record;
}

SceneRecord scene_record(const chasles::Scene& scene, const DistanceMatrix& found) {
    SceneAnswer touches;
    touches.verdict = Verdict::clear; // of an answer
    touches.untested = found.untested;
    for (const auto& [moving, fixed, nearest] : found.pairs) {
        if (nearest.distance.upper > 0)
            continue;
        FirstContact contact;
        contact.time = nearest.time;
        contact.certain = nearest.certain;
        contact.contacts = nearest.contacts;
        contact.contacts_cut = nearest.contacts_cut;
        contact.overlap = nearest.overlap;
        contact.inside = nearest.inside;
        touches.contacts.push_back({moving, fixed, std::move(contact)});
    }
    SceneRecord record = scene_record(scene, touches, RecordSource::all_contacts);
    record.clear_until.reset(); // pairs may be open
    record.matrix = found;
    return record;
}

void require_valid(const SceneRecord& record) {
    if (record.times.empty())
        refuse("times", "there are none");
    require_ascending(record.times, "times");
    for (std::size_t i = 0; i < record.bodies.size(); ++i)
        require_valid_body(record, i);
    for (std::size_t i = 0; i < record.contacts.size(); ++i)
        require_valid_contact(record, i);
}

} // namespace chasles::view
