// The 400 planning problems of the Panda with OMPL's RRT-Connect: with motions that are proven, and with OMPL's own
// validator over FCL at its default of 1 %. How many of the paths that it returns touch something?
#include "bench/fcl_robot.h"
#include "chasles/ompl.h"
#include "tests/data/planning_scenes.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

namespace chasles::bench {
namespace {

namespace ob = ::ompl::base;
namespace og = ::ompl::geometric;

constexpr double longest = 10; ///< seconds for a problem

std::shared_ptr<ob::RealVectorStateSpace> space_of(const Robot& robot) {
    auto space = std::make_shared<ob::RealVectorStateSpace>(unsigned(robot.variables().size()));
    ob::RealVectorBounds bounds(space->getDimension());
    for (unsigned i = 0; i < space->getDimension(); ++i) {
        bounds.setLow(i, robot.variables()[i].lower);
        bounds.setHigh(i, robot.variables()[i].upper);
    }
    space->setBounds(bounds);
    return space;
}

/// The results of all problems with one validator.
struct Total {
    int solved = 0, touching = 0;
    std::size_t edges = 0, touching_edges = 0;
    std::vector<double> seconds = {};
};

/// Asks for each edge of a path whether it is proven clear.
void judge(Total& total, const og::PathGeometric& path, const RobotChecker& checker) {
    const ompl::StateMap map(checker.robot());
    const ob::StateSpace& space = *path.getSpaceInformation()->getStateSpace();
    const std::size_t before = total.touching_edges;
    for (unsigned i = 0; i + 1 < path.getStateCount(); ++i, ++total.edges)
        total.touching_edges += !checker.is_clear(map(space, path.getState(i)), map(space, path.getState(i + 1)));
    total.touching += total.touching_edges > before;
}

/// Plans, shortens the path as users do, and judges it.
template <class Prepare>
void plan(Total& total, const test::PlanningProblem& problem, const RobotChecker& checker, const Prepare& prepare) {
    og::SimpleSetup setup(space_of(checker.robot()));
    setup.getStateSpace()->setup();
    prepare(setup.getSpaceInformation());
    const auto state = [&](const Configuration& values) {
        ob::ScopedState<> made(setup.getStateSpace());
        setup.getStateSpace()->copyFromReals(made.get(), {values.begin(), values.end()});
        return made;
    };
    setup.setStartAndGoalStates(state(problem.start), state(problem.goal));
    setup.setPlanner(std::make_shared<og::RRTConnect>(setup.getSpaceInformation()));
    const auto start = std::chrono::steady_clock::now();
    const bool is_solved = setup.solve(longest) == ob::PlannerStatus::EXACT_SOLUTION;
    if (is_solved)
        setup.simplifySolution(1);
    total.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    total.solved += is_solved;
    if (is_solved)
        judge(total, setup.getSolutionPath(), checker);
}

void print(const char* name, Total total) {
    std::ranges::sort(total.seconds);
    double sum = 0;
    for (const double s : total.seconds)
        sum += s;
    std::printf("%-28s solved %d of %zu; median %.1f ms, mean %.1f ms; %d paths touch, %zu of %zu edges\n", name,
                total.solved, total.seconds.size(), 1e3 * total.seconds[total.seconds.size() / 2],
                1e3 * sum / double(total.seconds.size()), total.touching, total.touching_edges, total.edges);
}

int run() {
    const std::filesystem::path folder = std::filesystem::path(CHASLES_DATA_DIR) / "robots/panda";
    if (!std::filesystem::exists(folder)) {
        std::printf("skipped: no folder robots/panda of real inputs\n");
        return 0;
    }
    ::ompl::msg::setLogLevel(::ompl::msg::LOG_ERROR);
    ::ompl::RNG::setSeed(1);
    const Robot robot = Robot::load(folder / "panda.urdf", {.srdf = folder / "panda.srdf"});
    Total proven, sampled;
    for (const std::string& name : test::planning_problem_names(folder / "mbm-problems")) {
        const test::PlanningProblem problem = test::read_planning_problem(folder / "mbm-problems", name, robot);
        const RobotChecker checker(robot, &problem.world);
        FclRobot peer(robot, problem.world);
        plan(proven, problem, checker, [&](const ob::SpaceInformationPtr& information) {
            information->setStateValidityChecker(std::make_shared<ompl::RobotValidityChecker>(information, checker));
            information->setMotionValidator(std::make_shared<ompl::RobotMotionValidator>(information, checker));
        });
        plan(sampled, problem, checker, [&](const ob::SpaceInformationPtr& information) {
            information->setStateValidityChecker([&, space = information->getStateSpace()](const ob::State* state) {
                return !peer.collides(ompl::StateMap(robot)(*space, state));
            });
        });
    }
    print("proven", proven);
    print("OMPL's own, 1 %, FCL", sampled);
    return 0;
}

} // namespace
} // namespace chasles::bench

int main() {
    return chasles::bench::run();
}
