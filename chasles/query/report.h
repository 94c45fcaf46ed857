// From what a search of one piece found to the answer that a user gets.
#pragma once

#include "chasles/query/pair_query.h"
#include "chasles/search/piece_search.h"

namespace chasles::query {

/// What a report needs beside the result of a search.
struct ReportScope {
    const QueryOptions& options;
    bool is_first_piece = false;
    double margin = 0; ///< of the search
};

/// Whether an answer lists the contacts of the first moment, and not only one of them.
inline bool lists_contacts(const QueryOptions& options) {
    return options.find == Find::first_with_all_contacts || options.hold;
}

/// The first contact lies in this bracket of tau: not before any lower end nor after any upper end.
Bracket enclosing(const search::PieceResult& result);

/// Whether the search found a contact or an overlap.
bool has_contact(const search::PieceResult& result);

/// Writes the contact that a search found into an answer, with everything but `held`, `clear_until` and `work`.
void report(FirstContact& answer, const search::PieceContext& context, const search::PieceResult& result,
            const ReportScope& scope);

/// The contacts of candidates at a tau, in the world.
struct ContactTime {
    Bracket tau;
    bool is_at_start = false;
};
std::vector<Contact> contacts_of(const search::PieceContext& context, std::vector<search::Candidate> candidates,
                                 const ContactTime& when, const ReportScope& scope);

} // namespace chasles::query
