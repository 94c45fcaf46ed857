// Certificates of the Panda among the obstacles of its planning problems, verified by the checker.
#include "chasles/certificate/certificate.h"
#include "tests/certificate/checked.h"
#include "tests/data/planning_scenes.h"
#include "tests/data/shared_data.h"

#include <gtest/gtest.h>
#include <map>

namespace chasles::test {
namespace {

/// A share of the straight way from the start of the problem to its goal, in so many segments.
JointPath path_of(const Robot& robot, const PlanningProblem& problem, double share, int segments) {
    std::vector<Configuration> knots;
    for (int k = 0; k <= segments; ++k)
        knots.push_back(problem.start + share * k / segments * (problem.goal - problem.start));
    return JointPath::straight(robot, knots);
}

TEST(CertifiedPanda, AmongItsObstaclesIsVerified) {
    CHASLES_REQUIRE_DATA("robots");
    const std::filesystem::path folder = shared_data("robots/panda/mbm-problems");
    const Robot panda =
        Robot::load(shared_data("robots/panda/panda.urdf"), {.srdf = shared_data("robots/panda/panda.srdf")});
    const std::vector<std::string> names = planning_problem_names(folder);
    const std::size_t step = std::getenv("CHASLES_LONG") ? 4 : 80;
    std::map<Verdict, int> count;
    std::size_t bytes = 0, planes = 0;
    for (std::size_t i = 0; i < names.size(); i += step) {
        const PlanningProblem problem = read_planning_problem(folder, names[i], panda);
        Robot robot = panda;
        for (const auto& [first, second] : problem.allowed)
            robot.ignore(first, second);
        const RobotChecker checker(robot, &problem.world);
        for (const auto& [share, segments] : {std::pair(0.05, 1), std::pair(1.0, 1), std::pair(0.2, 3)}) {
            const JointPath path = path_of(robot, problem, share, segments);
            const Verdict verdict = checker.first_contact(path).verdict;
            const Certificate proof = certify(checker, path);
            ASSERT_EQ(proof.missing, "") << names[i];
            const ::certificate::Verified verified = checked(proof);
            ASSERT_TRUE(verified.holds) << names[i] << ": " << verified.message;
            ++count[verdict];
            bytes = std::max(bytes, proof.text.size());
            planes += proof.planes;
        }
    }
    print_figures("%d clear, %d contacts, %d at the start; %zu planes, at most %zu bytes", count[Verdict::clear],
                  count[Verdict::contact], count[Verdict::contact_at_start], planes, bytes);
    EXPECT_GT(count[Verdict::clear], 3);
    EXPECT_GT(count[Verdict::contact], 3);
}

} // namespace
} // namespace chasles::test
