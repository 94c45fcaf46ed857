#include "view/names.h"

namespace chasles::view {

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::unknown:
        return "unknown";
    case Verdict::clear:
        return "clear";
    case Verdict::contact:
        return "contact";
    case Verdict::contact_at_start:
        break;
    }
    return "contact_at_start";
}

std::string_view name_of(ContactKind kind) {
    switch (kind) {
    case ContactKind::vertex_face:
        return "vertex_face";
    case ContactKind::face_vertex:
        return "face_vertex";
    case ContactKind::vertex_edge:
        return "vertex_edge";
    case ContactKind::edge_vertex:
        return "edge_vertex";
    case ContactKind::vertex_vertex:
        return "vertex_vertex";
    case ContactKind::edge_edge:
        break;
    }
    return "edge_edge";
}

std::string_view name_of(MotionKind kind) {
    switch (kind) {
    case MotionKind::screw:
        return "screw";
    case MotionKind::sweep:
        return "sweep";
    case MotionKind::velocity:
        return "velocity";
    case MotionKind::twist:
        break;
    }
    return "twist";
}

std::string_view name_of(RecordSource source) {
    switch (source) {
    case RecordSource::first_contact:
        return "first_contact";
    case RecordSource::all_contacts:
        return "all_contacts";
    case RecordSource::recording:
        break;
    }
    return "recording";
}

std::string_view name_of(PairReason reason) {
    switch (reason) {
    case PairReason::never:
        return "never";
    case PairReason::always:
        return "always";
    case PairReason::adjacent:
        return "adjacent";
    case PairReason::sometimes:
        return "sometimes";
    case PairReason::open:
        break;
    }
    return "open";
}

std::string_view name_of(RangeVerdict verdict) {
    switch (verdict) {
    case RangeVerdict::clear:
        return "clear";
    case RangeVerdict::contact:
        return "contact";
    case RangeVerdict::open:
        break;
    }
    return "open";
}

std::string_view name_of(UntestedReason reason) {
    switch (reason) {
    case UntestedReason::no_shapes:
        return "no_shapes";
    case UntestedReason::at_rest:
        return "at_rest";
    case UntestedReason::adjacent:
        return "adjacent";
    case UntestedReason::disabled:
        return "disabled";
    case UntestedReason::ignored:
        return "ignored";
    case UntestedReason::touching_at_start:
        break;
    }
    return "touching_at_start";
}

std::string_view name_of(JointType type) {
    switch (type) {
    case JointType::fixed:
        return "fixed";
    case JointType::revolute:
        return "revolute";
    case JointType::continuous:
        return "continuous";
    case JointType::prismatic:
        return "prismatic";
    case JointType::planar:
        return "planar";
    case JointType::floating:
        break;
    }
    return "floating";
}

} // namespace chasles::view
