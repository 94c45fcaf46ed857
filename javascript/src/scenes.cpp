// Scenes. Names are in the bytes; the numbers hold motions and options.
#include "javascript/src/border.h"
#include "javascript/src/numbers_in.h"
#include "javascript/src/numbers_out.h"
#include "javascript/src/objects.h"

namespace chasles::javascript {

Handles<std::shared_ptr<Scene>>& scenes() {
    static Handles<std::shared_ptr<Scene>> held("scene");
    return held;
}

namespace {

/// The bytes as two texts, the first one of this size.
struct TwoTexts {
    std::string first;
    std::string second;
};
TwoTexts given_texts(std::uint32_t first_size) {
    const std::string_view bytes = given_bytes();
    const std::size_t size = std::min<std::size_t>(first_size, bytes.size());
    return {std::string(bytes.substr(0, size)), std::string(bytes.substr(size))};
}

Scene& scene_of(std::int32_t handle) {
    return *scenes().get(handle);
}

SceneQuery query_in() {
    NumbersIn in(given_numbers());
    SceneQuery query;
    query.options = options_in(in);
    query.until = in.number();
    return query;
}

/// How many pairs are tested, the counts of the others by reason, and the reason and the bodies of each named pair.
void write(Numbers& out, const Scene& scene, const UntestedPairs& untested) {
    out.insert(out.end(), {double(untested.tested), double(untested.counts.size())});
    for (const std::size_t count : untested.counts)
        out.push_back(double(count));
    out.push_back(double(untested.named.size()));
    for (const UntestedPair& pair : untested.named)
        out.insert(out.end(), {double(pair.reason), double(scene.index_of(pair.first)), double(scene.index_of(pair.second))});
}

/// The verdict, the time until which all is clear, and each contact with the indices of its bodies; the work, and what is
/// not tested, with names, which take time only where something is left out.
void write(Numbers& out, const Scene& scene, const SceneQuery& query, const SceneAnswer& found) {
    out.insert(out.end(), {double(found.verdict), found.clear_until, double(found.contacts.size())});
    for (const SceneContact& contact : found.contacts) {
        out.insert(out.end(), {double(contact.moving), double(contact.fixed)});
        javascript::write(out, contact.contact);
    }
    javascript::write(out, found.work);
    write(out, scene, found.untested.total() > 0 ? scene.untested(query) : found.untested);
}

enum class Question : std::uint8_t { first_contact, all_contacts, clear_until, least_distance, profile, least_distances };

/// A flag whether there is a pair, its bodies and its distance; and what is not tested.
void write_least_distance(Numbers& out, const Scene& scene) {
    NumbersIn in(given_numbers());
    const SceneDistance found = scene.least_distance(least_options_in(in));
    out.push_back(found.pair ? 1 : 0);
    if (found.pair) {
        out.insert(out.end(), {double(found.pair->first), double(found.pair->second)});
        javascript::write(out, found.nearest);
    }
    write(out, scene, scene.untested());
}

/// The bodies and the distance of each pair; and what is not tested.
void write_least_distances(Numbers& out, const Scene& scene) {
    NumbersIn in(given_numbers());
    const DistanceMatrix found = scene.least_distances(least_options_in(in));
    out.push_back(double(found.pairs.size()));
    for (const PairDistance& pair : found.pairs) {
        out.insert(out.end(), {double(pair.moving), double(pair.fixed)});
        javascript::write(out, pair.nearest);
    }
    write(out, scene, scene.untested());
}

/// The profile, the bodies of the pairs that it counts, and what is not tested.
void write_profile(Numbers& out, const Scene& scene) {
    NumbersIn in(given_numbers());
    const ProfileOptions options = profile_options_in(in);
    const SceneProfile found = scene.profile(options);
    javascript::write(out, found.distance, options.margins);
    out.push_back(double(found.pairs.size()));
    for (const auto& [moving, fixed] : found.pairs)
        out.insert(out.end(), {double(moving), double(fixed)});
    write(out, scene, scene.untested());
}

void answer_scene(Numbers& out, const Scene& scene, Question question) {
    if (question == Question::least_distance)
        return write_least_distance(out, scene);
    if (question == Question::least_distances)
        return write_least_distances(out, scene);
    if (question == Question::profile)
        return write_profile(out, scene);
    const SceneQuery query = query_in();
    switch (question) {
    case Question::first_contact:
        return write(out, scene, query, scene.first_contact(query));
    case Question::all_contacts:
        return write(out, scene, query, scene.all_contacts(query));
    default:
        break;
    }
    for (const double time : scene.clear_until(query))
        out.push_back(time);
}

/// All bodies at once, in their order. The scene changes only if all motions can be used.
void move_all(Scene& scene, NumbersIn& in) {
    const MotionRule rule = rule_in(in);
    const std::vector<Pose> starts = in.poses("starts"), goals = in.poses("goals");
    const std::size_t count = scene.bodies().size();
    if (starts.size() != count || goals.size() != count)
        throw InvalidInput("starts, goals: " + std::to_string(starts.size()) + " and " + std::to_string(goals.size()) +
                           " poses for " + std::to_string(count) + " bodies");
    std::vector<Motion> motions;
    for (std::size_t i = 0; i < count; ++i)
        motions.push_back(motion_between(rule, starts[i], goals[i]).motion);
    for (std::size_t i = 0; i < count; ++i)
        scene.move(i, motions[i]);
}

enum class Rule : std::uint8_t { ignore, ignore_groups, set_margin, set_group_margin, set_hold, set_group_hold };

void apply(Scene& scene, Rule rule, const TwoTexts& names, double distance) {
    switch (rule) {
    case Rule::ignore:
        return scene.ignore(names.first, names.second);
    case Rule::ignore_groups:
        return scene.ignore_groups(names.first, names.second);
    case Rule::set_margin:
        return scene.set_margin(names.first, names.second, distance);
    case Rule::set_group_margin:
        return scene.set_group_margin(names.first, names.second, distance);
    case Rule::set_hold:
        return scene.set_hold(names.first, names.second, distance);
    case Rule::set_group_hold:
        break;
    }
    scene.set_group_hold(names.first, names.second, distance);
}

} // namespace
} // namespace chasles::javascript

namespace js = chasles::javascript;

CHASLES_JAVASCRIPT(scene)() {
    return js::guarded([] { return js::scenes().add(std::make_shared<chasles::Scene>()); });
}

CHASLES_JAVASCRIPT(free_scene)(std::int32_t scene) {
    return js::guarded([&] { return js::scenes().free(scene), 0; });
}

/// Adds a body: its name and its group in the bytes, its motion in the numbers. Returns its index.
CHASLES_JAVASCRIPT(scene_add)(std::int32_t scene, std::int32_t body, std::uint32_t name_size) {
    return js::guarded([&] {
        js::TwoTexts texts = js::given_texts(name_size);
        js::NumbersIn in(js::given_numbers());
        chasles::SceneBody added{std::move(texts.first), js::bodies().get(body), js::world_motion_in(in),
                                 std::move(texts.second)};
        return js::scene_of(scene).add(std::move(added));
    });
}

/// Removes the body whose name is in the bytes. Returns the index that it had, which the last body takes.
CHASLES_JAVASCRIPT(scene_remove)(std::int32_t scene) {
    return js::guarded([&] {
        chasles::Scene& changed = js::scene_of(scene);
        const std::size_t index = changed.index_of(js::given_bytes());
        changed.remove(js::given_bytes());
        return index;
    });
}

/// Gives the body whose name is in the bytes the motion in the numbers. Returns its index.
CHASLES_JAVASCRIPT(scene_move)(std::int32_t scene) {
    return js::guarded([&] {
        chasles::Scene& changed = js::scene_of(scene);
        const std::size_t index = changed.index_of(js::given_bytes());
        js::NumbersIn in(js::given_numbers());
        changed.move(index, js::world_motion_in(in));
        return index;
    });
}

/// Gives all bodies the motions in the numbers: how they move, starts, and goals.
CHASLES_JAVASCRIPT(scene_move_all)(std::int32_t scene) {
    return js::guarded([&] {
        js::NumbersIn in(js::given_numbers());
        js::move_all(js::scene_of(scene), in);
        return 0;
    });
}

/// Answers with the pose of the body whose name is in the bytes, at the time in the numbers.
CHASLES_JAVASCRIPT(scene_pose)(std::int32_t scene) {
    return js::answered([&](js::Numbers& out) {
        const chasles::Scene& asked = js::scene_of(scene);
        js::NumbersIn in(js::given_numbers());
        js::write(out, asked.bodies()[asked.index_of(js::given_bytes())].motion.pose_at(in.time()));
    });
}

/// A rule for the two bodies or the two groups in the bytes.
CHASLES_JAVASCRIPT(scene_rule)(std::int32_t scene, std::int32_t rule, std::uint32_t first_size, double distance) {
    return js::guarded([&] {
        if (rule < 0 || rule > std::int32_t(js::Rule::set_group_hold))
            throw chasles::InvalidInput("scene: there is no such rule");
        js::apply(js::scene_of(scene), js::Rule(rule), js::given_texts(first_size), distance);
        return 0;
    });
}

/// Answers a question about a scene. The options are in the numbers.
CHASLES_JAVASCRIPT(scene_question)(std::int32_t scene, std::int32_t question) {
    return js::answered([&](js::Numbers& out) {
        if (question < 0 || question > std::int32_t(js::Question::least_distances))
            throw chasles::InvalidInput("scene: there is no such question");
        js::answer_scene(out, js::scene_of(scene), js::Question(question));
    });
}
