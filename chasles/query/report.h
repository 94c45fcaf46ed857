// From what a search of one piece found to the answer that a user gets.
#pragma once

#include "chasles/contact/contact_set.h"
#include "chasles/query/pair_query.h"
#include "chasles/search/near_features.h"
#include "chasles/search/nearest_features.h"
#include "chasles/search/piece_search.h"

#include <Eigen/Geometry>

namespace chasles::query {

/// What a report needs beside the result of a search.
struct ReportScope {
    const QueryOptions& options;
    bool is_first_piece = false;
    double margin = 0; ///< of the search, between the polyhedra
};

/// Whether an answer lists the contacts of the first moment, and not only one of them.
inline bool lists_contacts(const QueryOptions& options) {
    return options.find == Find::first_with_all_contacts || options.hold;
}

/// The first contact lies in this bracket of tau: not before any lower end nor after any upper end.
Bracket enclosing(const search::PieceResult& result);

/// Whether the search found a contact or an overlap.
bool has_contact(const search::PieceResult& result);

/// Writes the contact that a search found into an answer, with everything but `held` and `clear_until`; adds to its
/// work.
void report(FirstContact& answer, search::PieceContext& context, const search::PieceResult& result,
            const ReportScope& scope);

/// The bodies at the lower end of a bracket of tau, for their contacts.
class ContactMoment {
public:
    /// Keeps the context by reference. Features of the polyhedra within `margin` are in contact; the bracket is at most
    /// `width` wide.
    ContactMoment(search::PieceContext& context, double tau, bool is_at_start, double margin, double width);
    /// At the start, with features at which the distance falls by at most these slopes beside them.
    ContactMoment(search::PieceContext& context, double margin, const contact::Slopes& slopes)
        : ContactMoment(context, 0, true, margin, 0) {
        scene_.slopes = slopes;
    }
    ContactMoment(const ContactMoment&) = delete;
    ContactMoment& operator=(const ContactMoment&) = delete;

    [[nodiscard]] const contact::ContactScene& scene() const { return scene_; }
    /// What touches or, with a margin, is at a local minimum of the distance.
    [[nodiscard]] search::NearFeatures find(const search::NearSearch& search) const {
        return search::near_features(context_, scene_, tau_, search);
    }
    /// What touches, whatever the margin is.
    [[nodiscard]] search::NearFeatures find_touching(const search::NearSearch& search) const {
        contact::ContactScene touching = scene_;
        touching.margin = 0;
        return search::near_features(context_, touching, tau_, search);
    }
    /// The features on which the nearest points of two features are.
    [[nodiscard]] contact::FeaturePair nearest_parts(const contact::FeaturePair& features) const {
        return contact::features_at(scene_, features, search::NearestAtRest().points(bodies_, features));
    }
    /// One contact, in the world and named as in the input.
    [[nodiscard]] Contact contact_of(const contact::FeaturePair& features) const {
        return in_world(contact::named_contact(scene_, features));
    }
    /// The contact of the first pair with a gap that the motion closes; empty if there is none.
    [[nodiscard]] std::optional<Contact> closing_contact(const std::vector<contact::FeaturePair>& pairs) const;
    /// The contacts of feature pairs, each once, and flat contacts by their corners.
    [[nodiscard]] std::vector<Contact> contacts_of(const std::vector<contact::FeaturePair>& pairs) const;

private:
    [[nodiscard]] Contact in_world(Contact contact) const;

    search::PieceContext& context_;
    double tau_;
    contact::RelativeConfiguration bodies_;
    contact::ContactScene scene_;
    Eigen::Isometry3d to_world_;
};

/// Cuts a list to the contacts that an answer may list. True if it was longer.
bool cut_to_most(std::vector<Contact>& contacts);
/// Likewise to the nearest ones, in their order.
bool cut_to_nearest(std::vector<Contact>& contacts);

} // namespace chasles::query
