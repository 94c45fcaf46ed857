// The 2,036 mesh pairs of screw-known-answers with margins of a millionth, a thousandth and a tenth of the moving body,
// compared with the exact reference. The data have first contacts only without a margin.

#include "tests/attack/check_margin.h"
#include "tests/data/screw_known_answers.h"

namespace chasles::test {
namespace {

attack::MarginCase margin_case(const Json& one, double part) {
    attack::MarginCase posed;
    posed.mesh.moving = {vertices_of(one["moving"]), faces_of(one["moving"])};
    posed.mesh.fixed = {vertices_of(one["fixed"]), faces_of(one["fixed"])};
    posed.mesh.posed.moving_start = pose(one["start"]);
    posed.mesh.posed.moving_goal = pose(one["goal"]);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& v : posed.mesh.moving.vertices)
        box.extend(v);
    posed.margin = part * box.diagonal().norm();
    return posed;
}

TEST(MarginAnswers, EveryFirstTimeWithinAMarginIsInsideItsBracket) {
    CHASLES_REQUIRE_DATA("screw-known-answers");
    for (const double part : {1e-6, 1e-3, 1e-1}) {
        attack::Tally tally;
        for_each_known_answer([&](const Json& one) {
            const std::string wrong = attack::check(margin_case(one, part), tally);
            if (!wrong.empty())
                ADD_FAILURE() << "case " << one["id"] << ", margin " << part << " of the body: " << wrong;
        });
        EXPECT_EQ(tally.queries, 2036u);
        EXPECT_GT(tally.touches - tally.at_start, 400u);
        EXPECT_FALSE(tally.is_broken());
        print_figures("margin %g of the body: %llu cases, %llu contacts, %llu of them at the start, %llu not certain, "
                      "%llu other answers within the resolution, widest bracket %.2g, %.2f s; reference %.1f s",
                      part, static_cast<unsigned long long>(tally.queries),
                      static_cast<unsigned long long>(tally.touches), static_cast<unsigned long long>(tally.at_start),
                      static_cast<unsigned long long>(tally.uncertain), static_cast<unsigned long long>(tally.near),
                      tally.widest, tally.seconds, tally.reference_seconds);
    }
}

} // namespace
} // namespace chasles::test
