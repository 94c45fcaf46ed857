#include "chasles/contact/contact_set.h"

#include "chasles/base/sort.h"
#include "chasles/contact/flat_hull.h"
#include "chasles/contact/near_pair.h"
#include "chasles/contact/normal_cone.h"
#include "chasles/mesh/adjacent_directions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

namespace chasles::contact {

namespace {

/// A feature of one body, with its kind.
struct BodyFeature {
    FeatureKind kind;
    Feature feature;
};

BodyFeature vertex_feature(std::uint32_t vertex) {
    return {FeatureKind::vertex, {vertex, vertex}};
}

/// A vertex may touch any feature; otherwise two edges touch.
FeaturePair pair_of(const BodyFeature& moving, const BodyFeature& fixed) {
    using enum FeatureKind;
    const auto kind = [&] {
        if (moving.kind == vertex)
            return fixed.kind == vertex ? ContactKind::vertex_vertex
                   : fixed.kind == edge ? ContactKind::vertex_edge
                                        : ContactKind::vertex_face;
        if (moving.kind == edge)
            return fixed.kind == vertex ? ContactKind::edge_vertex : ContactKind::edge_edge;
        return ContactKind::face_vertex;
    };
    return {kind(), moving.feature, fixed.feature};
}

/// Whether the faces at an edge are in one plane, up to the slack across each face.
bool is_flat_at(const Body& body, const Edge& edge, double slack) {
    std::vector<Eigen::Vector3d> ways;
    any_direction_from_edge(body, edge, [&](const Eigen::Vector3d& way) {
        ways.push_back(way);
        return false;
    });
    if (ways.size() != 2)
        return false;
    const double sine = ways[0].stableNormalized().cross(ways[1].stableNormalized()).norm();
    return ways[0].dot(ways[1]) < 0 && sine * std::min(ways[0].norm(), ways[1].norm()) <= slack;
}

/// Finds the vertex or edge at a point of a feature, up to the slack; otherwise the feature itself.
class Rims {
public:
    Rims(const Body& body, double slack) : body_(body), slack_(slack) {}

    [[nodiscard]] BodyFeature feature_at(const BodyFeature& given, const Eigen::Vector3d& point) const {
        if (given.kind == FeatureKind::edge)
            return feature_of_edge({given.feature.first, given.feature.second}, point);
        if (given.kind == FeatureKind::vertex)
            return given;
        const auto corners = body_.face(given.feature.first);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto [from, to] = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
            if (is_at({from, to}, point) && !is_flat_at(body_, {from, to}, slack_))
                return feature_of_edge({from, to}, point);
        }
        return given;
    }

private:
    [[nodiscard]] BodyFeature feature_of_edge(const Edge& edge, const Eigen::Vector3d& point) const {
        for (const std::uint32_t end : {edge.from, edge.to})
            if ((body_.vertices()[end] - point).norm() <= slack_)
                return vertex_feature(end);
        return {FeatureKind::edge, {edge.from, edge.to}};
    }
    [[nodiscard]] bool is_at(const Edge& edge, const Eigen::Vector3d& point) const {
        return (foot_on_segment(body_.vertices()[edge.from], body_.vertices()[edge.to], point) - point).norm() <=
               slack_;
    }

    const Body& body_;
    double slack_;
};

/// Collects feature pairs under their proper names.
class Namer {
public:
    explicit Namer(const ContactScene& scene) : scene_(scene) {}

    void add(const FeaturePair& features) {
        if (features.kind == ContactKind::edge_edge && are_parallel(features.moving, features.fixed))
            add_ends(features);
        else
            add_at(features, scene_.bodies.nearest(features));
    }

    void keep(const FeaturePair& features) { named_.push_back(features); }

    std::vector<FeaturePair> take() {
        sort_unique(named_);
        return std::move(named_);
    }

private:
    void add_at(const FeaturePair& features, const NearestPoints& at) {
        named_.push_back(features_at(scene_, features, at));
    }

    /// Whether the edges stay within the slack of each other over the length of the shorter edge.
    [[nodiscard]] bool are_parallel(const Feature& moving, const Feature& fixed) const {
        const Eigen::Vector3d u = scene_.bodies.turned(along(scene_.bodies.moving(), moving));
        const Eigen::Vector3d v = along(scene_.bodies.fixed(), fixed);
        return u.cross(v).norm() <= scene_.slack * std::max(u.norm(), v.norm());
    }

    /// Adds the ends of either edge that lie on the other edge.
    void add_ends(const FeaturePair& edges) {
        const auto add_end = [&](const FeaturePair& features) {
            const NearestPoints at = scene_.bodies.nearest(features);
            if (at.apart().norm() <= scene_.slack)
                add_at(features, at);
        };
        for (const std::uint32_t end : {edges.moving.first, edges.moving.second})
            add_end({ContactKind::vertex_edge, {end, end}, edges.fixed});
        for (const std::uint32_t end : {edges.fixed.first, edges.fixed.second})
            add_end({ContactKind::edge_vertex, edges.moving, {end, end}});
    }

    static Eigen::Vector3d along(const Body& body, const Feature& edge) {
        return body.vertices()[edge.second] - body.vertices()[edge.first];
    }

    const ContactScene& scene_;
    std::vector<FeaturePair> named_;
};

/// Features at a distance are named by their nearest points already. A pair whose surfaces come nearer beside these
/// points is no local minimum, and no contact.
std::vector<FeaturePair> named(const ContactScene& scene, const std::vector<FeaturePair>& candidates) {
    Namer namer(scene);
    for (const FeaturePair& candidate : candidates) {
        const NearestPoints nearest = scene.bodies.nearest(candidate);
        const double distance = nearest.apart().norm();
        if (scene.margin <= 0 || distance <= scene.slack)
            namer.add(candidate);
        else if (is_local_minimum(scene, candidate, nearest))
            namer.keep(candidate);
    }
    return namer.take();
}

/// Whether a contact is of a vertex or edge with a vertex or edge, not with a face.
bool is_at_rims(ContactKind kind) {
    return moving_feature_kind(kind) != FeatureKind::face && fixed_feature_kind(kind) != FeatureKind::face;
}

} // namespace

FeaturePair features_at(const ContactScene& scene, const FeaturePair& features, const NearestPoints& points) {
    const RelativeConfiguration& bodies = scene.bodies;
    const Rims moving(bodies.moving(), scene.slack), fixed(bodies.fixed(), scene.slack);
    return pair_of(
        moving.feature_at({moving_feature_kind(features.kind), features.moving}, bodies.moved_back(points.on_moving)),
        fixed.feature_at({fixed_feature_kind(features.kind), features.fixed}, points.on_fixed));
}

std::vector<Contact> contact_set(const ContactScene& scene, const std::vector<FeaturePair>& candidates) {
    std::vector<Contact> contacts;
    for (const FeaturePair& features : named(scene, candidates))
        contacts.push_back(described(scene, features));
    if (contacts.empty()) // an uncertain distance, which need not be a local minimum
        contacts.push_back(described(scene, candidates.front()));
    return at_corners_of_hulls(std::move(contacts), scene.slack);
}

Contact named_contact(const ContactScene& scene, const FeaturePair& features) {
    Contact contact = described(scene, features);
    if (scene.margin > 0 && contact.gap > scene.slack)
        return contact;
    Namer namer(scene);
    namer.add(features);
    for (const FeaturePair& name : namer.take()) {
        if (name == features || !is_at_rims(name.kind))
            continue;
        const Contact other = described(scene, name);
        const bool separated = separates(contact.normal, scene.bodies, name);
        const bool separates_too = separates(other.normal, scene.bodies, name);
        const bool closes_instead = is_closing(scene, other) && !is_closing(scene, contact);
        if (separates_too == separated ? closes_instead : separates_too)
            contact = other;
    }
    return contact;
}

bool is_closing(const ContactScene& scene, const Contact& contact) {
    return contact.approach_speed > no_direction * scene.bodies.velocity_at(contact.point).norm();
}

} // namespace chasles::contact
