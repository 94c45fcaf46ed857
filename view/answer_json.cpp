// Answers as JSON. docs/command-line.md describes the keys.
#include "view/answer_json.h"

#include "view/names.h"
#include "view/proven_verdict.h"

namespace chasles::view {
namespace {

// A vertex is a number, a face a list of one number, an edge a list of its two vertices.
Json vertex(const Feature& feature) {
    return feature.first;
}
Json face(const Feature& feature) {
    return Json::array({feature.first});
}
Json edge(const Feature& feature) {
    return Json::array({feature.first, feature.second});
}

Json json_of(FeatureKind kind, const Feature& feature) {
    switch (kind) {
    case FeatureKind::vertex:
        return vertex(feature);
    case FeatureKind::edge:
        return edge(feature);
    case FeatureKind::face:
        break;
    }
    return face(feature);
}

Json json_of(const std::vector<Contact>& contacts) {
    Json list = Json::array();
    for (const Contact& contact : contacts)
        list.push_back(contact_json(contact));
    return list;
}

Json json_of(const MotionNumbers& motion) {
    Json json = {{"kind", name_of(motion.kind)},
                 {"angle", motion.angle},
                 {"slide", motion.slide},
                 {"axis_point", vector_json(motion.axis_point)},
                 {"axis_direction", vector_json(motion.axis_direction)}};
    if (motion.kind == MotionKind::velocity)
        json["displacement"] = vector_json(motion.displacement);
    return json;
}

Json json_of(const Work& work) {
    return {{"node_pairs", work.node_pairs},
            {"face_pairs", work.face_pairs},
            {"elementary_tests", work.elementary_tests},
            {"root_brackets", work.root_brackets},
            {"refined", work.refined},
            {"exact", work.exact}};
}

/// The contacts, what bodies have in common at the start beside them, and whether their list is cut.
template <typename Found>
void add_contacts(Json& answer, const Found& found) {
    answer["contacts"] = json_of(found.contacts);
    if (found.overlap)
        answer["overlap"] = overlap_json(*found.overlap);
    if (found.inside)
        add_inside(answer, *found.inside);
    if (found.contacts_cut)
        answer["contacts_cut"] = true;
}

/// The keys from time to contacts_cut, which both kinds of answers have.
template <typename Found>
void add_found(Json& answer, const Found& found, MotionKind kind) {
    answer["time"] = found.time.lower;
    answer["time_upper"] = found.time.upper;
    if (has_tau(kind)) {
        answer["tau"] = found.tau.lower;
        answer["tau_upper"] = found.tau.upper;
    }
    answer["certain"] = found.certain;
    answer["pose"] = pose_json(found.pose);
    add_contacts(answer, found);
}

Json reason_json(const UntestedPairs& untested, UntestedReason reason) {
    Json json{{"reason", name_of(reason)}, {"count", untested.count(reason)}};
    if (reason == UntestedReason::no_shapes) {
        json["links"] = untested.without_shapes;
        return json;
    }
    json["pairs"] = Json::array();
    for (const UntestedPair& pair : untested.named)
        if (pair.reason == reason)
            json["pairs"].push_back(Json{pair.first, pair.second});
    return json;
}

} // namespace

Json untested_json(const UntestedPairs& untested) {
    Json reasons = Json::array();
    for (std::size_t i = 0; i < UntestedPairs::reasons; ++i)
        if (untested.counts[i] > 0)
            reasons.push_back(reason_json(untested, UntestedReason(i)));
    return {{"tested", untested.tested}, {"pairs", untested.total()}, {"reasons", std::move(reasons)}};
}

Json scene_answer_json(const chasles::Scene& scene, const SceneAnswer& found, bool all) {
    const auto pair = [&](const SceneContact& contact) {
        return Json{scene.bodies()[contact.moving].name, scene.bodies()[contact.fixed].name};
    };
    Json answer;
    if (all) {
        if (found.verdict == Verdict::unknown) {
            answer["verdict"] = name_of(found.verdict);
            answer["clear_until"] = found.clear_until;
        }
        answer["events"] = Json::array();
        for (const SceneContact& event : found.contacts) {
            Json json{{"time", event.contact.time.lower},
                      {"time_upper", event.contact.time.upper},
                      {"certain", event.contact.certain},
                      {"pair", pair(event)}};
            add_contacts(json, event.contact);
            answer["events"].push_back(std::move(json));
        }
        answer["untested"] = untested_json(found.untested);
        answer["work"] = json_of(found.work);
        return answer;
    }
    answer["verdict"] = name_of(found.verdict);
    answer["clear_until"] = found.clear_until;
    if (!found.contacts.empty()) {
        const SceneContact& first = found.contacts.front();
        answer["pair"] = pair(first);
        add_found(answer, first.contact, MotionKind::velocity); // which has no tau
        for (std::size_t i = 1; i < found.contacts.size(); ++i)
            answer["simultaneous"].push_back(pair(found.contacts[i]));
    }
    answer["untested"] = untested_json(found.untested);
    answer["work"] = json_of(found.work);
    return answer;
}

Json scene_distance_json(const chasles::Scene& scene, const SceneDistance& found) {
    Json answer{{"distance", found.nearest.distance.lower}, {"distance_upper", found.nearest.distance.upper}};
    if (found.pair) {
        answer["pair"] = Json{scene.bodies()[found.pair->first].name, scene.bodies()[found.pair->second].name};
        add_found(answer, found.nearest, MotionKind::velocity); // which has no tau
    } else {
        for (const char* const key : {"pair", "time", "time_upper"})
            answer[key] = nullptr;
        answer["certain"] = found.nearest.certain;
        answer["pose"] = nullptr;
        answer["contacts"] = Json::array();
    }
    answer["untested"] = untested_json(found.untested);
    answer["work"] = json_of(found.nearest.work);
    return answer;
}

Json distance_matrix_json(const chasles::Scene& scene, const DistanceMatrix& found) {
    Json pairs = Json::array();
    Work work;
    for (const auto& [moving, fixed, nearest] : found.pairs) {
        Json pair{{"pair", {scene.bodies()[moving].name, scene.bodies()[fixed].name}},
                  {"distance", nearest.distance.lower},
                  {"distance_upper", nearest.distance.upper}};
        add_found(pair, nearest, MotionKind::velocity); // which has no tau
        pair["work"] = json_of(nearest.work);
        pairs.push_back(std::move(pair));
        work += nearest.work;
    }
    return {{"pairs", std::move(pairs)}, {"untested", untested_json(found.untested)}, {"work", json_of(work)}};
}

Json configuration_json(const chasles::Robot& robot, const Configuration& configuration) {
    Json values = Json::object();
    for (std::size_t i = 0; i < robot.variables().size(); ++i)
        values[robot.variables()[i].name] = configuration[Eigen::Index(i)];
    return values;
}

Json robot_answer_json(const chasles::Robot& robot, const RobotAnswer& found, bool in_stamps) {
    Json answer;
    answer["verdict"] = name_of(found.verdict);
    answer["segment"] = found.segment;
    if (found.pair) {
        const Bracket& time = in_stamps ? found.time : found.contact.time;
        answer["time"] = time.lower;
        answer["time_upper"] = time.upper;
        answer["certain"] = found.certain;
        answer["pair"] = Json{found.pair->first, found.pair->second};
        add_contacts(answer, found.contact);
        if (!found.contact.held.empty())
            answer["held"] = json_of(found.contact.held);
    }
    answer["configuration"] = configuration_json(robot, found.configuration);
    answer["clear_until"] = in_stamps                         ? found.clear_until
                            : found.verdict == Verdict::clear ? 1.0
                                                              : found.contact.clear_until;
    answer["untested"] = untested_json(*found.untested);
    answer["work"] = json_of(found.work);
    return answer;
}

Json robot_clearance_json(const chasles::Robot& robot, const RobotClearance& found, bool in_stamps) {
    Json answer;
    answer["distance"] = found.distance.lower;
    answer["distance_upper"] = found.distance.upper;
    if (!found.pair) {
        for (const char* const key : {"time", "time_upper"})
            answer[key] = nullptr;
        answer["certain"] = found.certain;
        for (const char* const key : {"pair", "segment"})
            answer[key] = nullptr;
        answer["contacts"] = Json::array();
        answer["configuration"] = nullptr;
    } else {
        const Bracket& time = in_stamps ? found.time : found.nearest.time;
        answer["time"] = time.lower;
        answer["time_upper"] = time.upper;
        answer["certain"] = found.certain;
        answer["pair"] = Json{found.pair->first, found.pair->second};
        answer["segment"] = found.segment;
        add_contacts(answer, found.nearest);
        answer["configuration"] = configuration_json(robot, found.configuration);
    }
    answer["untested"] = untested_json(*found.untested);
    answer["work"] = json_of(found.work);
    return answer;
}

Json pair_proofs_json(const chasles::Robot& robot, const std::vector<PairProof>& proofs) {
    Json pairs = Json::array();
    for (const PairProof& proof : proofs) {
        Json pair{{"links", {proof.first, proof.second}}, {"reason", name_of(proof.reason)}};
        if (proof.witness)
            pair["witness"] = configuration_json(robot, *proof.witness);
        if (proof.reason == PairReason::open && proof.tried > 0) {
            pair["tried"] = proof.tried;
            pair["touching"] = proof.touching;
        }
        pairs.push_back(std::move(pair));
    }
    return {{"pairs", std::move(pairs)}};
}

Json contact_json(const Contact& contact) {
    return {{"kind", name_of(contact.kind)},
            {"moving_feature", json_of(moving_feature_kind(contact.kind), contact.moving)},
            {"fixed_feature", json_of(fixed_feature_kind(contact.kind), contact.fixed)},
            {"point", vector_json(contact.point)},
            {"normal", vector_json(contact.normal)},
            {"gap", contact.gap},
            {"approach_speed", contact.approach_speed}};
}

Json overlap_json(const Overlap& overlap) {
    return {{"moving_feature", overlap.edge_is_moving ? edge(overlap.edge) : face(overlap.face)},
            {"fixed_feature", overlap.edge_is_moving ? face(overlap.face) : edge(overlap.edge)},
            {"point", vector_json(overlap.point)}};
}

void add_inside(Json& answer, const Inside& inside) {
    answer["inside"] = inside.moving_is_inside ? "moving" : "fixed";
    answer["inside_vertex"] = inside.vertex.first;
    answer["inside_point"] = vector_json(inside.point);
}

Json vector_json(const Eigen::Vector3d& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

Json pose_json(const Pose& pose) {
    const Eigen::Quaterniond rotation = pose.rotation.normalized();
    return {pose.translation.x(), pose.translation.y(), pose.translation.z(), rotation.w(),
            rotation.x(),         rotation.y(),         rotation.z()};
}

Json answer_json(const FirstContact& found, const MotionNumbers& motion) {
    Json answer;
    answer["verdict"] = name_of(found.verdict);
    if (is_contact(found.verdict))
        add_found(answer, found, motion.kind);
    else if (found.contacts_cut) // the list of held contacts
        answer["contacts_cut"] = true;
    if (!found.held.empty())
        answer["held"] = json_of(found.held);
    answer["clear_until"] = found.clear_until;
    answer["motion"] = json_of(motion);
    answer["work"] = json_of(found.work);
    return answer;
}

Json answer_json(const LeastDistance& found, const MotionNumbers& motion) {
    Json answer;
    answer["distance"] = found.distance.lower;
    answer["distance_upper"] = found.distance.upper;
    add_found(answer, found, motion.kind);
    answer["motion"] = json_of(motion);
    answer["work"] = json_of(found.work);
    return answer;
}

} // namespace chasles::view
