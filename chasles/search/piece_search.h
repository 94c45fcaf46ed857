// One motion of the family over tau in [0, 1]: walks both hierarchies in space and time to the earliest contacts.
// Source: paper section 5.1 (hierarchies moved by the same motion); docs/derivations/07-swept-boxes.md.
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/culling/swept_boxes.h"
#include "chasles/motion/motion_ends.h"
#include "chasles/search/candidate.h"

#include <algorithm>

namespace chasles::search {

/// How the filter in double searches, for brackets of this width in tau. Its steps are limited to what ordinary
/// detections need, as those of the refinement are: what takes more is better off with the next stage. A matter of time
/// only (`make bench`, elementary_bench and worst_elementary_bench).
inline algebra::Tolerance filter_tolerance(double width) {
    return {width, width, 40};
}

/// What one piece of a motion gave.
struct PieceResult {
    std::vector<Candidate> candidates; ///< none: proven clear. Those after the first contact are left out
    double open_after = 1;             ///< contacts from here on, up to those, were not asked for
    std::optional<Overlap> overlap;    ///< only when asked for; the point is in the frame of the fixed body
    Work work;
};

class HeldContacts;

/// How to search one piece.
struct PieceSearch {
    const Body& moving;
    const Body& fixed;
    const MotionFrame& frame;
    double tolerance = 1e-12; ///< of tau
    Find find = Find::first;
    bool check_start = true; ///< look for what is in contact at tau = 0 already: edges that pass through faces, and
                             ///< with a margin all that is within it
    double margin = 0;       ///< distance that counts as contact
    bool only_start = false; ///< with a margin: looks at tau = 0 only
    const HeldContacts* held = nullptr; ///< with a margin: what is no new contact; none if every one is
};

PieceResult search_piece(const PieceSearch& search);

} // namespace chasles::search
