#include "scenes/metric_thread.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::scenes {
namespace {

// ISO 724 tabulates M16 x 2: pitch diameter 14.701, minor diameter 13.835.
TEST(MetricThread, HasTheTabulatedDiametersOfM16) {
    const MetricThread thread{16, 2};
    EXPECT_NEAR(2 * thread.pitch_radius(), 14.701, 5e-4);
    EXPECT_NEAR(2 * thread.root_radius(), 13.835, 5e-4);
}

TEST(MetricThread, HasFlanksOfSixtyDegreesAndFlatsOfAnEighthAndAQuarter) {
    const MetricThread thread{16, 2};
    const auto corners = thread.corners();
    EXPECT_DOUBLE_EQ(corners[1].axial - corners[0].axial, 2.0 / 8);
    EXPECT_DOUBLE_EQ(corners[3].axial - corners[2].axial, 2.0 / 4);
    const double run = corners[2].axial - corners[1].axial;
    const double rise = corners[1].radius - corners[2].radius;
    EXPECT_NEAR(2 * std::atan2(run, rise) * 180 / std::numbers::pi, 60, 1e-12);
    EXPECT_NEAR(run / rise, flank_slope(), 1e-15);
}

TEST(MetricThread, RadiusPassesThroughItsCornersAndRepeatsEveryPitch) {
    const MetricThread thread{12, 1.75};
    for (const ProfileCorner& corner : thread.corners()) {
        for (const int pitches : {-3, 0, 1}) {
            EXPECT_NEAR(thread.radius_at(corner.axial + pitches * thread.pitch), corner.radius, 1e-13);
        }
    }
    EXPECT_NEAR(thread.radius_at(thread.pitch / 4), thread.pitch_radius(), thread.triangle_height() / 8);
}

TEST(MetricThread, SectionAreaIsTheMeanOverAPitch) {
    const MetricThread thread{16, 2};
    const int samples = 16000; // a multiple of 16, so that no corner falls inside of a sample
    double sum = 0;
    for (int i = 0; i < samples; ++i)
        sum += std::pow(thread.radius_at(thread.pitch * (i + 0.5) / samples), 2);
    EXPECT_NEAR(thread.section_area(), std::numbers::pi * sum / samples, 1e-6);
}

} // namespace
} // namespace chasles::scenes
