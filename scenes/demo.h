// The demonstration: a nut is unscrewed, pulled and screwed wrongly, and every answer is held against what must be.
#pragma once

#include "scenes/threaded_fastener.h"

#include <filesystem>
#include <ostream>

namespace chasles::scenes {

/// Answers the three questions on a bolt and a nut and writes a short report: unscrewing with the right screw (proven
/// clear, turn by turn), a straight pull along the axis, and a screw of the wrong pitch (where each first touches).
/// Returns 0 if all three come out as the geometry of the thread says, 1 otherwise.
/// If `save_to` is given, both bodies are written there as bolt.obj and nut.obj; throws InvalidInput if they cannot be.
int run_demo(std::ostream& out, const std::filesystem::path& save_to = {});

/// The same on a fastener of any size.
int run_demo(std::ostream& out, const ThreadedFastener& fastener, const std::filesystem::path& save_to = {});

} // namespace chasles::scenes
