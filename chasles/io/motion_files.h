// Reads paths and lists of motions from tables with named columns.
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
    std::vector<double> stamps;        ///< the column "t", increasing, one stamp per pose; empty without this column
    std::vector<std::string> warnings; ///< one line each: the columns that are not read
};

/// Reads a path, one pose per row, with the columns x, y, z, qw, qx, qy, qz and perhaps t, in any order. Files whose
/// name ends in ".tum" or ".txt" may be TUM trajectories without a header. Lengths are in the length unit of the
/// meshes, stamps in any unit. Throws InvalidInput with the file name, the line number and the reason.
Path load_path(const std::filesystem::path& file);

/// One row of a list of motions: two poses, or the reason why they could not be read.
struct MotionRow {
    std::string id; ///< the cell of the column "id"; without this column the row number, from 0
    Pose start;
    Pose goal;
    std::string error; ///< "line N: WHY"; empty if both poses were read
};

struct MotionList {
    std::vector<MotionRow> rows;
    std::vector<std::string> warnings; ///< as of a path
};

/// Reads motions, one motion per row, with the columns x0, y0, z0, qw0, qx0, qy0, qz0, x1, y1, z1, qw1, qx1, qy1, qz1
/// and perhaps id, in any order. An invalid row is returned with its error. Throws InvalidInput if the file or its
/// header is invalid.
MotionList load_motions(const std::filesystem::path& file);

/// What eight numbers a row are in a file without a header: the time, the position, and the quaternion with qw last in
/// a TUM trajectory.
enum class WithoutHeader { refused, tum };

/// The same readers for the content of a file. Their messages do not contain the file name.
Path read_path(std::string_view text, WithoutHeader without_header = WithoutHeader::refused);
MotionList read_motions(std::string_view text);

} // namespace chasles::io
