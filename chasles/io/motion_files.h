// Paths and lists of motions from CSV files.
#pragma once

#include "chasles/motion/pose.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

/// The poses of a path, one a row, under the header "x,y,z,qw,qx,qy,qz".
/// Throws InvalidInput that names the file, the line and the reason.
std::vector<Pose> load_path(const std::filesystem::path& file);

/// One row of a list of motions: two poses, or why they could not be read.
struct MotionRow {
    std::string id; ///< as given; the number of the row, from 0, if there is no column "id"
    Pose start;
    Pose goal;
    std::string error; ///< "line N: WHY"; empty if both poses were read
};

/// Motions, one a row, under the header "x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1", with an optional first
/// column "id". A row that cannot be read costs only itself; throws InvalidInput if the file or its header cannot.
std::vector<MotionRow> load_motions(const std::filesystem::path& file);

/// The same from the content of a file; what they throw does not name it.
std::vector<Pose> read_path(std::string_view text);
std::vector<MotionRow> read_motions(std::string_view text);

} // namespace chasles::io
