#include "chasles/query/report.h"

#include "chasles/contact/contact_set.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace chasles::query {

namespace {

using search::Candidate;

bool is_certain(const std::vector<Candidate>& candidates, const Bracket& tau) {
    return std::ranges::any_of(candidates, [&](const Candidate& candidate) {
        return candidate.tau.certain && candidate.tau.upper <= tau.upper;
    });
}

/// Proven candidates before uncertain ones, then the earliest: proven ones by their upper end, where the bracket of the
/// answer ends.
std::pair<bool, double> rank(const Candidate& candidate) {
    const auto& [lower, upper, certain] = candidate.tau;
    return {!certain, certain ? upper : lower};
}

/// One candidate for each feature pair: the first by rank. A contact at the border of two intervals of time is found in
/// both.
std::vector<Candidate> without_repeated(std::vector<Candidate> candidates) {
    const auto features = [](const Candidate& c) -> const contact::FeaturePair& { return c; };
    std::ranges::sort(candidates, {}, [&](const Candidate& c) { return std::pair(features(c), rank(c)); });
    const auto repeated = std::ranges::unique(candidates, {}, features);
    candidates.erase(repeated.begin(), repeated.end());
    return candidates;
}

const Candidate& first_of(const std::vector<Candidate>& candidates) {
    return *std::ranges::min_element(candidates, {}, rank);
}

/// From the body's own numbering of faces to that of its input.
void name_face(Feature& feature, const Body& body) {
    feature.first = feature.second = body.source_face(feature.first);
}

void name_faces(Contact& contact, const search::PieceContext& context) {
    if (moving_feature_kind(contact.kind) == FeatureKind::face)
        name_face(contact.moving, context.moving());
    if (fixed_feature_kind(contact.kind) == FeatureKind::face)
        name_face(contact.fixed, context.fixed());
}

Eigen::Vector3d in_world(const Eigen::Isometry3d& to_world, const Eigen::Vector3d& point) {
    return contact::product(to_world.linear(), point) + to_world.translation();
}

/// The overlap in the world frame, with the ids of the input.
Overlap reported(Overlap overlap, const Pose& fixed_pose, const search::PieceContext& context) {
    overlap.point = in_world(fixed_pose.isometry(), overlap.point);
    name_face(overlap.face, overlap.edge_is_moving ? context.fixed() : context.moving());
    return overlap;
}

} // namespace

Bracket enclosing(const search::PieceResult& result) {
    if (result.overlap)
        return {0, 0};
    Bracket bracket{result.searched_until, 1};
    for (const Candidate& candidate : result.candidates) {
        bracket.lower = std::min(bracket.lower, candidate.tau.lower);
        bracket.upper = std::min(bracket.upper, candidate.tau.upper);
    }
    return bracket;
}

bool has_contact(const search::PieceResult& result) {
    return result.overlap || !result.candidates.empty();
}

void report(FirstContact& answer, const search::PieceContext& context, const search::PieceResult& result,
            const ReportScope& scope) {
    const motion::AnyPiece& piece = context.piece();
    const Bracket tau = enclosing(result);
    answer.tau = piece.tau_of(tau);
    answer.time = piece.time_of(tau);
    answer.certain =
        piece.deviation() <= 0 && (result.overlap ? result.overlap->certain : is_certain(result.candidates, tau));
    const bool at_start = scope.is_first_piece && search::may_be_at_start({tau.lower, tau.upper, answer.certain});
    answer.verdict = at_start ? Verdict::contact_at_start : Verdict::contact;
    answer.pose = piece.pose_at(tau.lower);
    answer.fixed_pose = piece.fixed_pose_at(tau.lower);
    if (result.overlap)
        answer.overlap = reported(*result.overlap, answer.fixed_pose, context);
    answer.contacts = contacts_of(context, result.candidates, {tau, at_start}, scope);
}

std::vector<Contact> contacts_of(const search::PieceContext& context, std::vector<Candidate> candidates,
                                 const ContactTime& when, const ReportScope& scope) {
    if (candidates.empty())
        return {};
    candidates = without_repeated(std::move(candidates));
    const motion::AnyPiece& piece = context.piece();
    const auto& [tau, is_at_start] = when;
    const contact::RelativeConfiguration bodies(context.moving(), context.fixed(), context.maps(), tau.lower);
    const double width = std::min(tau.upper - tau.lower, scope.options.time_tolerance);
    const contact::ContactScene scene{bodies, is_at_start, scope.margin,
                                      contact::touch_slack(bodies, context.error_scale(scope.margin), width)};
    std::vector<Contact> contacts = lists_contacts(scope.options)
                                        ? contact_set(scene, {candidates.begin(), candidates.end()})
                                        : std::vector{described(scene, first_of(candidates))};
    const Eigen::Isometry3d to_world = piece.fixed_pose_at(tau.lower).isometry();
    for (Contact& contact : contacts) {
        contact.point = in_world(to_world, contact.point);
        contact.normal = contact::product(to_world.linear(), contact.normal);
        contact.approach_speed *= piece.tau_rate(tau.lower);
        name_faces(contact, context);
    }
    return contacts;
}

} // namespace chasles::query
