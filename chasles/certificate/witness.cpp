#include "chasles/certificate/witness.h"

#include "chasles/certificate/hexadecimal.h"
#include "chasles/contact/segment_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace chasles::certificate {

namespace {

using Triangle = std::array<Wide, 3>;

/// Of the lengths that enter: signs below it are not known.
constexpr double unknown = 1e-28;

/// A face at one tau, in the frame of the fixed body.
struct PlacedFace {
    bool is_moving;
    std::uint32_t number;
    std::vector<Wide> corners;

    [[nodiscard]] std::size_t size() const { return corners.size(); }
    [[nodiscard]] Triangle triangle(std::size_t k) const { return {corners[0], corners[k], corners[k + 1]}; }
    /// As a checker asks, with the normal of the whole outline.
    [[nodiscard]] bool is_convex() const {
        if (size() == 3)
            return true;
        Wide normal;
        for (std::size_t k = 1; k + 1 < size(); ++k)
            normal = normal + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
        for (std::size_t k = 0; k < size(); ++k) {
            const Wide &a = corners[k], &b = corners[(k + 1) % size()], &c = corners[(k + 2) % size()];
            if (dot(normal, cross(b - a, c - b)).high() < 0 ||
                dot(normal, cross(a - corners[0], b - corners[0])).high() < 0)
                return false;
        }
        return true;
    }
};

/// The heights of a crossing above what would end it: of the ends of an edge from a plane, and of the edge from the
/// sides. At least 0 where an edge meets a triangle.
double depth_of(const Wide& from, const Wide& to, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const auto height = [](const Wide& normal, const Wide& vector) {
        const DoubleDouble size = length(normal);
        return size.high() > 0 ? (dot(normal, vector) / size).high() : 0.0;
    };
    const Wide normal = cross(b - a, c - a);
    const double first = height(normal, from - a), second = height(normal, to - a);
    if (std::max(std::abs(first), std::abs(second)) <= unknown * length(to - from).high())
        return -std::numeric_limits<double>::infinity(); // in the plane
    double depth = first > second ? std::min(first, -second) : std::min(-first, second);
    const double sense = first > second ? 1 : -1; // of the edge, against the normal
    for (std::size_t i = 0; i < 3; ++i) {
        const Wide &p = triangle[i], &q = triangle[(i + 1) % 3];
        depth = std::min(depth, sense * height(cross(q - p, to - from), from - p));
    }
    return depth;
}

class WitnessSearch {
public:
    WitnessSearch(const PieceOfBodies& piece, double tau) : piece_(piece), tau_(tau) {}

    std::optional<std::string> run() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> waiting{{0, 0}};
        while (!waiting.empty() && tries_ < (best_ ? most_tries_for_a_better_one : most_tries)) {
            const auto [first, second] = waiting.back();
            waiting.pop_back();
            const FaceTree::Node &a = piece_.moving().node(first), &b = piece_.fixed().node(second);
            if (piece_.gap_at(a, b, tau_).gap > piece_.reach().high() + 1e-12 * piece_.size())
                continue;
            if (a.is_leaf() && b.is_leaf()) {
                ++tries_;
                look_at(placed(true, piece_.moving().first_face(a)), placed(false, piece_.fixed().first_face(b)));
            } else if (b.is_leaf() || (!a.is_leaf() && a.extent >= b.extent)) {
                waiting.emplace_back(a.parts, second);
                waiting.emplace_back(a.parts + 1, second);
            } else {
                waiting.emplace_back(first, b.parts);
                waiting.emplace_back(first, b.parts + 1);
            }
        }
        return best_;
    }

private:
    /// So many pairs of faces that are near are looked at. Where faces lie on each other, only few of them cross.
    static constexpr std::size_t most_tries = 100'000, most_tries_for_a_better_one = 400;

    [[nodiscard]] PlacedFace placed(bool of_moving, std::uint32_t face) const {
        const FaceTree& tree = of_moving ? piece_.moving() : piece_.fixed();
        PlacedFace result{of_moving, face, {}};
        for (std::size_t i = 0; i < tree.body().face(face).size(); ++i) {
            const Corner corner = tree.corner(face, i);
            result.corners.push_back(of_moving ? piece_.motion().place(corner, DoubleDouble(tau_)) : widened(corner));
        }
        return result;
    }
    void look_at(const PlacedFace& moving, const PlacedFace& fixed) {
        look_for_crossings(moving, fixed);
        look_for_crossings(fixed, moving);
        if (piece_.reach() > DoubleDouble(0))
            look_for_near_points(moving, fixed);
    }
    void look_for_crossings(const PlacedFace& edges, const PlacedFace& face) {
        if (!face.is_convex())
            return;
        for (std::size_t i = 0; i < edges.size(); ++i)
            for (std::size_t k = 1; k + 1 < face.size(); ++k)
                take(depth_of(edges.corners[i], edges.corners[(i + 1) % edges.size()], face.triangle(k)), [&] {
                    return "witness cross " + hexadecimal(tau_) + (edges.is_moving ? " moving " : " fixed ") +
                           std::to_string(edges.number) + " " + std::to_string(i) + " " + std::to_string(face.number) +
                           " " + std::to_string(k);
                });
    }
    template <class Words>
    void take(double depth, const Words& words) {
        if (depth < (piece_.is_exact() ? -unknown : unknown) * piece_.size() || (best_ && depth <= depth_))
            return;
        depth_ = depth;
        best_ = words();
    }
    void look_for_near_points(const PlacedFace& moving, const PlacedFace& fixed);
    void take_points(const PlacedFace& moving, std::size_t i, const std::array<double, 3>& own, const PlacedFace& fixed,
                     std::size_t k, const std::array<double, 3>& other);

    const PieceOfBodies& piece_;
    double tau_;
    std::size_t tries_ = 0;
    double depth_ = 0;
    std::optional<std::string> best_;
};

using Weights = std::array<double, 3>;

/// Of the point of a segment between two corners of a triangle.
Weights on_side(std::size_t from, double share) {
    Weights weights{};
    weights[from] = 1 - share;
    weights[(from + 1) % 3] = share;
    return weights;
}

std::pair<double, double> nearest_shares(const Corner& p, const Corner& along_p, const Corner& q,
                                         const Corner& along_q) {
    return contact::nearest_shares(p - q, along_p, along_q, [](const Corner& a, const Corner& b) { return dot(a, b); });
}

/// Of the foot of a point on a triangle, if it is inside.
std::optional<Weights> foot_on(const std::array<Corner, 3>& triangle, const Corner& point) {
    const auto& [a, b, c] = triangle;
    const Corner normal = cross(b - a, c - a);
    const double square = dot(normal, normal);
    if (!(square > 0))
        return std::nullopt;
    const double v = dot(cross(point - a, c - a), normal) / square, w = dot(cross(b - a, point - a), normal) / square;
    if (v < 0 || w < 0 || v + w > 1)
        return std::nullopt;
    return Weights{1 - v - w, v, w};
}

void WitnessSearch::look_for_near_points(const PlacedFace& moving, const PlacedFace& fixed) {
    if (!moving.is_convex() || !fixed.is_convex())
        return;
    for (std::size_t i = 1; i + 1 < moving.size(); ++i)
        for (std::size_t k = 1; k + 1 < fixed.size(); ++k) {
            std::array<Corner, 3> own, other;
            for (std::size_t j = 0; j < 3; ++j) {
                own[j] = motion::in_double(moving.triangle(i)[j]);
                other[j] = motion::in_double(fixed.triangle(k)[j]);
            }
            for (std::size_t j = 0; j < 3; ++j) {
                if (const auto foot = foot_on(other, own[j]))
                    take_points(moving, i, on_side(j, 0), fixed, k, *foot);
                if (const auto foot = foot_on(own, other[j]))
                    take_points(moving, i, *foot, fixed, k, on_side(j, 0));
                for (std::size_t l = 0; l < 3; ++l) {
                    const auto [s, t] =
                        nearest_shares(own[j], own[(j + 1) % 3] - own[j], other[l], other[(l + 1) % 3] - other[l]);
                    take_points(moving, i, on_side(j, s), fixed, k, on_side(l, t));
                }
            }
        }
}

void WitnessSearch::take_points(const PlacedFace& moving, std::size_t i, const Weights& own, const PlacedFace& fixed,
                                std::size_t k, const Weights& other) {
    const auto integers = [](const Weights& weights) {
        std::array<long long, 3> rounded{};
        for (std::size_t j = 0; j < 3; ++j)
            rounded[j] = std::llround(std::ldexp(std::max(weights[j], 0.0), 52));
        return rounded;
    };
    const auto place = [](const Triangle& triangle, const std::array<long long, 3>& weights) {
        Wide sum;
        DoubleDouble total(0);
        for (std::size_t j = 0; j < 3; ++j) {
            sum = sum + scale(triangle[j], DoubleDouble(double(weights[j])));
            total = total + DoubleDouble(double(weights[j]));
        }
        return scale(sum, DoubleDouble(1) / total);
    };
    const auto words = [](const PlacedFace& face, std::size_t number, const std::array<long long, 3>& weights) {
        std::string text =
            " " + std::to_string(face.number) + " 0 " + std::to_string(number) + " " + std::to_string(number + 1);
        for (const long long weight : weights)
            text += " " + std::to_string(weight);
        return text;
    };
    const auto a = integers(own), b = integers(other);
    const DoubleDouble distance = length(place(moving.triangle(i), a) - place(fixed.triangle(k), b));
    take((piece_.reach() - distance).high(),
         [&] { return "witness near " + hexadecimal(tau_) + words(moving, i, a) + words(fixed, k, b); });
}

} // namespace

std::optional<std::string> witness_at(const PieceOfBodies& piece, double tau) {
    return WitnessSearch(piece, tau).run();
}

namespace {

/// Whether a ray comes near to an edge, within a distance that is far more than rounding.
bool passes_near(const Corner& from, const Corner& direction, const Corner& p, const Corner& q, double distance) {
    const Corner unit = scale(direction, 1 / length(direction));
    const double most = length(p - from) + length(q - from); // no point of the edge is farther along the ray
    const auto [s, t] = nearest_shares(from, scale(unit, most), p, q - p);
    return !(length(from + scale(unit, s * most) - (p + scale(q - p, t))) > distance);
}

/// How often a ray leaves through a face, less how often it enters; nothing if it passes too near to an edge. In
/// double: what is not clear by far is no answer.
std::optional<int> crossings(std::span<const Corner> outline, const Corner& from, const Corner& direction,
                             double size) {
    constexpr double clear = 1e-9;
    int sum = 0;
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
        const std::array<Corner, 3> triangle{outline[0], outline[k], outline[k + 1]};
        int positive = 0, negative = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Corner &p = triangle[i], &q = triangle[(i + 1) % 3];
            const Corner across = cross(direction, q - p);
            const double height = dot(across, from - p);
            if (std::abs(height) > clear * size * length(across))
                ++(height > 0 ? positive : negative);
            else if (passes_near(from, direction, p, q, 1e3 * clear * size))
                return std::nullopt;
            else // it meets the line of the edge, if at all, beside the edge
                ++positive, ++negative;
        }
        if (positive > 0 && negative > 0)
            continue;
        const Corner normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
        const double along = dot(normal, direction), ahead = dot(normal, triangle[0] - from);
        if (!(std::abs(along) > clear * length(normal) * length(direction)))
            return std::nullopt;
        if ((ahead > 0) == (along > 0))
            sum += along > 0 ? 1 : -1;
    }
    return sum;
}

std::optional<int> winding_of(const FaceTree& tree, const Corner& from, const Corner& direction, double size) {
    int sum = 0;
    std::vector<Corner> outline;
    for (std::size_t face = 0; face < tree.body().face_count(); ++face) {
        outline.clear();
        for (std::size_t i = 0; i < tree.body().face(face).size(); ++i)
            outline.push_back(tree.corner(face, i));
        const std::optional<int> count = crossings(outline, from, direction, size);
        if (!count)
            return std::nullopt;
        sum += *count;
    }
    return sum;
}

/// A corner of the fixed body at tau = 0 as the moving body sees it.
Corner seen_from_moving(const PieceMotion<DoubleDouble>& motion, const Corner& corner) {
    const DoubleDouble start(0), one(1), zero(0);
    const Wide arm = widened(corner) - motion.place({}, start);
    const auto along = [&](const Wide& axis) { return dot(motion.turned(axis, start), arm).high(); };
    return {along({one, zero, zero}), along({zero, one, zero}), along({zero, zero, one})};
}

} // namespace

std::optional<Ray> ray_from(const PieceOfBodies& piece, bool from_moving, std::size_t face, std::size_t corner) {
    const FaceTree &own = from_moving ? piece.moving() : piece.fixed(),
                   &other = from_moving ? piece.fixed() : piece.moving();
    const Corner place = own.corner(face, corner);
    const Corner from = from_moving ? motion::in_double(piece.motion().place(place, DoubleDouble(0)))
                                    : seen_from_moving(piece.motion(), place);
    std::mt19937 random(1);
    constexpr int most = 1000;
    const auto component = [&] { return double(int(random() % (2 * most + 1)) - most); }; // the same with any library
    for (int attempt = 0; attempt < 100; ++attempt) {
        const Corner direction{component(), component(), component()};
        if (const std::optional<int> winding = winding_of(other, from, direction, piece.size())) {
            std::string words = from_moving ? "moving" : "fixed";
            for (const std::size_t number : {face, corner})
                words += " " + std::to_string(number);
            for (int i = 0; i < 3; ++i)
                words += " " + std::to_string(int(direction[i]));
            return Ray{words, *winding};
        }
    }
    return std::nullopt;
}

} // namespace chasles::certificate
