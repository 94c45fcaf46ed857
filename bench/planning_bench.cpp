// The 400 planning problems of the Panda with OMPL's RRT-Connect: with motions that are proven, and with OMPL's own
// validator over FCL at its default of 1 %, and at 0.1 %. How many of the paths that they return touch something, and
// where does the time go? `planning_bench FOLDER [STRIDE]` writes problems.csv, paths.csv and
// edges.csv: times, the paths, and some of the edges that the planner asked for; with a stride, each STRIDE-th
// problem is planned. All times are of the processor.
#include "bench/counted_validators.h"
#include "bench/fcl_robot.h"
#include "bench/timings.h"
#include "chasles/ompl.h"
#include "tests/data/planning_scenes.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

namespace chasles::bench {
namespace {

namespace ob = ::ompl::base;
namespace og = ::ompl::geometric;

constexpr double longest = 10; ///< seconds of the processor for a problem

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

/// One problem with one validator.
struct Outcome {
    bool is_solved = false;
    double planning = 0, shortening = 0; ///< seconds
    std::size_t edges = 0, touching_edges = 0;
    AskedQuestions asked = {};
    std::vector<std::vector<double>> path = {};

    [[nodiscard]] double seconds() const { return planning + shortening; }
};

/// Asks for each edge of a path whether it is proven clear.
void judge(Outcome& outcome, const og::PathGeometric& path, const RobotChecker& checker) {
    const ompl::StateMap map(checker.robot());
    const ob::StateSpace& space = *path.getSpaceInformation()->getStateSpace();
    for (unsigned i = 0; i + 1 < path.getStateCount(); ++i, ++outcome.edges)
        outcome.touching_edges += !checker.is_clear(map(space, path.getState(i)), map(space, path.getState(i + 1)));
}

std::vector<std::vector<double>> rows_of(const og::PathGeometric& path) {
    std::vector<std::vector<double>> rows(path.getStateCount());
    for (unsigned i = 0; i < path.getStateCount(); ++i)
        path.getSpaceInformation()->getStateSpace()->copyToReals(rows[i], path.getState(i));
    return rows;
}

double seconds_of(const std::function<void()>& work) {
    const double start = processor_seconds();
    work();
    return processor_seconds() - start;
}

/// After so many seconds of the processor.
ob::PlannerTerminationCondition after(double seconds) {
    return ob::PlannerTerminationCondition([end = processor_seconds() + seconds] { return processor_seconds() > end; });
}

using Validators = std::pair<std::shared_ptr<ob::StateValidityChecker>, std::shared_ptr<ob::MotionValidator>>;

/// Plans, shortens the path as users do, and judges it.
Outcome plan(const test::PlanningProblem& problem, const RobotChecker& checker,
             const std::function<Validators(const ob::SpaceInformationPtr&)>& validators) {
    Outcome outcome;
    og::SimpleSetup setup(space_of(checker.robot()));
    setup.getStateSpace()->setup();
    const ob::SpaceInformationPtr& information = setup.getSpaceInformation();
    const auto [states, motions] = validators(information);
    information->setStateValidityChecker(std::make_shared<CountedStates>(information, states, outcome.asked));
    information->setMotionValidator(std::make_shared<CountedMotions>(information, motions, outcome.asked));
    const auto state = [&](const Configuration& values) {
        ob::ScopedState<> made(setup.getStateSpace());
        setup.getStateSpace()->copyFromReals(made.get(), {values.begin(), values.end()});
        return made;
    };
    setup.setStartAndGoalStates(state(problem.start), state(problem.goal));
    setup.setPlanner(std::make_shared<og::RRTConnect>(information));
    outcome.planning =
        seconds_of([&] { outcome.is_solved = setup.solve(after(longest)) == ob::PlannerStatus::EXACT_SOLUTION; });
    if (outcome.is_solved) {
        outcome.shortening = seconds_of([&] { setup.simplifySolution(after(1)); });
        judge(outcome, setup.getSolutionPath(), checker);
        outcome.path = rows_of(setup.getSolutionPath());
    }
    return outcome;
}

/// A state checker of FCL.
class FclStates : public ob::StateValidityChecker {
public:
    FclStates(const ob::SpaceInformationPtr& information, FclRobot& peer, const Robot& robot)
        : StateValidityChecker(information), peer_(peer), map_(robot) {}
    bool isValid(const ob::State* state) const override {
        return si_->satisfiesBounds(state) && !peer_.collides(map_(*si_->getStateSpace(), state));
    }

private:
    FclRobot& peer_;
    ompl::StateMap map_;
};

/// OMPL's own validator over FCL; `part` is the distance between samples, of the largest distance in the space.
Validators sampled(const ob::SpaceInformationPtr& information, FclRobot& peer, const Robot& robot, double part) {
    information->setStateValidityCheckingResolution(part);
    return {std::make_shared<FclStates>(information, peer, robot),
            std::make_shared<ob::DiscreteMotionValidator>(information)};
}

Validators proven(const ob::SpaceInformationPtr& information, const RobotChecker& checker) {
    return {std::make_shared<ompl::RobotValidityChecker>(information, checker),
            std::make_shared<ompl::RobotMotionValidator>(information, checker)};
}

void print(const char* label, const Questions& questions, std::size_t problems) {
    std::printf("  %-24s %9.0f a problem, %5.1f %% refused, %7.1f us each, %6.1f ms a problem\n", label,
                double(questions.count) / double(problems),
                100 * double(questions.refused) / double(std::max<std::size_t>(1, questions.count)),
                1e6 * questions.seconds / double(std::max<std::size_t>(1, questions.count)),
                1e3 * questions.seconds / double(problems));
}

double mean(const std::vector<Outcome>& outcomes, const std::function<double(const Outcome&)>& value) {
    double sum = 0;
    for (const Outcome& outcome : outcomes)
        sum += value(outcome);
    return sum / double(outcomes.size());
}

void print(const char* name, const std::vector<Outcome>& outcomes) {
    std::vector<double> seconds;
    std::size_t solved = 0, edges = 0, touching = 0, touching_edges = 0;
    AskedQuestions asked;
    for (const Outcome& outcome : outcomes) {
        seconds.push_back(outcome.seconds());
        solved += outcome.is_solved;
        edges += outcome.edges;
        touching += outcome.touching_edges > 0;
        touching_edges += outcome.touching_edges;
        asked.states += outcome.asked.states;
        asked.motions += outcome.asked.motions;
        asked.motions_with_last += outcome.asked.motions_with_last;
    }
    std::printf(
        "%s: solved %zu of %zu; median %.1f ms, 90 %% %.1f ms, mean %.1f ms (planning %.1f ms, shortening %.1f ms)\n",
        name, solved, outcomes.size(), 1e3 * quantile(seconds, 0.5), 1e3 * quantile(seconds, 0.9),
        1e3 * mean(outcomes, &Outcome::seconds), 1e3 * mean(outcomes, [](const Outcome& o) { return o.planning; }),
        1e3 * mean(outcomes, [](const Outcome& o) { return o.shortening; }));
    std::printf("  %zu paths touch, by %zu of %zu edges\n", touching, touching_edges, edges);
    print("states", asked.states, outcomes.size());
    print("motions", asked.motions, outcomes.size());
    print("motions with last state", asked.motions_with_last, outcomes.size());
}

struct Planned {
    std::string problem, validator;
    Outcome outcome;
};

void write_rows(std::ostream& file, const std::string& head, const std::vector<std::vector<double>>& rows) {
    file.precision(17);
    for (const std::vector<double>& row : rows) {
        file << head;
        for (const double value : row)
            file << ',' << value;
        file << '\n';
    }
}

void write(const std::filesystem::path& folder, const std::vector<Planned>& all) {
    std::ofstream problems(folder / "problems.csv"), paths(folder / "paths.csv"), edges(folder / "edges.csv");
    problems << "problem,validator,is_solved,planning,shortening,edges,touching_edges,states,state_seconds,motions,"
                "motion_seconds,with_last,with_last_seconds\n";
    for (const auto& [problem, validator, outcome] : all) {
        const AskedQuestions& asked = outcome.asked;
        problems << problem << ',' << validator << ',' << outcome.is_solved << ',' << outcome.planning << ','
                 << outcome.shortening << ',' << outcome.edges << ',' << outcome.touching_edges << ','
                 << asked.states.count << ',' << asked.states.seconds << ',' << asked.motions.count << ','
                 << asked.motions.seconds << ',' << asked.motions_with_last.count << ','
                 << asked.motions_with_last.seconds << '\n';
        const std::string head = problem + "," + validator;
        write_rows(paths, head, outcome.path);
        write_rows(edges, head, asked.kept);
    }
}

int run(const char* out, std::size_t stride) {
    const std::filesystem::path folder = std::filesystem::path(CHASLES_DATA_DIR) / "robots/panda";
    if (!std::filesystem::exists(folder)) {
        std::printf("skipped: no folder robots/panda of real inputs\n");
        return 0;
    }
    if (out && !std::filesystem::is_directory(out)) {
        std::fprintf(stderr, "%s: is no folder\n", out);
        return 1;
    }
    ::ompl::msg::setLogLevel(::ompl::msg::LOG_ERROR);
    ::ompl::RNG::setSeed(1);
    const Robot robot = Robot::load(folder / "panda.urdf", {.srdf = folder / "panda.srdf"});
    constexpr std::array names{"proven", "OMPL's own at 1 % over FCL", "OMPL's own at 0.1 % over FCL"};
    std::array<std::vector<Outcome>, names.size()> outcomes;
    std::vector<Planned> all;
    const std::vector<std::string> problems = test::planning_problem_names(folder / "mbm-problems");
    for (std::size_t p = 0; p < problems.size(); p += stride) {
        const std::string& name = problems[p];
        const test::PlanningProblem problem = test::read_planning_problem(folder / "mbm-problems", name, robot);
        const RobotChecker checker(robot, &problem.world);
        FclRobot peer(robot, problem.world);
        for (std::size_t v = 0; v < names.size(); ++v) {
            outcomes[v].push_back(plan(problem, checker, [&](const ob::SpaceInformationPtr& information) {
                return v == 0 ? proven(information, checker) : sampled(information, peer, robot, v == 1 ? 0.01 : 0.001);
            }));
            all.push_back({name, names[v], outcomes[v].back()});
        }
    }
    for (std::size_t v = 0; v < names.size(); ++v)
        print(names[v], outcomes[v]);
    if (out)
        write(out, all);
    return 0;
}

} // namespace
} // namespace chasles::bench

int main(int argument_count, char** arguments) {
    return chasles::bench::run(argument_count > 1 ? arguments[1] : nullptr,
                               argument_count > 2 ? std::max(1ul, std::strtoul(arguments[2], nullptr, 10)) : 1);
}
