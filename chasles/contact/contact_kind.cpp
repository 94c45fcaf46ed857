#include "chasles/contact/contact.h"

namespace chasles {

FeatureKind moving_feature_kind(ContactKind kind) {
    switch (kind) {
    case ContactKind::vertex_face:
    case ContactKind::vertex_edge:
    case ContactKind::vertex_vertex:
        return FeatureKind::vertex;
    case ContactKind::edge_edge:
    case ContactKind::edge_vertex:
        return FeatureKind::edge;
    case ContactKind::face_vertex:
        break;
    }
    return FeatureKind::face;
}

FeatureKind fixed_feature_kind(ContactKind kind) {
    return moving_feature_kind(swapped(kind));
}

ContactKind swapped(ContactKind kind) {
    switch (kind) {
    case ContactKind::vertex_face:
        return ContactKind::face_vertex;
    case ContactKind::face_vertex:
        return ContactKind::vertex_face;
    case ContactKind::vertex_edge:
        return ContactKind::edge_vertex;
    case ContactKind::edge_vertex:
        return ContactKind::vertex_edge;
    case ContactKind::edge_edge:
    case ContactKind::vertex_vertex:
        break;
    }
    return kind;
}

Contact Contact::swapped() const {
    Contact other = *this;
    other.kind = chasles::swapped(kind);
    other.moving = fixed;
    other.fixed = moving;
    other.point = point + gap * normal;
    other.normal = -normal;
    return other;
}

} // namespace chasles
