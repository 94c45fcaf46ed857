#include "chasles/query/first_contact.h"

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
    switch (kind) {
    case ContactKind::face_vertex:
    case ContactKind::edge_vertex:
    case ContactKind::vertex_vertex:
        return FeatureKind::vertex;
    case ContactKind::edge_edge:
    case ContactKind::vertex_edge:
        return FeatureKind::edge;
    case ContactKind::vertex_face:
        break;
    }
    return FeatureKind::face;
}

} // namespace chasles
