// One search of one piece of a motion: the earliest contacts over tau in [0, 1].
// Source: paper section 5.1 (hierarchies moved by the same motion); docs/derivations/07-swept-boxes.md and
// 16-margin.md.
#pragma once

#include "chasles/search/candidate.h"
#include "chasles/search/find.h"
#include "chasles/search/memory.h"
#include "chasles/search/piece_context.h"

namespace chasles::search {

/// How to search one piece.
struct SearchOptions {
    double tolerance = 1e-12; ///< of tau
    bool finds_any = false;   ///< stop at any contact, which need not be the first
    double margin = 0;        ///< distance that counts as contact
    bool check_start = true;  ///< search for contact at tau = 0: edges that pass through faces, and with a margin all
                              ///< features within it
    double from = 0;  ///< tau at which the search begins: before and at it nothing is within the margin, unless it is 0
    double until = 1; ///< tau after which no contact matters
    Memory& memory = no_memory(); ///< of both bodies
};

/// The answer for one piece.
struct PieceResult {
    std::vector<Candidate> candidates; ///< empty: proven clear. Candidates after the first contact are left out
    double searched_until = 1;         ///< contacts between this time and the candidates were not searched for
    std::optional<Overlap> overlap;    ///< only with check_start; the point is in the frame of the fixed body
    Work work;
};

/// Thrown by a search that reaches the limit of its thread.
struct Stopped {
    double clear_until; ///< tau up to which nothing is within the margin
};

/// Throws Stopped.
PieceResult search_piece(PieceContext& context, const SearchOptions& options);

} // namespace chasles::search
