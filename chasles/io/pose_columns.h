// The names that programs give the columns of a pose.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

/// "x", "y", "z", "qw", "qx", "qy", "qz", then "t": the columns of a pose and of its time stamp.
std::vector<std::string> pose_columns();

/// Which of these columns a name stands for, or an empty text. Capitals count as small letters. docs/command-line.md
/// lists the names.
std::string pose_column(std::string_view name);

/// Whether a name is `t`, `time`, `timestamp`, `time_from_start`, `stamp`, `header.stamp` or `__time`, perhaps with a
/// unit of time. Capitals count as small letters.
bool is_time_column(std::string_view name);

} // namespace chasles::io
