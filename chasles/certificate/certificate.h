// An answer as a file that a stranger's program can check. Specification: docs/certificate.md.
#pragma once

#include "chasles/base/export.h"
#include "chasles/query/first_contact.h"

#include <cstddef>
#include <string>

namespace chasles {

struct Certificate {
    std::string text;       ///< docs/certificate.md
    std::size_t planes = 0; ///< steps that a checker has to test
    /// Empty if the text proves the answer. Otherwise what it does not prove, and why.
    std::string missing;
};

/// Proves the answer to a question about the paper's screw: with `margin`, radii, and solid bodies. The proof is found
/// anew, beside the search, so that it does not share its faults. The bracket of a contact is wider than that of the
/// answer, by 2^-44 of tau at both ends.
///
/// Throws InvalidInput "certificate: WHY" for what cannot be certified: other motions, a fixed body that moves, `hold`,
/// faces without area or cut polygons, faces that were moved inwards, closed parts of bodies that are not closed edge
/// by edge. Throws Cancelled.
CHASLES_EXPORT Certificate certify(const FirstContactQuery& query);

/// Whether the motion of a certificate is this one, pose by pose. Throws InvalidInput as `certify` for other motions.
CHASLES_EXPORT bool is_about(const std::string& text, const Motion& motion);

} // namespace chasles
