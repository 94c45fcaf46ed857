// The data of a page of many bodies: an answered scene, or a recording of bodies that moved from contact to contact.
#pragma once

#include "view/curve.h"
#include "view/sampled_poses.h"

#include <optional>
#include <string>

namespace chasles::view {

struct RecordedBody {
    std::string name; ///< UTF-8; invalid bytes are replaced
    Polyhedron shape; ///< a page holds a shape once that several bodies share
    /// In the world. One if the body rests, otherwise one for each time. The page turns a body the shorter way round,
    /// so neighbours should turn by at most `largest_turn_of_step`.
    std::vector<PoseRow> poses;
    std::vector<double> times = {}; ///< of the poses; empty: those of the record
};

/// A pair of bodies in contact.
struct RecordedContact {
    double time = 0;
    double time_upper = 0; ///< the first contact is in the bracket from time to time_upper
    bool certain = true;
    std::size_t moving = 0; ///< index of the body
    std::size_t fixed = 0;  ///< likewise
    std::string kind = {};  ///< any text, for example "impact"; may be empty
    std::vector<Contact> contacts = {};
    bool contacts_cut = false; ///< there are more contacts than the list has
    bool has_features = true;  ///< whether `contacts` have a kind, features and an approach speed
    std::optional<Overlap> overlap = {};
    std::optional<Inside> inside = {};
};

enum class RecordSource : std::uint8_t {
    first_contact, ///< Scene::first_contact, or RobotChecker::first_contact
    all_contacts,  ///< Scene::all_contacts
    recording
};

struct SceneRecord {
    std::string title = "Chasles"; ///< UTF-8; invalid bytes are replaced
    RecordSource source = RecordSource::recording;
    double margin = 0;                      ///< margin of the query, mesh unit
    std::optional<double> clear_until = {}; ///< of the answer, if it is known
    double until = 1;                       ///< contacts after this time were not asked for
    std::vector<double> times = {};         ///< ascending; the first and the last one are the ends of the slider
    std::vector<RecordedBody> bodies = {};
    std::vector<RecordedContact> contacts = {}; ///< in any order
    std::optional<UntestedPairs> untested = {}; ///< of the answer, if it is known
    std::optional<Curve> curve = {};
    std::optional<DistanceMatrix> matrix = {}; ///< of these bodies
};

/// The record of an answered scene, over the time [0, 1]. `source` is the question that was asked. Bodies are in the
/// order of the scene.
SceneRecord scene_record(const chasles::Scene& scene, const SceneAnswer& found, RecordSource source);

/// The record of the least distances of all pairs. Its contacts are those of the pairs that touch.
SceneRecord scene_record(const chasles::Scene& scene, const DistanceMatrix& found);

/// Throws InvalidInput "record: WHERE: WHY" for a wrong record. Times have to ascend. A body has one pose, or one for
/// each time. A contact is within the times and names two bodies of the record. All numbers are finite.
void require_valid(const SceneRecord& record);

} // namespace chasles::view
