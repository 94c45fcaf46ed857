// Answers as JSON. Every number reads back to the identical double.
#pragma once

#include "view/motion_numbers.h"

#include <nlohmann/json.hpp>

namespace chasles::view {

using Json = nlohmann::ordered_json;

/// The answer of `check`. Every answer has verdict, clear_until, motion and work. An answer with contact also has time,
/// tau if the motion has it, certain, pose and contacts, overlap if the surfaces overlap at the start, and inside,
/// inside_vertex and inside_point if one body is inside of the other one. `held` is present if not empty, and
/// contacts_cut if true.
Json answer_json(const FirstContact& found, const MotionNumbers& motion);

/// The answer of `clearance`: distance, time, tau if the motion has it, certain, pose, contacts, motion and work.
/// `overlap` and `inside` are those of `check`; contacts_cut is present if true.
Json answer_json(const LeastDistance& found, const MotionNumbers& motion);

/// The answer of `scene`. For the first contact: the keys of `check` without tau and motion, and `pair`, the names of
/// the moving and the fixed body; `simultaneous` lists further pairs that may touch at that time. For `all`: `events`,
/// each with time, time_upper, certain, pair and contacts, and perhaps overlap, inside and contacts_cut, and `work`.
/// Both have `untested`.
Json scene_answer_json(const chasles::Scene& scene, const SceneAnswer& answer, bool all);

/// The answer of `scene --clearance`: distance, distance_upper, time, time_upper, certain, pair, contacts, and perhaps
/// overlap, inside and contacts_cut, untested and work. Without a pair all but certain, contacts,
/// untested and work are null, and contacts is empty.
Json scene_distance_json(const chasles::Scene& scene, const SceneDistance& found);

/// The answer of `scene --matrix`: `pairs`, each with pair, distance, distance_upper, time, time_upper, certain, pose,
/// contacts, work, and perhaps overlap, inside and contacts_cut; untested and work.
Json distance_matrix_json(const chasles::Scene& scene, const DistanceMatrix& found);

/// The answer of `robot`: verdict, segment, clear_until, configuration and work; if it touches, time, time_upper,
/// certain, pair and contacts, too, contacts_cut if true, and `held` if it is not empty. Times count within the
/// segment, in [0, 1], or in stamps. Robots' answers have `untested`.
Json robot_answer_json(const chasles::Robot& robot, const RobotAnswer& answer, bool in_stamps);
/// The answer of `robot --clearance`: distance, distance_upper, time, time_upper, certain, pair, segment, contacts,
/// configuration and work. Without a pair as `scene --clearance`.
Json robot_clearance_json(const chasles::Robot& robot, const RobotClearance& found, bool in_stamps);
/// The pairs that an answer leaves out. `tested` and `pairs` are the numbers of tested and untested pairs. `reasons`
/// has reason, count and the first pairs by name for each reason. Links without shapes are in `links`.
Json untested_json(const UntestedPairs& untested);
/// The variables of a robot by name.
Json configuration_json(const chasles::Robot& robot, const Configuration& configuration);
/// The answer of `acm`: pairs with links, reason, and a witness if there is one.
Json pair_proofs_json(const chasles::Robot& robot, const std::vector<PairProof>& proofs);

/// A contact, and an overlap, as in the lists of every answer.
Json contact_json(const Contact& contact);
Json overlap_json(const Overlap& overlap);
/// Adds the keys inside, inside_vertex and inside_point.
void add_inside(Json& answer, const Inside& inside);

Json vector_json(const Eigen::Vector3d& vector);
/// x, y, z, qw, qx, qy, qz. The quaternion has length one.
Json pose_json(const Pose& pose);

} // namespace chasles::view
