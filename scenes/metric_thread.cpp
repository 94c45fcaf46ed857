#include "scenes/metric_thread.h"

#include <cmath>
#include <numbers>

namespace chasles::scenes {

namespace {

constexpr double crest_end = 1.0 / 16;  // pitches from the middle of the crest
constexpr double root_start = 6.0 / 16; // crest_end plus a flank of 5/16

// The mean of r^2 when r varies linearly from `a` to `b`.
double mean_square(double a, double b) {
    return (a * a + a * b + b * b) / 3;
}

} // namespace

double flank_slope() {
    return 1 / std::numbers::sqrt3;
}

double MetricThread::triangle_height() const {
    return std::numbers::sqrt3 / 2 * pitch;
}

double MetricThread::crest_radius() const {
    return major_diameter / 2;
}

double MetricThread::root_radius() const {
    return crest_radius() - 0.625 * triangle_height();
}

double MetricThread::pitch_radius() const {
    return crest_radius() - 0.375 * triangle_height();
}

std::array<ProfileCorner, 4> MetricThread::corners() const {
    return {{{crest_radius(), -crest_end * pitch},
             {crest_radius(), crest_end * pitch},
             {root_radius(), root_start * pitch},
             {root_radius(), (1 - root_start) * pitch}}};
}

double MetricThread::radius_at(double axial) const {
    const double from_crest = std::abs(std::remainder(axial, pitch)) / pitch;
    if (from_crest <= crest_end)
        return crest_radius();
    if (from_crest >= root_start)
        return root_radius();
    return std::lerp(crest_radius(), root_radius(), (from_crest - crest_end) / (root_start - crest_end));
}

double MetricThread::lead(double angle) const {
    return pitch * angle / (2 * std::numbers::pi);
}

double MetricThread::section_area() const {
    const double crest = 2 * crest_end;
    const double root = 1 - 2 * root_start;
    return std::numbers::pi * (crest * crest_radius() * crest_radius() + root * root_radius() * root_radius() +
                               (1 - crest - root) * mean_square(crest_radius(), root_radius()));
}

} // namespace chasles::scenes
