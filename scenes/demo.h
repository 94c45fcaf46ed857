// The demonstration: a nut is unscrewed, pulled, and unscrewed by a wrong pitch. Every answer is compared with the
// geometry of the thread.
#pragma once

#include "scenes/threaded_fastener.h"

#include <functional>
#include <ostream>
#include <string>

namespace chasles::scenes {

/// Writes a text to a file of this name.
using SaveFile = std::function<void(const std::string& name, const std::string& text)>;

/// Runs three queries for a nut on a bolt and writes a short report. The first proves, turn by turn, that the right
/// screw is clear. The second finds the first contact of a straight pull along the axis, the third the first contact of
/// a screw with a wrong pitch. Returns 0 if all three results agree with the geometry of the thread, otherwise 1.
/// `save`, which may be empty, gets the bodies as bolt.obj and nut.obj before the queries.
int run_demo(std::ostream& out, const SaveFile& save = {});

/// The same for a fastener of any size.
int run_demo(std::ostream& out, const ThreadedFastener& fastener, const SaveFile& save = {});

} // namespace chasles::scenes
