// Contacts are decimal text that reads back to the same doubles. Meshes, times and poses are base64.
#include "view/record_json.h"

#include "view/answer_json.h"
#include "view/names.h"
#include "view/page_data.h"

#include <algorithm>
#include <map>

namespace chasles::view {
namespace {

constexpr int record_format = 2;

/// Each shape once, in the order of the first bodies that have it.
class Meshes {
public:
    std::size_t index_of(const Polyhedron& shape) {
        const auto [found, is_new] = index_.try_emplace(shape.vertices().data(), list.size());
        if (is_new)
            list.push_back(mesh_json(shape));
        return found->second;
    }
    Json list = Json::array();

private:
    std::map<const void*, std::size_t> index_;
};

Json body_json(const RecordedBody& body, Meshes& meshes) {
    Json json = {{"name", body.name}, {"mesh", meshes.index_of(body.shape)}, {"poses", packed(body.poses)}};
    if (!body.times.empty())
        json["times"] = packed(body.times);
    return json;
}

Json point_json(const Contact& contact, bool has_features) {
    if (has_features)
        return contact_json(contact);
    return {{"point", vector_json(contact.point)}, {"normal", vector_json(contact.normal)}, {"gap", contact.gap}};
}

Json event_json(const RecordedContact& event) {
    Json json = {{"time", event.time},
                 {"time_upper", event.time_upper},
                 {"certain", event.certain},
                 {"pair", {event.moving, event.fixed}},
                 {"contacts", Json::array()}};
    for (const Contact& contact : event.contacts)
        json["contacts"].push_back(point_json(contact, event.has_features));
    if (!event.kind.empty())
        json["kind"] = event.kind;
    if (event.overlap)
        json["overlap"] = overlap_json(*event.overlap);
    if (event.inside)
        add_inside(json, *event.inside);
    if (event.contacts_cut)
        json["contacts_cut"] = true;
    return json;
}

/// A pair as an event of the list, with the bracket of its distance.
Json matrix_json(const DistanceMatrix& matrix) {
    Json pairs = Json::array();
    for (const auto& [moving, fixed, nearest] : matrix.pairs) {
        const bool touches = nearest.distance.upper == 0; // then the list has them
        Json pair = event_json({.time = nearest.time.lower,
                                .time_upper = nearest.time.upper,
                                .certain = nearest.certain,
                                .moving = moving,
                                .fixed = fixed,
                                .contacts = touches ? std::vector<Contact>() : nearest.contacts,
                                .contacts_cut = nearest.contacts_cut});
        pair["distance"] = nearest.distance.lower;
        pair["distance_upper"] = nearest.distance.upper;
        pairs.push_back(std::move(pair));
    }
    return pairs;
}

std::vector<const RecordedContact*> in_order_of_time(const std::vector<RecordedContact>& contacts) {
    std::vector<const RecordedContact*> ordered;
    ordered.reserve(contacts.size());
    for (const RecordedContact& contact : contacts)
        ordered.push_back(&contact);
    std::ranges::stable_sort(ordered, {}, [](const RecordedContact* contact) { return contact->time; });
    return ordered;
}

} // namespace

std::string record_json(const SceneRecord& record) {
    require_valid(record);
    Meshes meshes;
    Json bodies = Json::array();
    for (const RecordedBody& body : record.bodies)
        bodies.push_back(body_json(body, meshes));
    Json events = Json::array();
    for (const RecordedContact* event : in_order_of_time(record.contacts))
        events.push_back(event_json(*event));
    Json json = {{"format", record_format},     {"title", record.title},         {"source", name_of(record.source)},
                 {"margin", record.margin},     {"times", packed(record.times)}, {"meshes", std::move(meshes.list)},
                 {"bodies", std::move(bodies)}, {"events", std::move(events)}};
    if (record.clear_until)
        json["clear_until"] = *record.clear_until;
    if (record.until < 1)
        json["until"] = record.until;
    if (record.untested)
        json["untested"] = untested_json(*record.untested);
    if (record.curve)
        json["curve"] = curve_json(*record.curve);
    if (record.matrix)
        json["matrix"] = matrix_json(*record.matrix);
    return page_text(json);
}

} // namespace chasles::view
