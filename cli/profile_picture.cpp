#include "cli/profile_picture.h"

#include "cli/svg.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace chasles::cli {
namespace {

// In pixels.
constexpr double picture_width = 720;
constexpr double picture_height = 360;
constexpr double left_of_axes = 80;
constexpr double right_of_axes = 20;
constexpr double above_axes = 20;
constexpr double below_axes = 45;

/// The part of a plane with some times and the distances from 0 on.
class Frame {
public:
    Frame(const Bracket& times, double greatest) : times_(times), greatest_(greatest > 0 ? greatest : 1) {}

    [[nodiscard]] double x(double time) const {
        return left_of_axes + (time - times_.lower) / duration() * (picture_width - left_of_axes - right_of_axes);
    }
    [[nodiscard]] double duration() const { return times_.upper - times_.lower; }
    [[nodiscard]] double time(double share) const { return times_.lower + share * duration(); }
    [[nodiscard]] double y(double distance) const {
        return picture_height - below_axes - distance / greatest_ * (picture_height - above_axes - below_axes);
    }
    [[nodiscard]] std::string point(double time, double distance) const {
        return fmt::format("{:.2f},{:.2f} ", x(time), y(distance));
    }
    /// A length of 1, 2 or 5 times a power of ten that divides the axis of distances into few parts.
    [[nodiscard]] double tick() const {
        const double power = std::pow(10.0, std::floor(std::log10(greatest_)));
        for (const double step : {0.1, 0.2, 0.5, 1.0})
            if (greatest_ / (step * power) <= 6)
                return step * power;
        return 2 * power;
    }
    [[nodiscard]] double greatest() const { return greatest_; }

private:
    Bracket times_;
    double greatest_;
};

std::string axes_of(const Frame& frame) {
    constexpr std::string_view grid = R"(stroke="#ddd")";
    std::string lines;
    for (int i = 0; i * frame.tick() <= frame.greatest(); ++i) {
        const double distance = i * frame.tick();
        lines += svg_line(left_of_axes, frame.y(distance), picture_width - right_of_axes, frame.y(distance), grid);
        lines += svg_text(left_of_axes - 8, frame.y(distance) + 4, "end", fmt::format("{:.6g}", distance));
    }
    for (int i = 0; i <= 4; ++i) {
        const double time = frame.time(0.25 * i);
        lines += svg_line(frame.x(time), above_axes, frame.x(time), picture_height - below_axes, grid);
        lines += svg_text(frame.x(time), picture_height - below_axes + 18, "middle", fmt::format("{:.6g}", time));
    }
    return lines +
           svg_text(0.5 * (left_of_axes + picture_width - right_of_axes), picture_height - 8, "middle",
                    frame.duration() == 1 ? "time, as a part of the motion" : "time") +
           svg_text(left_of_axes, above_axes - 6, "start", "distance");
}

/// Along the upper bounds, and back along the lower ones. Steps within a pixel are one.
std::string band_of(const DistanceProfile& profile, const Frame& frame) {
    std::string there, back;
    const double pixel = frame.duration() / (2 * (picture_width - left_of_axes - right_of_axes));
    for (std::size_t i = 0; i + 1 < profile.times.size();) {
        const double from = profile.times[i];
        double lower = profile.lower[i], upper = profile.upper[i];
        for (; i + 1 < profile.times.size() && profile.times[i] <= from + pixel; ++i) {
            lower = std::min(lower, profile.lower[i]);
            upper = std::max(upper, profile.upper[i]);
        }
        const double to = profile.times[i];
        there += frame.point(from, upper) + frame.point(to, upper);
        back.insert(0, frame.point(to, lower) + frame.point(from, lower));
    }
    return fmt::format(R"(<polygon points="{}{}" fill="#3b6ea8" stroke="#3b6ea8" stroke-width="1.5"/>)"
                       "\n",
                       there, back);
}

} // namespace

std::string profile_picture(const DistanceProfile& profile, const std::vector<double>& margins) {
    const double most = *std::ranges::max_element(profile.upper);
    const Frame frame({profile.times.front(), profile.times.back()}, std::isinf(most) ? 0 : 1.05 * most);
    std::string picture = svg_start(picture_width, picture_height);
    picture += axes_of(frame) + (std::isinf(most) ? std::string() : band_of(profile, frame));
    for (const double margin : margins)
        if (margin <= frame.greatest())
            picture +=
                svg_line(left_of_axes, frame.y(margin), picture_width - right_of_axes, frame.y(margin),
                         R"(stroke="#c0392b" stroke-dasharray="6 4")") +
                svg_text(picture_width - right_of_axes, frame.y(margin) - 4, "end", fmt::format("{:.6g}", margin));
    return picture + "</svg>\n";
}

} // namespace chasles::cli
