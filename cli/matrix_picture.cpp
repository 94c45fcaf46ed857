#include "cli/matrix_picture.h"

#include "cli/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace chasles::cli {
namespace {

// In pixels.
constexpr double room_for_cells = 900;
constexpr double widest_cell = 58;
constexpr double least_for_numbers = 40;
constexpr double pixels_per_letter = 7;
constexpr double room_for_legend = 44;

constexpr std::string_view contact_style = R"(fill="#d4147f")"; // as on pages
constexpr std::string_view untested_style = R"(fill="#eeeeee")";
constexpr std::string_view open_style = R"(fill="#f0e442")";
using Colour = std::array<double, 3>;
constexpr Colour near_colour{8, 69, 148}, far_colour{222, 235, 247};

/// From 0 for the least distance to 1 for the greatest one, by the logarithm.
class DistanceScale {
public:
    explicit DistanceScale(const DistanceMatrix& found) {
        for (const PairDistance& pair : found.pairs)
            if (const double distance = pair.nearest.distance.lower; distance > 0) {
                least_ = std::min(least_, distance);
                greatest_ = std::max(greatest_, distance);
            }
    }
    [[nodiscard]] bool is_empty() const { return !(least_ <= greatest_); }
    [[nodiscard]] double least() const { return least_; }
    [[nodiscard]] double greatest() const { return greatest_; }
    [[nodiscard]] double share(double distance) const {
        if (distance <= least_)
            return 0;
        return std::log(distance / least_) / std::log(greatest_ / least_);
    }

private:
    double least_ = std::numeric_limits<double>::infinity();
    double greatest_ = 0;
};

std::string fill_at(double share) {
    const auto mixed = [&](std::size_t i) {
        return int(std::lround(near_colour[i] + share * (far_colour[i] - near_colour[i])));
    };
    return fmt::format(R"(fill="#{:02x}{:02x}{:02x}")", mixed(0), mixed(1), mixed(2));
}

std::string rectangle(double x, double y, double width, double height, std::string_view style) {
    return fmt::format(R"(<rect x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" {}/>)"
                       "\n",
                       x, y, width, height, style);
}

class Matrix {
public:
    Matrix(const Scene& scene, const DistanceMatrix& found) : scene_(scene), found_(found), scale_(found) {
        const std::size_t count = std::max<std::size_t>(1, scene.bodies().size());
        cell_ = std::min(widest_cell, room_for_cells / double(count));
        has_numbers_ = cell_ >= least_for_numbers;
        std::size_t letters = 4;
        for (const SceneBody& body : scene.bodies())
            letters = std::max(letters, body.name.size());
        corner_ = 16 + pixels_per_letter * double(std::min<std::size_t>(letters, 40));
        size_ = cell_ * double(count);
    }

    [[nodiscard]] std::string picture() const {
        constexpr double least_width = 520; // of the legend
        std::string picture = svg_start(std::max(corner_ + size_, least_width) + 20, corner_ + size_ + room_for_legend);
        picture += rectangle(corner_, corner_, size_, size_, untested_style);
        for (const PairDistance& pair : found_.pairs) {
            picture += cell(pair.moving, pair.fixed, pair.nearest);
            picture += cell(pair.fixed, pair.moving, pair.nearest);
        }
        return picture + names() + legend() + "</svg>\n";
    }

private:
    [[nodiscard]] double place(std::size_t body) const { return corner_ + cell_ * double(body); }

    [[nodiscard]] std::string cell(std::size_t row, std::size_t column, const LeastDistance& found) const {
        const bool touches = found.distance.upper == 0, is_open = found.distance.lower == 0 && !touches;
        const double share = is_open ? 0 : scale_.share(found.distance.lower);
        const std::string style = touches   ? std::string(contact_style)
                                  : is_open ? std::string(open_style)
                                            : fill_at(share);
        const std::string cell =
            rectangle(place(column), place(row), cell_, cell_, style + R"( stroke="white" stroke-width="0.5")");
        if (!has_numbers_)
            return cell;
        const std::string words = touches   ? fmt::format("t {:.3g}", found.time.lower)
                                  : is_open ? "?"
                                            : fmt::format("{:.3g}", found.distance.lower);
        const bool is_dark = touches || (share < 0.55 && !is_open);
        return cell + fmt::format("<g fill=\"{}\">{}</g>\n", is_dark ? "white" : "black",
                                  svg_text(place(column) + cell_ / 2, place(row) + cell_ / 2 + 4, "middle", words));
    }

    [[nodiscard]] std::string names() const {
        std::string text;
        const double every = std::max(1.0, std::ceil(12 / cell_)); // names that would lie on each other are left out
        for (std::size_t i = 0; i < scene_.bodies().size(); i += std::size_t(every)) {
            const std::string name = without_marks(scene_.bodies()[i].name);
            const double middle = place(i) + cell_ / 2;
            text += svg_text(corner_ - 6, middle + 4, "end", name) +
                    fmt::format("<text transform=\"translate({:.2f} {:.2f}) rotate(-90)\">{}</text>\n", middle + 4,
                                corner_ - 6, name);
        }
        return text;
    }

    [[nodiscard]] std::string legend() const {
        const double y = corner_ + size_ + 14;
        std::string text = rectangle(10, y, 14, 14, contact_style) + svg_text(30, y + 12, "start", "contact");
        text += rectangle(90, y, 14, 14, untested_style) + svg_text(110, y + 12, "start", "not tested");
        text += rectangle(190, y, 14, 14, open_style) + svg_text(210, y + 12, "start", "not proven apart");
        if (scale_.is_empty())
            return text;
        for (int i = 0; i < 10; ++i)
            text += rectangle(390 + 8 * i, y, 8, 14, fill_at(i / 9.0));
        return text + svg_text(385, y + 12, "end", fmt::format("{:.3g}", scale_.least())) +
               svg_text(475, y + 12, "start", fmt::format("{:.3g}", scale_.greatest()));
    }

    const Scene& scene_;
    const DistanceMatrix& found_;
    DistanceScale scale_;
    double cell_ = 0;
    bool has_numbers_ = false;
    double corner_ = 0; ///< where the cells begin, below and beside the names
    double size_ = 0;   ///< of all cells
};

} // namespace

std::string matrix_picture(const Scene& scene, const DistanceMatrix& found) {
    return Matrix(scene, found).picture();
}

} // namespace chasles::cli
