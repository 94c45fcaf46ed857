#include "python/src/recipe.h"

#include "chasles/base/invalid_input.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <unordered_map>

namespace chasles::python {
namespace {

[[noreturn]] void refuse(const std::string& why) {
    throw InvalidInput("state: is not that of a motion: " + why);
}

// --- The makers ---

Eigen::Vector3d point_of(const std::vector<double>& numbers) {
    if (numbers.size() != 3)
        refuse("a point has three numbers");
    return {numbers[0], numbers[1], numbers[2]};
}

std::vector<Eigen::Vector3d> points_of(const std::vector<double>& numbers) {
    if (numbers.size() % 3 != 0)
        refuse("points have three numbers each");
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
        points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return points;
}

std::vector<Pose> poses_of(const std::vector<double>& n) {
    if (n.size() % 7 != 0)
        refuse("poses have seven numbers each");
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < n.size(); i += 7)
        poses.emplace_back(Eigen::Vector3d(n[i], n[i + 1], n[i + 2]),
                           Eigen::Quaterniond(n[i + 3], n[i + 4], n[i + 5], n[i + 6]));
    return poses;
}

Pose pose_of(const std::vector<double>& numbers) {
    if (numbers.size() != 7)
        refuse("a pose has seven numbers");
    return poses_of(numbers).front();
}

double number_of(const std::vector<double>& numbers) {
    if (numbers.size() != 1)
        refuse("one number is needed");
    return numbers.front();
}

using Parts = std::vector<PlainMotion>;

struct Maker {
    std::string_view name;
    std::size_t numbers; ///< how many lists of numbers
    std::size_t parts;   ///< how many motions
    Motion (*make)(const Numbers& numbers, const Parts& parts);
};

constexpr std::array makers{
    Maker{"rest", 1, 0, [](const Numbers& n, const Parts&) { return Motion::at_rest(pose_of(n[0])); }},
    Maker{
        "velocity", 3, 0,
        [](const Numbers& n, const Parts&) { return Motion::velocity(pose_of(n[0]), pose_of(n[1]), point_of(n[2])); }},
    Maker{"twist", 2, 0, [](const Numbers& n, const Parts&) { return Motion::twist(pose_of(n[0]), pose_of(n[1])); }},
    Maker{"hinge", 3, 0,
          [](const Numbers& n, const Parts&) { return Motion::hinge(point_of(n[0]), point_of(n[1]), n[2]); }},
    Maker{"slider", 2, 0, [](const Numbers& n, const Parts&) { return Motion::slider(point_of(n[0]), n[1]); }},
    Maker{"polynomial", 1, 0, [](const Numbers& n, const Parts&) { return Motion::polynomial(points_of(n[0])); }},
    Maker{"spline", 2, 0, [](const Numbers& n, const Parts&) { return Motion::spline(n[0], poses_of(n[1])); }},
    Maker{"b spline", 1, 0, [](const Numbers& n, const Parts&) { return Motion::b_spline(poses_of(n[0])); }},
    Maker{"track", 4, 0, [](const Numbers& n, const Parts&) -> Motion { return track_of(n); }},
    Maker{"product", 0, 2, [](const Numbers&, const Parts& p) { return p[0].motion * p[1].motion; }},
    Maker{"relative", 0, 2, [](const Numbers&, const Parts& p) { return relative(p[0].motion, p[1].motion); }},
    Maker{"reversed", 0, 1, [](const Numbers&, const Parts& p) { return p[0].motion.reversed(); }},
    Maker{"rest of", 1, 1, [](const Numbers& n, const Parts& p) { return rest_of(p[0].motion, number_of(n[0])); }},
};

} // namespace

TimedPoses track_of(const Numbers& numbers) {
    const bool is_twist = number_of(numbers[2]) == 1;
    return TimedPoses::through(numbers[0], poses_of(numbers[1]),
                               is_twist ? TimedPoses::Between::twist : TimedPoses::Between::velocity,
                               point_of(numbers[3]));
}

PlainMotion made(std::string_view maker, Numbers numbers, const Parts& parts) {
    const auto* const found = std::ranges::find(makers, maker, &Maker::name);
    if (found == makers.end() || numbers.size() != found->numbers || parts.size() != found->parts)
        refuse(fmt::format("{:?} with {} lists of numbers and {} motions", maker, numbers.size(), parts.size()));
    PlainMotion motion{found->make(numbers, parts)};
    const auto recipe = std::make_shared<Recipe>(found->name, std::move(numbers));
    for (const PlainMotion& part : parts) {
        recipe->parts.push_back(part.recipe);
        motion.owners = joined(std::move(motion.owners), part.owners);
    }
    motion.recipe = recipe;
    return motion;
}

Recipe::~Recipe() {
    auto unused = std::move(parts);
    while (!unused.empty()) {
        const std::shared_ptr<const Recipe> last = std::move(unused.back());
        unused.pop_back();
        if (last.use_count() > 1)
            continue;
        for (auto& part : last->parts)
            unused.push_back(std::move(part));
        last->parts.clear();
    }
}

// --- Lists of numbers ---

std::vector<double> listed(std::span<const Pose> poses) {
    std::vector<double> numbers;
    for (const Pose& pose : poses) {
        const auto& t = pose.translation;
        const auto& q = pose.rotation;
        numbers.insert(numbers.end(), {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()});
    }
    return numbers;
}

std::vector<double> listed(const Pose& pose) {
    return listed(std::span(&pose, 1));
}

std::vector<double> listed(std::span<const Eigen::Vector3d> points) {
    std::vector<double> numbers;
    for (const Eigen::Vector3d& point : points)
        numbers.insert(numbers.end(), point.begin(), point.end());
    return numbers;
}

std::vector<double> listed(const Eigen::Vector3d& point) {
    return listed(std::span(&point, 1));
}

// --- The steps ---

namespace {

/// Recipes in an order in which each one comes after its parts. Parts that several recipes share come once.
class InOrder {
public:
    explicit InOrder(const Recipe& last) {
        std::vector<const Recipe*> waiting{&last};
        while (!waiting.empty()) {
            const Recipe* const recipe = waiting.back();
            const std::size_t before = waiting.size();
            for (auto part = recipe->parts.rbegin(); part != recipe->parts.rend(); ++part)
                if (!index_.contains(part->get()))
                    waiting.push_back(part->get());
            if (waiting.size() > before)
                continue;
            waiting.pop_back();
            if (index_.emplace(recipe, recipes_.size()).second)
                recipes_.push_back(recipe);
        }
    }
    [[nodiscard]] const std::vector<const Recipe*>& recipes() const { return recipes_; }
    [[nodiscard]] std::size_t index_of(const Recipe* recipe) const { return index_.at(recipe); }

private:
    std::vector<const Recipe*> recipes_;
    std::unordered_map<const Recipe*, std::size_t> index_;
};

nb::tuple step_of(const Recipe& recipe, const InOrder& order, const Owners& owners) {
    if (recipe.maker == Recipe::own_maker)
        return nb::make_tuple(Recipe::own_maker.data(), nb::cast(own_motion(recipe, owners)));
    nb::list numbers, parts;
    for (const std::vector<double>& list : recipe.numbers)
        numbers.append(array_of(std::span(list), {list.size()}));
    for (const auto& part : recipe.parts)
        parts.append(order.index_of(part.get()));
    return nb::make_tuple(std::string(recipe.maker), nb::tuple(numbers), nb::tuple(parts));
}

template <class Value>
Value value_of(nb::handle item, const char* what) {
    Value value{};
    if (!nb::try_cast(item, value))
        refuse(std::string("not ") + what);
    return value;
}

/// A step that was read.
struct Step {
    std::string maker;
    Numbers numbers = {};
    std::vector<std::size_t> parts = {};
    std::optional<PlainMotion> own = {}; ///< a trajectory of the user's own
};

Step read_step(nb::handle item, std::size_t index) {
    const auto parts = value_of<nb::tuple>(item, "a list of steps");
    if (parts.size() < 2 || parts.size() > 3)
        refuse("a step has two or three parts");
    Step step{value_of<std::string>(parts[0], "a name")};
    if (parts.size() == 2) {
        step.own = as_plain(given_motion(parts[1]));
        if (!step.own->recipe)
            refuse("a screw or a sweep is no part of it");
        return step;
    }
    for (const nb::handle list : value_of<nb::tuple>(parts[1], "lists of numbers")) {
        const DoubleArray array(list, "state");
        step.numbers.emplace_back(array.numbers().begin(), array.numbers().end());
    }
    step.parts = value_of<std::vector<std::size_t>>(parts[2], "a list of steps");
    if (std::ranges::any_of(step.parts, [&](std::size_t part) { return part >= index; }))
        refuse("a step needs a later one");
    return step;
}

} // namespace

nb::tuple state_of(const PlainMotion& motion) {
    if (!motion.recipe)
        throw nb::type_error("cannot pickle this motion");
    const InOrder order(*motion.recipe);
    nb::list steps;
    for (const Recipe* const recipe : order.recipes())
        steps.append(step_of(*recipe, order, motion.owners));
    return nb::tuple(steps);
}

PlainMotion motion_of_state(const nb::tuple& state) {
    Parts motions; // one a step
    for (const nb::handle item : state) {
        Step step = read_step(item, motions.size());
        if (step.own) {
            motions.push_back(*std::move(step.own));
            continue;
        }
        Parts parts;
        for (const std::size_t part : step.parts)
            parts.push_back(motions[part]);
        motions.push_back(made(step.maker, std::move(step.numbers), parts));
    }
    if (motions.empty())
        refuse("it has no steps");
    return motions.back();
}

} // namespace chasles::python
