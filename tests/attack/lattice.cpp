#include "tests/attack/lattice.h"

namespace chasles::attack {

namespace {

using reference::Turn;

Triple triple(const Eigen::Vector3i& v) {
    return {Rational(v.x()), Rational(v.y()), Rational(v.z())};
}

Triple triple(const Eigen::Vector3d& v) {
    return reference::exact(v);
}

Eigen::Vector3d rounded(const Triple& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

Turn small_turn(AttackRandom& random, int size) {
    const int w = random.integer(1, size);
    return {Rational(w), triple(random.grid(size))};
}

template <class P>
Rational value(const P& p, const Rational& tau) {
    Rational result(0);
    for (std::size_t i = p.size(); i-- > 0;)
        result = result * tau + p[i];
    return result;
}

template <class P>
Rational slope(const P& p, const Rational& tau) {
    Rational result(0);
    for (std::size_t i = p.size(); i-- > 1;)
        result = result * tau + p[i] * Rational(static_cast<int>(i));
    return result;
}

Rational common_denominator(const std::array<Triple, 3>& rows) {
    Integer result(1);
    for (const Triple& row : rows)
        for (const Rational& x : row)
            result = lcm(result, Integer(denominator(x)));
    return Rational(result);
}

/// Turn and travel of the moving body in the frame of the fixed body.
struct Way {
    Turn turn;
    Triple travel{};
};

Way way_of(AttackRandom& random, const MotionWish& wish, MotionKind kind) {
    const bool turns = wish.turns >= 0 ? wish.turns > 0 : random.chance(0.8);
    Way way;
    if (!turns) {
        way.travel = triple(wish.travel.isZero() ? random.grid_direction(12) : wish.travel);
        return way;
    }
    const Eigen::Vector3i axis = wish.axis.isZero() ? random.grid_direction(2) : wish.axis;
    way.turn = {Rational(random.integer(1, 4)), triple(axis)};
    if (kind == MotionKind::sweep)
        way.turn = way.turn * way.turn; // of rational length
    if (way.turn.w < 0)
        way.turn = {Rational(-way.turn.w), reference::times(way.turn.v, Rational(-1))};
    const bool slides = wish.slides >= 0 ? wish.slides > 0 : random.chance(0.7);
    const Rational part(slides ? random.integer(-40, 40) : 0);
    way.travel = kind == MotionKind::screw ? reference::times(triple(axis), part)
                 : slides                  ? triple(Eigen::Vector3i(random.grid(60)))
                                           : Triple{};
    return way;
}

} // namespace

LatticeMotion lattice_motion(AttackRandom& random, const MotionWish& wish) {
    LatticeMotion result;
    result.posed.kind = random.chance(0.6) ? MotionKind::screw : MotionKind::sweep;
    result.posed.is_relative = random.chance(0.3);
    constexpr double places[] = {0, 1, 0.5, 0.5, 0.25, 0.75, 0.375};
    result.tau = wish.tau >= 0 ? wish.tau : random.pick(places);
    Way way = way_of(random, wish, result.posed.kind);
    ExactPose start{{}, random.chance(0.5) ? small_turn(random, 2) : Turn{}};
    ExactPose fixed_start;
    ExactPose fixed_goal;
    if (result.posed.is_relative) {
        fixed_start = {triple(random.grid(5)), small_turn(random, 1)};
        fixed_goal = {triple(random.grid(5)), small_turn(random, 1)};
        way.travel = reference::times(way.travel, fixed_goal.rotation.norm()); // whole when turned
    }
    const ExactPose goal{way.travel, way.turn * start.rotation};
    const auto placed = [](const ExactPose& frame, const ExactPose& pose) {
        return rounded_pose({reference::sum(reference::turned(pose.translation, frame.rotation), frame.translation),
                             frame.rotation * pose.rotation});
    };
    result.posed.moving_start = placed(fixed_start, start);
    result.posed.moving_goal = placed(fixed_goal, goal);
    result.posed.fixed_start = rounded_pose(fixed_start);
    result.posed.fixed_goal = rounded_pose(fixed_goal);
    result.path = result.posed.paths().at(0);
    const Rational tau(result.tau);
    const Rational weight = value(result.path.weight, tau);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result.turn[i][j] = value(result.path.turn[i][j], tau) / weight;
        result.offset[i] = value(result.path.shift[i], tau) / weight;
    }
    result.denominator = common_denominator(result.turn);
    return result;
}

Eigen::Vector3d LatticeMotion::moving_point(const Eigen::Vector3d& z) const {
    const Triple at = triple(z);
    Triple back{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            back[i] += turn[j][i] * at[j] * denominator;
    return rounded(back);
}

Eigen::Vector3d LatticeMotion::fixed_point(const Eigen::Vector3d& z) const {
    return rounded(reference::sum(reference::times(triple(z), denominator), offset));
}

Eigen::Vector3d LatticeMotion::velocity(const Eigen::Vector3d& z) const {
    const Rational at(tau);
    const Triple b = triple(moving_point(z));
    const Triple position = reference::sum(reference::times(triple(z), denominator), offset);
    const Rational weight_slope = slope(path.weight, at);
    Triple result;
    Integer multiple(1);
    for (std::size_t i = 0; i < 3; ++i) {
        Rational rate = slope(path.shift[i], at) - position[i] * weight_slope;
        for (std::size_t j = 0; j < 3; ++j)
            rate += slope(path.turn[i][j], at) * b[j];
        result[i] = rate;
        multiple = lcm(multiple, Integer(boost::multiprecision::denominator(rate)));
    }
    Integer divisor(0);
    for (Rational& x : result) {
        x *= Rational(multiple);
        divisor = gcd(divisor, Integer(numerator(x)));
    }
    return divisor == 0 ? Eigen::Vector3d(0, 0, 0) : rounded(reference::times(result, Rational(Integer(1), divisor)));
}

void scale_lengths(PosedMotion& posed, double factor) {
    for (Pose* pose : {&posed.moving_start, &posed.moving_goal, &posed.fixed_start, &posed.fixed_goal})
        pose->translation *= factor;
}

} // namespace chasles::attack
