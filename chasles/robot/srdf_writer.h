// Writes proven pairs as an SRDF file.
#pragma once

#include "chasles/robot/pair_proof.h"

#include <filesystem>
#include <string>
#include <vector>

namespace chasles::robot {

/// An SRDF file with a <disable_collisions> for each pair that touches never or always, or is adjacent. If `given`
/// names a file, all else of it is kept, and the pairs that it disables are replaced. Throws InvalidInput for a file
/// that is no SRDF.
std::string srdf_text(const Robot& robot, const std::vector<PairProof>& proofs, const std::filesystem::path& given);

} // namespace chasles::robot
