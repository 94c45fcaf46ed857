// The contacts of an answer as aligned columns: features, point, normal, approach speed and gap.
#pragma once

#include "chasles/chasles.h"

#include <string>
#include <vector>

namespace chasles::cli {

/// A header line and one line per contact, without line ends. After the first ten contacts, one line gives the number
/// of further contacts.
std::vector<std::string> contact_table(const std::vector<Contact>& contacts, bool shows_gaps);

/// "edge 3-9", "face 7".
std::string edge_name(const Feature& edge);
std::string face_name(const Feature& face);

/// "(1, 2, 3)" with at most nine digits.
std::string vector_text(const Eigen::Vector3d& vector);

} // namespace chasles::cli
