// Real robots along random edges and splines, against dense samples by FCL with kinematics by Eigen. Samples can only
// refute: nothing may overlap before the proven time, and just after a certain contact something has to.
// CHASLES_LONG=1 takes ten thousand edges, a tenth of them splines, and ten thousand samples of each.
#include "chasles/robot/robot.h"

#include "chasles/mesh/primitives.h"
#include "chasles/robot/pair_proof.h"
#include "tests/data/planning_scenes.h"
#include "tests/data/shared_data.h"
#include "tests/support/random.h"

#include <array>
#include <cstdlib>
#if CHASLES_TESTS_FCL
#include "bench/fcl_robot.h"
#endif

namespace chasles::test {
namespace {

using Eigen::Vector3d;

bool is_long() {
    return std::getenv("CHASLES_LONG") != nullptr;
}

Robot panda() {
    return Robot::load(shared_data("robots/panda/panda.urdf"), {.srdf = shared_data("robots/panda/panda.srdf")});
}
Robot irb2400() {
    return Robot::load(shared_data("robots/abb_irb2400/abb_irb2400.urdf"),
                       {.srdf = shared_data("robots/abb_irb2400/abb_irb2400.srdf")});
}
/// Its shapes overlap at the joints, and no file says which pairs are not meant: those that do so at the start are not
/// tested.
Robot laikago() {
    Robot robot = Robot::load(shared_data("robots/laikago/urdf/laikago.urdf"));
    while (true) {
        const RobotAnswer found = RobotChecker(robot).first_contact(robot.neutral(), robot.neutral());
        if (found.verdict == Verdict::clear)
            return robot;
        robot.ignore(found.pair->first, found.pair->second);
    }
}

TEST(Robots, RealFilesAreReadAsTheyAre) {
    CHASLES_REQUIRE_DATA("robots");
    EXPECT_EQ(panda().variables().size(), 7U);
    EXPECT_EQ(irb2400().variables().size(), 6U);
    EXPECT_EQ(laikago().variables().size(), 12U);
    EXPECT_FALSE(panda().is_tested("panda_link2", "panda_link6")) << "as the SRDF file says";
    EXPECT_EQ(panda().state("ready")[3], -2.356);
    const std::vector<std::string> names = planning_problem_names(shared_data("robots/panda/mbm-problems"));
    ASSERT_EQ(names.size(), 400U);
    const Robot robot = panda();
    std::size_t clear = 0;
    for (const std::string& name : names) {
        const PlanningProblem problem = read_planning_problem(shared_data("robots/panda/mbm-problems"), name, robot);
        const RobotChecker checker(robot, &problem.world);
        clear += checker.is_clear(problem.start) && checker.is_clear(problem.goal);
    }
    print_figures("start and goal are clear in %zu of 400 problems", clear);
    EXPECT_GT(clear, 380U) << "all are free by construction, but cylinders are a hundredth thicker";
}

#if CHASLES_TESTS_FCL

Configuration random_within_limits(Random& random, const Robot& robot) {
    Configuration values(Eigen::Index(robot.variables().size()));
    for (std::size_t i = 0; i < robot.variables().size(); ++i) {
        const RobotVariable& v = robot.variables()[i];
        values[Eigen::Index(i)] = random.uniform(std::max(v.lower, -3.0), std::min(v.upper, 3.0));
    }
    return values;
}

struct Figures {
    int clear = 0, contacts = 0, at_start = 0, uncertain = 0, confirmed = 0, wide = 0;
    double seconds = 0, slowest = 0;
};

/// A path of one segment over the stamps [0, 1].
void judge(const RobotChecker& checker, bench::FclRobot& peer, const JointPath& path, int samples, Figures& figures) {
    const Stopwatch watch;
    const RobotAnswer found = checker.first_contact(path);
    const double seconds = watch.seconds();
    figures.seconds += seconds;
    figures.slowest = std::max(figures.slowest, seconds);
    const double end = found.verdict == Verdict::clear ? 1 : found.time.lower;
    for (int k = 0; k <= samples; ++k)
        if (const double time = double(k) / samples; time < end || found.verdict == Verdict::clear) {
            ASSERT_FALSE(peer.collides(path.at(time)))
                << "at " << time << ", before " << end << ", " << (found.pair ? found.pair->first : "clear");
        }
    if (found.verdict == Verdict::clear) {
        ++figures.clear;
        return;
    }
    ++figures.contacts;
    figures.at_start += found.verdict == Verdict::contact_at_start;
    figures.uncertain += !found.certain;
    figures.wide += found.time.upper - found.time.lower > 1e-9;
    const bool touches = std::ranges::any_of(std::array{0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5}, [&](double hair) {
        return peer.collides(path.at(found.time.upper + hair));
    });
    figures.confirmed += touches;
}

void print(const char* name, const Figures& f) {
    print_figures(
        "%s: %d clear, %d touch (%d at the start), %d not certain, %d brackets wider than 1e-9; FCL sees %d of the "
        "contacts within 1e-5; %.3f ms an edge, slowest %.2f ms",
        name, f.clear, f.contacts, f.at_start, f.uncertain, f.wide, f.confirmed,
        1e3 * f.seconds / std::max(1, f.clear + f.contacts), 1e3 * f.slowest);
}

/// Edges that start free, and splines through three configurations near each other.
void judge_robot(const Robot& robot, const Scene& world, Random& random, int edges, Figures& figures) {
    const RobotChecker checker(robot, &world);
    bench::FclRobot peer(robot, world);
    const int samples = is_long() ? 10'000 : 300;
    for (int i = 0; i < edges; ++i) {
        Configuration start = random_within_limits(random, robot);
        for (int tries = 0; tries < 200 && !checker.is_clear(start); ++tries)
            start = random_within_limits(random, robot);
        Configuration way = random_within_limits(random, robot) - random_within_limits(random, robot);
        way *= random.uniform(0.1, 3) / way.lpNorm<1>();
        if (i % 10 != 0) {
            judge(checker, peer, JointPath::straight(robot, std::array<Configuration, 2>{start, start + way}), samples,
                  figures);
        } else {
            const std::array<Configuration, 2> ends{start, start + way};
            const std::array<Configuration, 2> rates{0.3 * (random_within_limits(random, robot) - start),
                                                     0.3 * (random_within_limits(random, robot) - start)};
            judge(checker, peer, JointPath::cubic(robot, std::array{0.0, 1.0}, ends, rates), samples, figures);
        }
        if (testing::Test::HasFatalFailure())
            return;
    }
}

void expect_good(const Figures& f) {
    EXPECT_GE(f.confirmed, f.contacts * 0.99);
    EXPECT_LE(f.uncertain, 1 + f.contacts / 100);
}

TEST(Robots, PandaAmongObstaclesAgreesWithDenseSamples) {
    CHASLES_REQUIRE_DATA("robots");
    Random random(2201);
    const Robot robot = panda();
    const std::vector<std::string> names = planning_problem_names(shared_data("robots/panda/mbm-problems"));
    Figures figures;
    for (std::size_t i = 3; i < names.size() && !HasFatalFailure(); i += is_long() ? 4 : 40) {
        const PlanningProblem problem =
            read_planning_problem(shared_data("robots/panda/mbm-problems"), names[i], robot);
        judge_robot(robot, problem.world, random, is_long() ? 60 : 15, figures);
    }
    print("panda", figures);
    expect_good(figures);
}

/// Boxes around the robot.
Scene boxes_around(Random& random, double near, double far, int count) {
    Scene world;
    for (int i = 0; i < count; ++i) {
        const Vector3d way(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.2, 1));
        const Vector3d place = random.uniform(near, far) * way.normalized();
        world.add(
            {"box " + std::to_string(i),
             make_box(Vector3d(random.uniform(0.1, 0.5), random.uniform(0.1, 0.5), random.uniform(0.1, 0.5)) * near),
             Motion::at_rest(Pose(place, Eigen::Quaterniond(random.uniform(-1, 1), random.uniform(-1, 1),
                                                            random.uniform(-1, 1), random.uniform(-1, 1))))});
    }
    return world;
}

TEST(Robots, Irb2400AndLaikagoAgreeWithDenseSamples) {
    CHASLES_REQUIRE_DATA("robots");
    Random random(2202);
    Figures irb, dog;
    for (int i = 0; i < (is_long() ? 40 : 4) && !HasFatalFailure(); ++i) {
        judge_robot(irb2400(), boxes_around(random, 0.7, 2, 15), random, is_long() ? 60 : 20, irb);
        judge_robot(laikago(), boxes_around(random, 0.35, 1, 15), random, is_long() ? 40 : 10, dog);
    }
    print("irb2400", irb);
    print("laikago", dog);
    expect_good(irb);
    expect_good(dog);
}

/// Each witness is confirmed by FCL, and no random configuration denies a proof. CHASLES_LONG=1 leaves no pair open.
TEST(Robots, PairsOfThePandaAreProven) {
    CHASLES_REQUIRE_DATA("robots");
    Random random(2203);
    const Robot robot = panda();
    const std::vector<PairProof> proofs = prove_pairs(robot, {.seconds = is_long() ? 600.0 : 5.0});
    const Scene empty;
    int never = 0, sometimes = 0, open = 0;
    for (const PairProof& proof : proofs) {
        Robot alone = robot; // tests this pair only
        for (const PairProof& other : proofs)
            alone.ignore(other.first, other.second);
        alone.test(proof.first, proof.second);
        bench::FclRobot peer(alone, empty);
        never += proof.reason == PairReason::never;
        sometimes += proof.reason == PairReason::sometimes;
        open += proof.reason == PairReason::open;
        const std::string pair = proof.first + " and " + proof.second;
        if (proof.witness) {
            EXPECT_TRUE(peer.collides(*proof.witness)) << pair;
        }
        for (int i = 0; i < (is_long() ? 5000 : 200) && proof.reason == PairReason::never; ++i)
            EXPECT_FALSE(peer.collides(random_within_limits(random, robot))) << pair;
        if (pair == "panda_link2 and panda_link6") {
            EXPECT_EQ(proof.reason, PairReason::sometimes) << "though every SRDF file lists it as Never";
        }
    }
    print_figures("%d pairs never touch, %d do sometimes, %d are open", never, sometimes, open);
    EXPECT_EQ(never + sometimes + open, 45);
    EXPECT_LE(sometimes, 22);
    EXPECT_GT(sometimes, 15) << "a slow machine finds fewer in its time";
    EXPECT_GT(never, 4) << "and proves fewer";
    if (is_long()) {
        EXPECT_EQ(sometimes, 22);
        EXPECT_EQ(open, 0);
    }
}

#endif

} // namespace
} // namespace chasles::test
