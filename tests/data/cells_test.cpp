// Two real robots in one cell, each on a clock of its own, against dense samples by FCL: each sample has the places of
// the links of each robot alone, by Eigen. CHASLES_LONG=1 takes 300 paths and 3000 samples of each.
#include "chasles/robot/robot.h"
#include "tests/data/shared_data.h"
#include "tests/support/random.h"

#include <algorithm>
#include <cstdlib>
#if CHASLES_TESTS_FCL
#include "bench/fcl_robot.h"
#endif

namespace chasles::test {
namespace {

#if CHASLES_TESTS_FCL

bool takes_all_paths() {
    return std::getenv("CHASLES_LONG") != nullptr;
}

Robot panda_at(const Pose& base) {
    Robot robot = Robot::load(shared_data("robots/panda/panda.urdf"), {.srdf = shared_data("robots/panda/panda.srdf")});
    robot.set_base(base);
    return robot;
}

/// Each robot alone, and both in one cell.
struct TwoPandas {
    Robot left = panda_at({});
    Robot right = panda_at(Pose({0.8, 0.1, 0}, {0, 0, 0, 1})); // it looks back
    Robot cell = Robot::together({{"left", left}, {"right", right}});
    RobotChecker of_left{left}, of_right{right}, of_cell{cell};
    bench::FclRobot peer_of_left{left, {}}, peer_of_right{right, {}}, peer{cell, {}};

    /// The links of both robots at a stamp, without the cell.
    bool collides(const JointPath& of_left, const JointPath& of_right, double stamp) {
        bench::FclRobot::Poses poses = peer_of_left.poses(of_left.at(stamp));
        const bench::FclRobot::Poses others = peer_of_right.poses(of_right.at(stamp));
        poses.insert(poses.end(), others.begin(), others.end());
        return peer.collides(poses);
    }
};

/// Through some configurations near the first one, which is clear, with stamps of its own; a spline now and then.
JointPath any_path(Random& random, const RobotChecker& checker) {
    const Robot& robot = checker.robot();
    const auto near = [&](const Configuration& middle, double most) {
        Configuration values = middle;
        for (std::size_t i = 0; i < robot.variables().size(); ++i) {
            const RobotVariable& v = robot.variables()[i];
            double& value = values[Eigen::Index(i)];
            value = std::clamp(value + random.uniform(-most, most), v.lower, v.upper);
        }
        return values;
    };
    Configuration start = near(robot.state("ready"), 0.8);
    while (!checker.is_clear(start))
        start = near(robot.state("ready"), 0.8);
    std::vector<Configuration> way{start};
    std::vector<double> stamps{random.uniform(0, 1)};
    for (int i = random.integer(1, 4); i > 0; --i) {
        way.push_back(near(way.back(), 0.6));
        stamps.push_back(stamps.back() + random.uniform(0.2, 1.5));
    }
    return random.chance(0.3) ? JointPath::natural_spline(robot, stamps, way) : JointPath::straight(robot, way, stamps);
}

/// The robot does not touch itself on most paths.
JointPath wandering(Random& random, const RobotChecker& checker) {
    const bool is_any = random.chance(0.2);
    while (true) {
        JointPath path = any_path(random, checker);
        if (is_any || checker.first_contact(path).verdict == Verdict::clear)
            return path;
    }
}

struct CellFigures {
    int clear = 0, between = 0, alone = 0, at_start = 0, uncertain = 0, confirmed = 0, wrong = 0;
    double seconds = 0, of_clear = 0, of_one = 0; ///< of all paths; of clear ones, and of one robot alone on these
};

void judge_cell(TwoPandas& two, const JointPath& left, const JointPath& right, CellFigures& figures) {
    const JointPath both = JointPath::together(two.cell, {{"left", left}, {"right", right}});
    const Stopwatch watch;
    const RobotAnswer found = two.of_cell.first_contact(both);
    const double seconds = watch.seconds();
    figures.seconds += seconds;
    const double begin = both.segments().front().begin, end = both.segments().back().end;
    const bool is_clear = found.verdict == Verdict::clear;
    const int samples = takes_all_paths() ? 3000 : 200;
    for (int k = 0; k <= samples; ++k) {
        const double stamp = begin + (end - begin) * k / samples;
        if ((is_clear || stamp < found.time.lower) && two.collides(left, right, stamp)) {
            ++figures.wrong;
            ADD_FAILURE() << "at " << stamp << ", before " << (is_clear ? end : found.time.lower);
            return;
        }
    }
    if (is_clear) {
        const Stopwatch watch_alone;
        EXPECT_EQ(two.of_left.first_contact(left).verdict, Verdict::clear);
        EXPECT_EQ(two.of_right.first_contact(right).verdict, Verdict::clear);
        figures.of_one += watch_alone.seconds() / 2;
        figures.of_clear += seconds;
        ++figures.clear;
        return;
    }
    (found.pair->first.substr(0, 4) == found.pair->second.substr(0, 4) ? figures.alone : figures.between) += 1;
    figures.at_start += found.verdict == Verdict::contact_at_start;
    figures.uncertain += !found.certain;
    figures.confirmed += std::ranges::any_of(std::array{0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5}, [&](double hair) {
        return two.collides(left, right, found.time.upper + hair);
    });
}

TEST(Cells, TwoPandasOnClocksOfTheirOwnAgreeWithDenseSamples) {
    CHASLES_REQUIRE_DATA("robots");
    Random random(4231);
    TwoPandas two;
    CellFigures f;
    const int paths = takes_all_paths() ? 300 : 30;
    for (int i = 0; i < paths; ++i)
        judge_cell(two, wandering(random, two.of_left), wandering(random, two.of_right), f);
    const int contacts = f.between + f.alone;
    print_figures(
        "%d wrong; %d clear, %d touch each other, %d themselves, %d at the start, %d not certain; FCL sees %d of "
        "the contacts within 1e-5; %.3f ms a path; where clear %.2f times one robot alone",
        f.wrong, f.clear, f.between, f.alone, f.at_start, f.uncertain, f.confirmed, 1e3 * f.seconds / paths,
        f.of_clear / f.of_one);
    EXPECT_EQ(f.wrong, 0);
    EXPECT_GT(f.between, paths / 20);
    EXPECT_GT(f.clear, paths / 10);
    EXPECT_GE(f.confirmed, contacts * 0.99 - 1);
    EXPECT_LE(f.uncertain, 1 + contacts / 100);
}

#endif

} // namespace
} // namespace chasles::test
