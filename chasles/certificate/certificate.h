// An answer as a file that a stranger's program can check. Specification: docs/certificate.md.
#pragma once

#include "chasles/base/export.h"
#include "chasles/query/batch.h"
#include "chasles/query/path.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace chasles {

class JointPath;
class RobotChecker;
class Scene;
struct SceneQuery;

struct Certificate {
    std::string text = {};  ///< docs/certificate.md
    std::size_t planes = 0; ///< steps that a checker has to test
    /// Empty if the text proves the answer. Otherwise what it does not prove, and why.
    std::string missing = {};
    std::vector<Polyhedron> bodies = {}; ///< as checkers need them: of a scene or robot each different one once
};

/// Proves the answer to a question: with `margin`, radii, and solid bodies, one or both of which move. Motions are
/// screws, sweeps, velocities, twists, even hinges and sliders (whose values at the ends are rounded to double), tracks
/// of them (TimedPoses), and products of these. The proof is found anew, beside the search, so that it does not share
/// its faults. The bracket of a contact is wider than that of the answer, by 2^-44 of the piece at both ends.
///
/// Throws InvalidInput "certificate: WHY" for what cannot be certified: other motions, half turns of sweeps, velocities
/// and twists, `hold`, bodies some of whose faces have no area or were cut, faces that were moved inwards, closed parts
/// of bodies that are not closed edge by edge. Throws Cancelled.
CHASLES_EXPORT Certificate certify(const FirstContactQuery& query);
/// Likewise of a path whose motions are of one kind, each from where the last one ends. `progress` is not called.
CHASLES_EXPORT Certificate certify(const PathQuery& query);

/// One certificate a motion, in order; the same for any number of threads. Where there is none, `text` is empty and
/// `missing` says why.
CHASLES_EXPORT std::vector<Certificate> certify_batch(const BatchQuery& query);
/// The first contact of all tested pairs of a scene, whose bodies move by the motions above that have poses in the
/// world and the same stamps. Throws InvalidInput for `hold` and `until` too.
CHASLES_EXPORT Certificate certify(const Scene& scene, const SceneQuery& query);
/// Likewise of a robot, its links and the bodies around it, along a path that is straight in joint space. Poses of
/// links and axes are rounded to double: the certificate is about these. Bodies of the scene stand still, or the path
/// has one segment. No handovers.
CHASLES_EXPORT Certificate certify(const RobotChecker& checker, const JointPath& path);

/// The shapes of the robot and of its scene.
CHASLES_EXPORT std::vector<Polyhedron> bodies_of(const RobotChecker& checker);

/// Whether the motions of a certificate are these ones, pose by pose. Throws InvalidInput as `certify` for others.
CHASLES_EXPORT bool is_about(const std::string& text, std::span<const Motion> path);
inline bool is_about(const std::string& text, const Motion& motion) {
    return is_about(text, std::span(&motion, 1));
}

/// Whether the bodies, motions, pairs and margins of a certificate are those of this question.
CHASLES_EXPORT bool is_about(const std::string& text, const Scene& scene, const SceneQuery& query);
CHASLES_EXPORT bool is_about(const std::string& text, const RobotChecker& checker, const JointPath& path);

} // namespace chasles
