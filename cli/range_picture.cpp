#include "cli/range_picture.h"

#include "cli/svg.h"

#include <cmath>
#include <utility>
#include <vector>

namespace chasles::cli {
namespace {

// In pixels.
constexpr double side_of_plane = 480;
constexpr double left_of_plane = 80;
constexpr double above_plane = 40;
constexpr double below_plane = 50;
constexpr double right_of_plane = 30;
constexpr double right_end = left_of_plane + side_of_plane;
constexpr double lower_end = above_plane + side_of_plane;

// The colours of Okabe and Ito, as on pages.
constexpr std::string_view clear_style = R"(fill="#a6d5f2")";
constexpr std::string_view contact_style = R"(fill="#d55e00")";
constexpr std::string_view open_style = R"(fill="#f0e442")";

/// The plane of two variables within a box.
class Plane {
public:
    Plane(const ConfigurationBox& whole, const std::vector<std::size_t>& joints)
        : first_(Eigen::Index(joints[0])), second_(Eigen::Index(joints[1])), whole_(whole) {}

    [[nodiscard]] double x(double value) const { return left_of_plane + side_of_plane * share(first_, value); }
    [[nodiscard]] double y(double value) const { return lower_end - side_of_plane * share(second_, value); }
    [[nodiscard]] std::string box(const ConfigurationBox& box, std::string_view style) const {
        const double left = x(box.lower[first_]), top = y(box.upper[second_]);
        return fmt::format(R"(<rect x="{:.3f}" y="{:.3f}" width="{:.3f}" height="{:.3f}" {}/>)"
                           "\n",
                           left, top, x(box.upper[first_]) - left, y(box.lower[second_]) - top, style);
    }
    [[nodiscard]] std::string boxes(const std::vector<ConfigurationBox>& boxes, std::string_view style) const {
        std::string text = fmt::format("<g {}>\n", style);
        for (const ConfigurationBox& each : boxes)
            text += box(each, "");
        return text + "</g>\n";
    }
    [[nodiscard]] std::string axes(const std::string& first, const std::string& second) const {
        std::string text;
        for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            const double a = value(first_, share), b = value(second_, share);
            text += svg_line(x(a), lower_end, x(a), lower_end + 5, R"(stroke="black")") +
                    svg_text(x(a), lower_end + 18, "middle", fmt::format("{:.4g}", a)) +
                    svg_line(left_of_plane - 5, y(b), left_of_plane, y(b), R"(stroke="black")") +
                    svg_text(left_of_plane - 8, y(b) + 4, "end", fmt::format("{:.4g}", b));
        }
        return text + svg_text(left_of_plane + side_of_plane / 2, lower_end + 38, "middle", first) +
               svg_text(left_of_plane - 40, above_plane - 24, "start", second);
    }

private:
    [[nodiscard]] double share(Eigen::Index i, double value) const {
        return (value - whole_.lower[i]) / (whole_.upper[i] - whole_.lower[i]);
    }
    [[nodiscard]] double value(Eigen::Index i, double share) const {
        return whole_.lower[i] + share * (whole_.upper[i] - whole_.lower[i]);
    }

    Eigen::Index first_, second_;
    const ConfigurationBox& whole_;
};

/// The shares, beside their colours.
std::string legend(const RobotRange& range) {
    std::string text;
    double x = left_of_plane + 60;
    const std::vector<std::pair<std::string, std::string_view>> entries{
        {fmt::format("clear {:.1f} %", 100 * range.clear_share), clear_style},
        {fmt::format("contact {:.1f} %", 100 * range.contact_share), contact_style},
        {fmt::format("open {:.1f} %", 100 * range.open_share), open_style}};
    for (const auto& [words, style] : entries) {
        text += fmt::format(R"(<rect x="{:.2f}" y="{:.2f}" width="12" height="12" {}/>)"
                            "\n",
                            x, above_plane - 24, style) +
                svg_text(x + 18, above_plane - 14, "start", words);
        x += 130;
    }
    return text;
}

} // namespace

std::string range_picture(const Robot& robot, const RobotRange& range, const ConfigurationBox& whole,
                          const std::optional<ClearBox>& clear_box) {
    const Plane plane(whole, range.joints);
    std::string picture = svg_start(right_end + right_of_plane, lower_end + below_plane) +
                          "<g shape-rendering=\"crispEdges\">\n" + plane.boxes(range.clear, clear_style) +
                          plane.boxes(range.contact, contact_style) + plane.boxes(range.open, open_style) + "</g>\n";
    if (clear_box)
        picture += plane.box(clear_box->box, R"(fill="none" stroke="#0072b2" stroke-width="2" stroke-dasharray="6 4")");
    picture += plane.box(whole, R"(fill="none" stroke="black")") +
               plane.axes(without_marks(robot.variables()[range.joints[0]].name),
                          without_marks(robot.variables()[range.joints[1]].name));
    return picture + legend(range) + "</svg>\n";
}

} // namespace chasles::cli
