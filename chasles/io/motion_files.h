// Reads paths and lists of motions from CSV files.
// The formats are in docs/command-line.md.
#pragma once

#include "chasles/motion/pose.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

/// The poses of a path, at least two.
struct Path {
    std::vector<Pose> poses;
    std::vector<double> stamps; ///< the column "t", increasing, one stamp per pose; empty without this column
};

/// Reads a path, one pose per row, with the header "x,y,z,qw,qx,qy,qz" and an optional first column "t". Lengths are in
/// the length unit of the meshes, stamps in any unit. Throws InvalidInput with the file name, the line number and the
/// reason.
Path load_path(const std::filesystem::path& file);

/// One row of a list of motions: two poses, or the reason why they could not be read.
struct MotionRow {
    std::string id; ///< the cell of the column "id"; without this column the row number, from 0
    Pose start;
    Pose goal;
    std::string error; ///< "line N: WHY"; empty if both poses were read
};

/// Reads motions, one motion per row, with the header "x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1" and an
/// optional first column "id". An invalid row is returned with its error. Throws InvalidInput if the file or its header
/// is invalid.
std::vector<MotionRow> load_motions(const std::filesystem::path& file);

/// The same readers for the content of a file. Their messages do not contain the file name.
Path read_path(std::string_view text);
std::vector<MotionRow> read_motions(std::string_view text);

} // namespace chasles::io
