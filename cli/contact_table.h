// The contacts of an answer as aligned columns: which features touch, where, along which normal, how fast.
#pragma once

#include "chasles/chasles.h"

#include <string>
#include <vector>

namespace chasles::cli {

/// A head and one line a contact, without line ends; after the first ten a line that says how many more there are.
std::vector<std::string> contact_table(const std::vector<Contact>& contacts, bool shows_gaps);

/// "edge 3-9", "face 7".
std::string edge_name(const Feature& edge);
std::string face_name(const Feature& face);

/// "(1, 2, 3)" with nine digits at most.
std::string vector_text(const Eigen::Vector3d& vector);

} // namespace chasles::cli
