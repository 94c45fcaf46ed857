#include "chasles/query/report.h"

#include "chasles/search/nearest_at_start.h"

#include <algorithm>

namespace chasles::query {

namespace {

using contact::FeaturePair;
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

const Candidate& first_of(const std::vector<Candidate>& candidates) {
    return *std::ranges::min_element(candidates, {}, rank);
}

/// A tau at which features are proven to be within the margin, soon after a bracket begins. As nothing is before it,
/// that proves a contact, also one at the rims of all features, where no test of them is certain (note 16, "Stages").
std::optional<double> proven_end(const search::PieceContext& context, double lower,
                                 const std::vector<Candidate>& candidates, const ReportScope& scope) {
    const double tolerance = context.piece().tau_tolerance(scope.options.time_tolerance);
    for (const int tolerances : {1, 4})
        for (const Candidate& candidate : candidates)
            if (const double tau = std::min(1.0, lower + tolerances * tolerance);
                scope.margin > 0 && search::are_within(context, tau, candidate, scope.margin))
                return tau;
    return std::nullopt;
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

Eigen::Vector3d placed(const Eigen::Isometry3d& to_world, const Eigen::Vector3d& point) {
    return contact::product(to_world.linear(), point) + to_world.translation();
}

/// The overlap in the world frame, with the ids of the input.
Overlap reported(Overlap overlap, const Pose& fixed_pose, const search::PieceContext& context) {
    overlap.point = placed(fixed_pose.isometry(), overlap.point);
    name_face(overlap.face, overlap.edge_is_moving ? context.fixed() : context.moving());
    return overlap;
}

/// Contacts with a gap that the motion closes come before others, which may be of two faces in one plane.
void put_closing_first(std::vector<Contact>& contacts) {
    double fastest = 0;
    for (const Contact& contact : contacts)
        fastest = std::max(fastest, contact.approach_speed);
    std::ranges::stable_partition(
        contacts, [&](const Contact& contact) { return contact.approach_speed > contact::no_direction * fastest; });
}

/// An edge that may just miss the rim of a face is no overlap that an answer names, if there is another thing to name.
bool is_proven(const std::optional<Overlap>& overlap) {
    return overlap && overlap->certain;
}

/// All contacts of the moment; with a proven overlap those that were found before it, as it ends the search.
void list_contacts(FirstContact& answer, const ContactMoment& moment, const search::PieceResult& result) {
    std::vector<FeaturePair> pairs;
    if (!is_proven(result.overlap)) {
        search::NearFeatures near = moment.find({});
        answer.work += near.work;
        answer.contacts_cut = near.is_cut;
        pairs = std::move(near.pairs);
    }
    if (!result.candidates.empty())
        pairs.push_back(first_of(result.candidates)); // an uncertain contact may be none
    if (!pairs.empty())
        answer.contacts = moment.contacts_of(pairs);
    if (moment.scene().margin > 0)
        answer.contacts_cut = cut_to_nearest(answer.contacts) || answer.contacts_cut;
    put_closing_first(answer.contacts);
    answer.contacts_cut = cut_to_most(answer.contacts) || answer.contacts_cut || is_proven(result.overlap);
}

/// The first contact that the motion closes, of the pairs that may be the first. The pair that decided the time may
/// have a normal along which nothing closes, for example that of two tops in one plane.
std::optional<Contact> closing_contact(const ContactMoment& moment, const std::vector<Candidate>& candidates) {
    const Candidate& first = first_of(candidates);
    std::vector<FeaturePair> pairs{first};
    for (const Candidate& candidate : candidates)
        if (candidate.tau.lower <= first.tau.upper && (candidate.tau.certain || !first.tau.certain))
            pairs.push_back(candidate);
    return moment.closing_contact(pairs);
}

/// Reports one contact for all that touch, and at the start an overlap. A short search finds what else touches at the
/// moment: at the start, and where the motion closes no candidate.
void report_touch(FirstContact& answer, const ContactMoment& moment, const search::PieceResult& result,
                  const ReportScope& scope) {
    const bool is_listed = lists_contacts(scope.options) || (result.candidates.empty() && !result.overlap);
    std::optional<Contact> contact =
        is_listed || result.candidates.empty() ? std::nullopt : closing_contact(moment, result.candidates);
    const bool at_start = moment.scene().at_start;
    const bool is_in_doubt = at_start && !answer.certain;
    const bool is_question_of_features =
        is_in_doubt || (scope.margin == 0 && scope.options.find != Find::any && !is_proven(result.overlap));
    search::NearFeatures near;
    if (is_question_of_features && (at_start || !(is_listed || contact)))
        near = moment.find_touching({.most_pairs = is_in_doubt ? 1U << 12 : 1U << 8,
                                     .most_visits = is_in_doubt ? 1U << 14 : 1U << 10,
                                     .finds_crossing_faces = at_start});
    answer.work += near.work;
    if (near.overlap)
        answer.overlap = near.overlap;
    if (is_listed)
        return;
    if (!contact)
        contact = moment.closing_contact(near.pairs);
    if (!contact && !result.candidates.empty())
        contact = moment.contact_of(first_of(result.candidates));
    if (!contact && !near.pairs.empty())
        contact = moment.contact_of(near.pairs.front());
    if (contact)
        answer.contacts = {*contact};
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

void report(FirstContact& answer, search::PieceContext& context, const search::PieceResult& result,
            const ReportScope& scope) {
    const motion::AnyPiece& piece = context.piece();
    Bracket tau = enclosing(result);
    answer.certain = result.overlap ? result.overlap->certain : is_certain(result.candidates, tau);
    const bool at_start = scope.is_first_piece && search::may_be_at_start({tau.lower, tau.upper, answer.certain});
    if (!answer.certain && !at_start)
        if (const auto end = proven_end(context, tau.lower, result.candidates, scope)) {
            answer.certain = true;
            tau.upper = std::max(tau.upper, *end);
        }
    answer.tau = piece.tau_of(tau);
    answer.time = piece.time_of(tau);
    answer.verdict = at_start ? Verdict::contact_at_start : Verdict::contact;
    answer.pose = piece.pose_at(tau.lower);
    answer.fixed_pose = piece.fixed_pose_at(tau.lower);
    answer.overlap = result.overlap;
    const double width = std::min(tau.upper - tau.lower, piece.tau_tolerance(scope.options.time_tolerance));
    const ContactMoment moment(context, tau.lower, at_start, scope.margin, width);
    report_touch(answer, moment, result, scope);
    if (is_proven(answer.overlap)) { // nothing is earlier
        answer.certain = true;
        answer.tau = piece.tau_of({0, 0});
        answer.time = piece.time_of({0, 0});
    }
    if (lists_contacts(scope.options))
        list_contacts(answer, moment, result);
    if (!is_proven(answer.overlap) && !answer.contacts.empty())
        answer.overlap.reset();
    if (answer.overlap)
        answer.overlap = reported(*answer.overlap, answer.fixed_pose, context);
}

ContactMoment::ContactMoment(search::PieceContext& context, double tau, bool is_at_start, double margin, double width)
    : context_(context), tau_(tau), bodies_(context.configuration_at(tau)),
      scene_{bodies_, is_at_start, margin, contact::touch_slack(bodies_, context.error_scale(margin), width)},
      to_world_(context.piece().fixed_pose_at(tau).isometry()) {}

std::optional<Contact> ContactMoment::closing_contact(const std::vector<FeaturePair>& pairs) const {
    for (const FeaturePair& features : pairs)
        if (const Contact contact = contact::named_contact(scene_, features); contact::is_closing(scene_, contact))
            return in_world(contact);
    return std::nullopt;
}

std::vector<Contact> ContactMoment::contacts_of(const std::vector<FeaturePair>& pairs) const {
    std::vector<Contact> contacts = contact::contact_set(scene_, pairs);
    for (Contact& contact : contacts)
        contact = in_world(contact);
    return contacts;
}

/// On the round surfaces, if they are round.
Contact ContactMoment::in_world(Contact contact) const {
    const double of_moving = context_.moving().radius(), of_fixed = context_.fixed().radius();
    if (of_fixed > 0)
        contact.point += of_fixed * contact.normal;
    contact.gap -= of_moving + of_fixed;
    contact.point = placed(to_world_, contact.point);
    contact.normal = contact::product(to_world_.linear(), contact.normal);
    contact.approach_speed *= context_.piece().tau_rate(tau_);
    name_faces(contact, context_);
    return contact;
}

bool cut_to_nearest(std::vector<Contact>& contacts) {
    if (contacts.size() <= most_contacts)
        return false;
    std::vector<double> gaps(contacts.size());
    std::ranges::transform(contacts, gaps.begin(), &Contact::gap);
    std::ranges::nth_element(gaps, gaps.begin() + most_contacts - 1);
    std::erase_if(contacts, [&](const Contact& contact) { return contact.gap > gaps[most_contacts - 1]; });
    (void)cut_to_most(contacts); // equal ones may be more
    return true;
}

bool cut_to_most(std::vector<Contact>& contacts) {
    const bool is_longer = contacts.size() > most_contacts;
    contacts.resize(std::min(contacts.size(), most_contacts));
    return is_longer;
}

} // namespace chasles::query
