// Many bodies in one world, each with its own motion: which touch first, and when?
// Source: docs/derivations/27-scenes.md.
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/query/least_distance.h"
#include "chasles/query/profile.h"
#include "chasles/scene/untested_pairs.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace chasles {

namespace scene {
struct WorldMotion;
} // namespace scene

/// A body of a scene. Bodies and motions are shared, so a thousand bolts need one mesh.
struct SceneBody {
    std::string name; ///< not empty, and of no other body of the scene
    Polyhedron shape;
    /// In the world. Any motion but the paper's screw and the sweep, which are motions as seen from another body.
    Motion motion = Motion::at_rest(Pose());
    std::string group = {}; ///< for rules of groups, which may be set before a group has bodies
};

/// How to answer a question about a scene.
struct SceneQuery {
    /// `find`: Find::any makes it a question of yes or no. The margin is that of all pairs that have none of their own.
    /// Likewise `hold`, which counts for pairs with a greater margin only.
    QueryOptions options = {};
    /// Time in [0, 1]: contacts that begin later are left out. Two bodies that both stand still are tested only with 0,
    /// which makes it a question about the start.
    double until = 1;
    unsigned threads = 0; ///< at most so many; 0: all cores
    /// Called now and then, from any one thread at a time, with the number of pairs done and of all pairs; may be
    /// empty. Where it returns false, the question ends as at a Limit.
    std::function<bool(std::size_t done, std::size_t pairs)> progress = {};
};

/// A contact of two bodies of a scene.
struct SceneContact {
    std::size_t moving = 0; ///< the index of the body in Scene::bodies()
    std::size_t fixed = 0;  ///< likewise; it stands still, or the order of names decides
    FirstContact contact;   ///< of this pair; what it held at the start, too
};

/// The answer for a whole scene.
struct [[nodiscard]] SceneAnswer {
    Verdict verdict = Verdict::unknown; ///< also at a Limit; then there are no contacts
    /// In order of time: by lower ends of brackets, then by names. Empty if the scene is clear. For the earliest
    /// contact: the first pair, and all pairs whose brackets overlap with its bracket, as they may touch at the same
    /// time. Where pairs touch at the start, Find::first gives some of them, and Find::first_with_all_contacts all.
    std::vector<SceneContact> contacts;
    /// Before this time all pairs are proven to stay apart, or farther apart than the margin. Held pairs stay farther
    /// apart than `hold`, or than at the start where that is less.
    double clear_until = 0;
    std::size_t pairs = 0;  ///< whose swept boxes overlap
    UntestedPairs untested; ///< the numbers; Scene::untested gives the names, too
    Work work;
};

/// How near the bodies of a scene come to each other.
struct [[nodiscard]] SceneDistance {
    /// That comes nearest: the first body moves, the second one is fixed; as in SceneContact. Where several pairs are
    /// equally near, one of them. Empty if no pair is tested.
    std::optional<std::pair<std::size_t, std::size_t>> pair;
    /// Of this pair, in the world. The lower end of its distance is proven for all pairs; infinite if none is tested.
    LeastDistance nearest;
    std::size_t pairs = 0;  ///< whose surfaces were compared
    UntestedPairs untested; ///< the numbers; Scene::untested gives the names, too
};

/// How near two bodies of a scene come to each other.
struct PairDistance {
    std::size_t moving = 0; ///< the index of the body in Scene::bodies()
    std::size_t fixed = 0;  ///< likewise; it stands still, or the order of names decides
    LeastDistance nearest;  ///< in the world
};

/// How near each two bodies of a scene come to each other.
struct [[nodiscard]] DistanceMatrix {
    /// Each tested pair once, in the order of its lesser index, then of its greater one.
    std::vector<PairDistance> pairs;
    UntestedPairs untested; ///< the numbers; Scene::untested gives the names, too
};

/// How near the bodies of a scene are to each other over time.
struct [[nodiscard]] SceneProfile {
    DistanceProfile distance; ///< the least of all pairs; infinite if none is tested
    /// What `distance.nearest` counts: the first body moves, the second one is fixed.
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    UntestedPairs untested; ///< the numbers; Scene::untested gives the names, too
};

/// Bodies in one world over the time [0, 1]. Questions may be asked from several threads at a time; changes may not.
class CHASLES_EXPORT Scene {
public:
    /// Adds a body, and returns its index. Throws InvalidInput "scene: NAME: WHY" for a name that is empty or taken,
    /// and for a motion that has no pose in the world.
    std::size_t add(SceneBody body);
    /// Removes a body; the last one takes its index. Throws InvalidInput for an unknown name.
    void remove(std::string_view name);
    /// Gives a body another motion. Throws InvalidInput as `add` does.
    void move(std::size_t index, const Motion& motion);

    [[nodiscard]] std::span<const SceneBody> bodies() const { return bodies_; }
    /// The index of a body. Throws InvalidInput "scene: NAME: is not in the scene".
    [[nodiscard]] std::size_t index_of(std::string_view name) const;

    /// The two bodies are never tested against each other. Throws InvalidInput for an unknown name, or one name twice.
    void ignore(std::string_view a, std::string_view b);
    /// No body of the one group is tested against one of the other; the same group twice: within the group.
    void ignore_groups(const std::string& a, const std::string& b);
    /// Ignores the pairs that touch, overlap or are within their margin at time 0, as the parts of a mounted assembly
    /// do, whether they move or not. Returns these pairs in the order of their names. Throws InvalidInput for a margin
    /// that is not in [0, 1e30].
    std::vector<std::pair<std::string, std::string>> ignore_touching_at_start(double margin = 0);
    /// What a question leaves out, with the names of pairs.
    [[nodiscard]] UntestedPairs untested(const SceneQuery& query = {}) const;

    /// The margin of two bodies in all questions, in the place of that of the question. Throws InvalidInput for an
    /// unknown name, for one name twice, and for a margin that is not in [0, 1e30].
    void set_margin(std::string_view a, std::string_view b, double margin);
    /// The margin of the bodies of one group and those of another one; the same group twice: within the group. A pair
    /// with a margin of its own keeps it.
    void set_group_margin(const std::string& a, const std::string& b, double margin);
    /// The distance that two bodies hold if they start within their margin, in the place of `hold` of the question. It
    /// counts if it is less than the margin. Throws InvalidInput as `set_margin` does.
    void set_hold(std::string_view a, std::string_view b, double hold);
    /// The distance that the bodies of two groups hold. A pair with a distance of its own keeps it.
    void set_group_hold(const std::string& a, const std::string& b, double hold);

    /// The earliest contact of all pairs. With Find::any: some contact, if there is any, not placed in time; the same
    /// one for any number of threads. Throws InvalidInput for an option out of its range.
    [[nodiscard]] SceneAnswer first_contact(const SceneQuery& query = {}) const;
    /// The first contact of each pair that touches.
    [[nodiscard]] SceneAnswer all_contacts(const SceneQuery& query = {}) const;
    /// The nearest pair, over the whole time; margins have no effect. At a Limit the bracket is that of what is known
    /// so far. Throws InvalidInput for an option out of its range, and if all pairs are farther apart than
    /// Pose::largest_length. Source: docs/derivations/27-scenes.md, "Nearest".
    [[nodiscard]] SceneDistance least_distance(const LeastDistanceOptions& options = {}) const;
    /// The least distance of each tested pair, over the whole time; margins have no effect. The same for any number of
    /// threads. At a Limit, pairs that were not searched have the distance of the boxes that they sweep and that of two
    /// points at the start, and are not certain. Throws InvalidInput for an option out of its range. Source:
    /// docs/derivations/27-scenes.md, "All pairs".
    [[nodiscard]] DistanceMatrix least_distances(const LeastDistanceOptions& options = {},
                                                 const BatchOptions& batch = {}) const;
    /// The distance of the nearest pair over the time; margins of the scene have no effect. At a Limit what is proven
    /// so far. Throws InvalidInput for an option out of its range. Source: docs/derivations/39-profile.md, "Many
    /// pairs".
    [[nodiscard]] SceneProfile profile(const ProfileOptions& options = {}) const;
    /// For each body the time until which it is proven clear of all others.
    [[nodiscard]] std::vector<double> clear_until(const SceneQuery& query = {}) const;

    /// For the library's own use: how a body moves in the world.
    [[nodiscard]] const scene::WorldMotion& motion_of(std::size_t index) const { return *placed_[index].motion; }
    [[nodiscard]] bool rests(std::size_t index) const { return placed_[index].rests; }
    [[nodiscard]] bool is_ignored(std::size_t a, std::size_t b) const;
    /// The margin of two bodies, and the least and the largest one of all pairs, where that of the question is given.
    [[nodiscard]] double margin_of(std::size_t a, std::size_t b, double of_question) const;
    [[nodiscard]] Bracket margins(double of_question) const;
    /// A question with the margin and the hold distance of two bodies.
    [[nodiscard]] QueryOptions options_of(std::size_t a, std::size_t b, const QueryOptions& of_question) const;

private:
    using Ids = std::pair<std::uint32_t, std::uint32_t>; ///< the smaller one first
    using Groups = std::pair<std::string, std::string>;  ///< in order of the alphabet
    struct Placed {
        std::shared_ptr<const scene::WorldMotion> motion;
        std::uint32_t id = 0; ///< bodies are counted as they are added
        bool rests = false;
    };
    class UntestedCount;
    [[nodiscard]] UntestedPairs numbers_of_untested(const SceneQuery& query) const;

    /// A number for some pairs and for some groups.
    struct Rules {
        std::map<Ids, double> of_pairs;
        std::map<Groups, double> of_groups;
    };

    [[nodiscard]] Ids ids_of(std::string_view a, std::string_view b, const char* what) const;
    /// The number of two bodies. A number for the pair counts before a number for the groups.
    [[nodiscard]] std::optional<double> rule_of(std::size_t a, std::size_t b, const Rules& rules) const;

    std::vector<SceneBody> bodies_;
    std::vector<Placed> placed_; ///< of each body
    std::uint32_t next_id_ = 0;
    std::map<std::string, std::size_t, std::less<>> by_name_;
    std::set<Ids> ignored_;
    std::set<Ids> touching_; ///< those of `ignored_` that touched at the start
    std::set<Groups> ignored_groups_;
    Rules margins_;
    Rules holds_;
};

} // namespace chasles
