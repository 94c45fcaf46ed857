// The demonstration: a nut is unscrewed, pulled, and unscrewed by a wrong pitch. Every answer is compared with the
// geometry of the thread.
#pragma once

#include "scenes/threaded_fastener.h"

#include <filesystem>
#include <ostream>

namespace chasles::scenes {

/// Runs three queries for a nut on a bolt and writes a short report. The first proves, turn by turn, that the right
/// screw is clear. The second finds the first contact of a straight pull along the axis, the third the first contact of
/// a screw with a wrong pitch. Returns 0 if all three results agree with the geometry of the thread, otherwise 1. If
/// `save_to` is given, writes the bodies to this folder as bolt.obj and nut.obj. Throws InvalidInput if this fails.
int run_demo(std::ostream& out, const std::filesystem::path& save_to = {});

/// The same for a fastener of any size.
int run_demo(std::ostream& out, const ThreadedFastener& fastener, const std::filesystem::path& save_to = {});

} // namespace chasles::scenes
