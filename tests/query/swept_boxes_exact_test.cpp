// Boxes that are told apart are apart: the decision against the exact gap of their exact images, in rationals, for
// boxes that all but touch. With CHASLES_LONG=1 in the environment: many more.
#include "chasles/query/time_tree.h"
#include "tests/support/error_ratios.h"
#include "tests/support/posed_motions.h"

namespace chasles::test {
namespace {

using ExactMaps = motion::ControlMaps<Rational>;
using ExactVector = Vector3<Rational>;

struct ExactBox {
    ExactVector centre;
    ExactVector half;

    ExactBox(const BoxNode& node, const Eigen::Vector3d& origin) {
        for (int i = 0; i < 3; ++i) {
            const Rational lower(node.lower[static_cast<std::size_t>(i)]);
            const Rational upper(node.upper[static_cast<std::size_t>(i)]);
            centre[i] = Rational(origin[i]) + (lower + upper) / 2;
            half[i] = (upper - lower) / 2;
        }
    }
};

/// Lane by lane, how far apart two boxes are along an axis of the second one, over the weight; the least of the lanes
/// for the better of both sides. `rows` and `shift` carry the first box into the frame of the second.
Rational gap_along(int axis, const Matrix3<Bernstein<3, Rational>>& rows, const Vector3<Bernstein<3, Rational>>& shift,
                   const Bernstein<3, Rational>& weight, const ExactBox& first, const ExactBox& second) {
    std::optional<Rational> above;
    std::optional<Rational> below;
    for (int lane = 0; lane <= 3; ++lane) {
        Rational distance = shift[axis][lane] - weight[lane] * second.centre[axis];
        Rational reach = weight[lane] * second.half[axis];
        for (int j = 0; j < 3; ++j) {
            distance += rows.row[axis][j][lane] * first.centre[j];
            reach += magnitude(rows.row[axis][j][lane]) * first.half[j];
        }
        const Rational up = (distance - reach) / weight[lane];
        const Rational down = (-distance - reach) / weight[lane];
        above = above && *above < up ? *above : up;
        below = below && *below < down ? *below : down;
    }
    return std::max(*above, *below);
}

Rational gap_along(int axis, const ExactMaps& maps, const ExactBox& moving, const ExactBox& fixed) {
    if (axis < 3)
        return gap_along(axis, maps.turn, maps.shift, maps.weight, moving, fixed);
    const Vector3<Bernstein<3, Rational>> back = Vector3<Bernstein<3, Rational>>() - maps.inverse_shift;
    return gap_along(axis - 3, maps.turn.transposed(), back, maps.weight, fixed, moving);
}

BoxNode random_node(Random& random, double size) {
    BoxNode node{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double middle = random.uniform(-size, size);
        const double half = random.chance(0.2) ? 0 : size * std::abs(random.scaled(-6, 0));
        node.lower[i] = float(middle - half);
        node.upper[i] = float(middle + half);
    }
    return node;
}

double reach(const BoxNode& node, const Eigen::Vector3d& centre) {
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        largest = std::max(largest, std::abs(centre[i]) + std::max(std::abs(double(node.lower[axis])),
                                                                   std::abs(double(node.upper[axis]))));
    }
    return largest;
}

/// Two boxes, one of which is moved along an axis of the other until they are apart by about one slack.
struct Scene {
    motion::ControlMaps<double> whole;
    ExactMaps exactly;
    double from = 0;
    double to = 1;
    double made_reach = 0;
    BoxNode moving{};
    BoxNode fixed{};
    Eigen::Vector3d moving_centre;
    Eigen::Vector3d fixed_centre;

    explicit Scene(Random& random) {
        const double size = std::abs(random.scaled(-6, 6));
        const PosedMotion motion = random_posed_motion(random, size);
        whole = motion::rounded(motion::control_maps(motion.made));
        exactly = motion::control_maps(motion.exactly);
        made_reach = motion.made.reach;
        if (random.chance(0.5)) {
            const double width = std::ldexp(1.0, -random.integer(1, 12));
            from = width * random.integer(0, int(1 / width) - 1);
            to = from + width;
            exactly = restricted(exactly, Rational(from), Rational(to));
        }
        moving = random_node(random, size);
        fixed = random_node(random, size * std::abs(random.scaled(-3, 3)));
        moving_centre = eigen(random.vector(size));
        fixed_centre = place_half_way() - middle_of(fixed);
        const int axis = random.integer(0, 5);
        const Rational gap = gap_along(axis, exactly, ExactBox(moving, moving_centre), ExactBox(fixed, fixed_centre));
        const double target = random.uniform(0.7, 1.3) * slack();
        // Downwards or upwards, whichever side is the better one: one of both brings the gap to the target.
        const double shift = static_cast<double>(gap) - target;
        Eigen::Vector3d& centre = axis < 3 ? fixed_centre : moving_centre;
        const double before = centre[axis % 3];
        centre[axis % 3] = before + shift;
        const Rational now = gap_along(axis, exactly, ExactBox(moving, moving_centre), ExactBox(fixed, fixed_centre));
        if (std::abs(static_cast<double>(now) - target) > std::abs(target))
            centre[axis % 3] = before - shift;
    }

    static Eigen::Vector3d middle_of(const BoxNode& node) {
        Eigen::Vector3d middle;
        for (std::size_t i = 0; i < 3; ++i)
            middle[int(i)] = 0.5 * (double(node.lower[i]) + double(node.upper[i]));
        return middle;
    }

    /// Where the middle of the moving box is in the middle of the interval: there the boxes meet.
    [[nodiscard]] Eigen::Vector3d place_half_way() const {
        const Eigen::Vector3d b = moving_centre + middle_of(moving);
        const auto path = whole.turn * Vector3<double>{b.x(), b.y(), b.z()} + whole.shift;
        const double tau = 0.5 * (from + to);
        const double weight = value_at(whole.weight, tau);
        return Eigen::Vector3d(value_at(path.x, tau), value_at(path.y, tau), value_at(path.z, tau)) / weight;
    }

    [[nodiscard]] elementary::ErrorScale scale() const {
        return elementary::error_scale(whole, std::max(reach(moving, moving_centre), made_reach),
                                       reach(fixed, fixed_centre));
    }
    [[nodiscard]] double slack() const { return elementary::error_unit<double> * scale().length; }

    [[nodiscard]] bool told_apart() const {
        const query::TimeTree times(whole, moving_centre, fixed_centre, scale());
        return times.interval(from, to).boxes.relation(moving, fixed).apart;
    }

    /// The widest exact gap along any of the six axes, in slacks.
    [[nodiscard]] double exact_gap() const {
        const ExactBox a(moving, moving_centre);
        const ExactBox b(fixed, fixed_centre);
        Rational widest = gap_along(0, exactly, a, b);
        for (int axis = 1; axis < 6; ++axis)
            widest = std::max(widest, gap_along(axis, exactly, a, b));
        return static_cast<double>(Rational(widest / Rational(slack())));
    }
};

TEST(SweptBoxes, DecisionsFollowTheExactGapWithinTheSlack) {
    Random random(751);
    ErrorRatios ratios;
    int apart = 0;
    int close = 0;
    const int scenes = 2000 * times_if_long(100);
    for (int i = 0; i < scenes; ++i) {
        const Scene scene(random);
        const double gap = scene.exact_gap();
        const bool told_apart = scene.told_apart();
        apart += told_apart ? 1 : 0;
        close += std::abs(gap - 1) < 0.3 ? 1 : 0;
        ASSERT_TRUE(!told_apart || gap > 0) << "scene " << i << ": told apart though they may touch";
        // The computed gap is above the slack exactly if they are told apart.
        ratios.note("gap of boxes", told_apart ? std::max(0.0, 1 - gap) : std::max(0.0, gap - 1));
    }
    std::cout << apart << " of " << scenes << " told apart, " << close << " within a third of the slack\n";
    ratios.expect_sound(1e-4);
    EXPECT_GT(close, scenes / 5);
    EXPECT_GT(apart, scenes / 5);
    EXPECT_LT(apart, scenes * 4 / 5);
}

} // namespace
} // namespace chasles::test
