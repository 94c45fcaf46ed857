// Steps of bodies that turn, follow tracks and get new motions, against distances by all pairs of triangles.
#include "chasles/motion/timed_poses.h"
#include "chasles/scene/stepper.h"
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>
#include <set>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using IndexPair = std::pair<std::size_t, std::size_t>;

constexpr double margin = 0.02;
constexpr double reach = 0.15;

/// Of a body that moves through a world of this size and is where `start` says.
Motion motion_from(Random& random, const Pose& start, double size) {
    const Vector3d target = random_point(random, size);
    const Pose turned = random_goal(random, start, random.uniform(0, 2), 0);
    const Pose goal(target, turned.rotation);
    switch (random.integer(0, 4)) {
    case 0:
        return Motion::velocity(start, Pose(target, start.rotation));
    case 1:
        return Motion::twist(start, goal);
    case 2:
        return TimedPoses::through({0, random.uniform(0.1, 0.9), 1}, {start, random_goal(random, start, 1, 2), goal});
    case 3: { // on an arc through the world
        const Vector3d axis = random_point(random, 1);
        return Motion::hinge(random_point(random, 1), axis, {0, 1, random.uniform(-1, 1)}) * Motion::at_rest(start);
    }
    default:
        return Motion::velocity(start, goal, random_point(random, 0.5));
    }
}

/// A step of a scene, with the motions that its bodies were given.
class Watched {
public:
    explicit Watched(Random& random) : random_(random) {
        std::mt19937 shapes(unsigned(random.integer(0, 1 << 30)));
        const int count = random.integer(4, 20);
        size_ = 1.2 * std::cbrt(count);
        for (int i = 0; i < count; ++i) {
            const Vector3d cell(i % 3, i / 3 % 3, i / 9);
            Pose start = random_pose(random, 0.05);
            start.translation += 2.7 * (cell - Vector3d::Ones());
            const bool rests = random.chance(0.2);
            const Motion motion = rests ? Motion::at_rest(start) : motion_from(random, start, size_);
            scene_.add({"body " + std::to_string((i * 7) % 31), random_octahedron(shapes).polyhedron(), motion,
                        random.chance(0.2) ? "ghosts" : ""});
            courses_.push_back({motion, 0});
            resting_.push_back(rests);
        }
        scene_.ignore_groups("ghosts", "ghosts");
        if (random.chance(0.5))
            set_margins();
        stepper_.emplace(scene_, StepOptions{.margin = margin, .reach = reach, .threads = 2});
    }

    /// False at the end of the step.
    bool goes_on() {
        const double before = stepper_->time();
        const std::map<IndexPair, double> levels = levels_now();
        const std::optional<StepEvent> event = stepper_->advance();
        EXPECT_GE(stepper_->time(), before);
        for (int k = 1; k <= 12; ++k) {
            const double time = before + (stepper_->time() - before) * k / 12;
            for (const auto& [pair, level] : levels)
                EXPECT_GE(distance(pair, time), level * (1 - 1e-6)) << name(pair) << " at " << time;
        }
        if (event)
            check(*event);
        return event.has_value();
    }
    /// Bodies that have met part, and sometimes another body changes its motion, too.
    void part(const StepEvent& event) {
        for (const SceneContact& pair : event.contacts)
            for (const auto& [body, other] : {IndexPair(pair.moving, pair.fixed), IndexPair(pair.fixed, pair.moving)})
                if (!resting_[body] && random_.chance(0.8))
                    move_away(body, other);
        const auto any = std::size_t(random_.integer(0, int(courses_.size()) - 1));
        if (random_.chance(0.5))
            move(any, random_.chance(0.3) ? Motion::at_rest(stepper_->pose(any))
                                          : motion_from(random_, stepper_->pose(any), size_));
    }
    [[nodiscard]] const std::optional<StepEvent>& last() const { return last_; }

private:
    struct Course {
        Motion motion;
        double since;
    };

    /// Some pairs have margins of their own, and so have ghosts with other bodies.
    void set_margins() {
        for (std::size_t a = 0; a < courses_.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                if (is_ghost(a) != is_ghost(b))
                    margins_[{a, b}] = 0.07;
                else if (random_.chance(0.3))
                    margins_[{a, b}] = random_.uniform(0.005, 0.1);
        scene_.set_group_margin("ghosts", "", 0.07);
        for (const auto& [pair, own] : margins_)
            if (is_ghost(pair.first) == is_ghost(pair.second))
                scene_.set_margin(scene_.bodies()[pair.second].name, scene_.bodies()[pair.first].name, own);
    }
    [[nodiscard]] bool is_ghost(std::size_t body) const { return scene_.bodies()[body].group == "ghosts"; }
    [[nodiscard]] double margin_of(std::size_t a, std::size_t b) const {
        const auto own = margins_.find({std::max(a, b), std::min(a, b)});
        return own == margins_.end() ? margin : own->second;
    }
    void move(std::size_t body, const Motion& motion) {
        stepper_->move(body, motion);
        courses_[body] = {motion, stepper_->time()};
    }
    void move_away(std::size_t body, std::size_t from) {
        const Pose now = stepper_->pose(body);
        const Vector3d way =
            (now.translation - stepper_->pose(from).translation).normalized() * random_.uniform(0.5, 3);
        const Pose goal(now.translation + way, random_goal(random_, now, random_.uniform(0, 1), 0).rotation);
        move(body, Motion::velocity(now, goal));
    }

    [[nodiscard]] Eigen::Isometry3d place(std::size_t body, double time) const {
        const auto& [motion, since] = courses_[body];
        return motion.pose_at((time - since) / (1 - since)).isometry();
    }
    [[nodiscard]] double distance(const IndexPair& pair, double time) const {
        const auto [a, b] = pair;
        const Eigen::Isometry3d at = place(a, time), other = place(b, time);
        if ((at.translation() - other.translation()).norm() > 3) // all bodies are within 1.3 of their origins
            return 1;
        return distance_at(scene_.bodies()[a].shape, scene_.bodies()[b].shape,
                           Pose(Eigen::Isometry3d(other.inverse() * at)));
    }
    [[nodiscard]] std::string name(const IndexPair& pair) const {
        return scene_.bodies()[pair.first].name + " and " + scene_.bodies()[pair.second].name;
    }
    [[nodiscard]] bool is_tested(std::size_t a, std::size_t b) const { return a != b && !(is_ghost(a) && is_ghost(b)); }
    [[nodiscard]] bool rests(std::size_t body) const {
        return place(body, 1).matrix() == place(body, courses_[body].since).matrix() &&
               place(body, 1).matrix() == place(body, 0.5 * (1 + courses_[body].since)).matrix();
    }

    /// What no pair may fall short of until the next event.
    std::map<IndexPair, double> levels_now() {
        std::map<IndexPair, double> levels;
        for (std::size_t a = 0; a < courses_.size(); ++a)
            for (std::size_t b = 0; b < a; ++b) {
                if (!is_tested(a, b) || (rests(a) && rests(b)))
                    continue;
                double& least = least_.try_emplace({a, b}, 1).first->second; // at all events so far
                least = std::min(least, distance({a, b}, stepper_->time()));
                levels[{a, b}] = std::min(margin_of(a, b), 0.49 * least);
            }
        return levels;
    }

    void check(const StepEvent& event) {
        last_ = event;
        EXPECT_EQ(event.time, stepper_->time());
        std::set<IndexPair> told;
        std::set<std::size_t> reached;
        for (const SceneContact& pair : event.contacts) {
            told.insert(std::minmax(pair.moving, pair.fixed));
            reached.insert({pair.moving, pair.fixed});
            EXPECT_TRUE(is_tested(pair.moving, pair.fixed));
            const double gap = distance({pair.moving, pair.fixed}, event.time);
            const double level = std::log2(margin_of(pair.moving, pair.fixed) / gap);
            EXPECT_NEAR(level, std::round(level), 1e-5) << name({pair.moving, pair.fixed});
            EXPECT_GE(level, -1e-5);
        }
        for (const SceneContact& pair : event.connected)
            EXPECT_TRUE(told.insert(std::minmax(pair.moving, pair.fixed)).second) << "it is told twice";
        std::set<IndexPair> expected;
        for (bool goes_on = true; goes_on;) { // from body to body that moves
            goes_on = false;
            for (const std::size_t a : std::set<std::size_t>(reached))
                for (std::size_t b = 0; b < courses_.size(); ++b)
                    if (is_tested(a, b) && !rests(a) && distance({a, b}, event.time) <= reach &&
                        expected.insert(std::minmax(a, b)).second) {
                        reached.insert(b);
                        goes_on = true;
                    }
        }
        EXPECT_EQ(told, expected);
    }

    Random& random_;
    Scene scene_;
    std::map<IndexPair, double> margins_; ///< of pairs that have their own, the larger index first
    double size_ = 0;
    std::vector<Course> courses_;
    std::vector<bool> resting_;
    std::map<IndexPair, double> least_;
    std::optional<Stepper> stepper_;
    std::optional<StepEvent> last_;
};

TEST(Stepper, OfRandomMotionsTellsAllThatMeet) {
    Random random(2811);
    int events = 0;
    for (int trial = 0; trial < 40; ++trial) {
        SCOPED_TRACE(trial);
        Watched step(random);
        for (int i = 0; i < 15 && step.goes_on(); ++i, ++events)
            step.part(*step.last());
        if (HasFailure())
            break;
    }
    std::cout << events << " events\n";
    EXPECT_GT(events, 150);
}

} // namespace
} // namespace chasles::test
