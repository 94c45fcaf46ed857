#include "chasles/query/swept_boxes.h"

// The hottest function of the library is compiled twice, and the processor at hand chooses: four lanes are one
// register with AVX2 and two without. No fused operations: the answers are the same to the last bit. All that it calls
// has to be inlined (flatten), because the two forms pass vectors in different ways; without optimisation it is not.
// Clang gives the chosen form a name that callers do not know (before version 18), and sanitizers are not up when the
// choice is made. tests/bits compares the answers of both forms.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__OPTIMIZE__) && !defined(__AVX2__) &&                    \
    !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CHASLES_ALSO_FOR_AVX2 __attribute__((target_clones("avx2", "default"), flatten))
#else
#define CHASLES_ALSO_FOR_AVX2
#endif

namespace chasles::query {

namespace {

using Lanes = algebra::Lanes<4, double>;
using LaneVector = algebra::Vector3<Lanes>;

Lanes times(const Lanes& lanes, double factor) {
    return lanes * Lanes::all(factor);
}

double spread(const Lanes& lanes) {
    return std::max(std::max(lanes[0], lanes[1]), std::max(lanes[2], lanes[3])) -
           std::min(std::min(lanes[0], lanes[1]), std::min(lanes[2], lanes[3]));
}

/// Boxes lose at most so much where subnormal floats are flushed to zero: 4 x 2^-126, stretched by less than 1000.
constexpr double flushed = 0x1p-110;

struct BoxMiddle {
    double centre[3];
    double half[3];
};

/// Sums and halves of floats are exact in double precision unless their exponents differ by more than 29.
BoxMiddle middle_of(const BoxNode& node) {
    BoxMiddle box;
    for (int i = 0; i < 3; ++i) {
        const double lower = node.lower[i];
        const double upper = node.upper[i];
        box.centre[i] = 0.5 * (lower + upper);
        box.half[i] = 0.5 * (upper - lower);
    }
    return box;
}

Lanes combined(const LaneVector& row, const double* by) {
    return times(row.x, by[0]) + times(row.y, by[1]) + times(row.z, by[2]);
}

bool is_apart(const Lanes& distance, const Lanes& reach) {
    return all_above(distance, reach) || all_above(Lanes() - distance, reach);
}

} // namespace

SweptBoxes::SweptBoxes(const motion::ControlMaps<double>& maps, const Eigen::Vector3d& moving_centre,
                       const Eigen::Vector3d& fixed_centre, const elementary::ErrorScale& scale) {
    const double moving[3] = {moving_centre.x(), moving_centre.y(), moving_centre.z()};
    const double fixed[3] = {fixed_centre.x(), fixed_centre.y(), fixed_centre.z()};
    weight_ = maps.weight.coefficients;
    for (int i = 0; i < 4; ++i)
        inverse_weight_.set(i, 1 / weight_[i]);
    slack_ = times(weight_, elementary::error_unit<double> * scale.length + flushed);
    for (int i = 0; i < 3; ++i) {
        double row_spin = 0;
        for (int j = 0; j < 3; ++j) {
            turn_.row[i][j] = maps.turn.row[i][j].coefficients;
            turn_size_.row[i][j] = magnitude(turn_.row[i][j]);
            row_spin += spread(turn_.row[i][j] * inverse_weight_);
        }
        spin_ = std::max(spin_, row_spin);
    }
    const algebra::Matrix3<Lanes> back = turn_.transposed();
    for (int i = 0; i < 3; ++i) {
        offset_[i] = combined(turn_.row[i], moving) + maps.shift[i].coefficients - times(weight_, fixed[i]);
        inverse_offset_[i] =
            combined(back.row[i], fixed) - maps.inverse_shift[i].coefficients - times(weight_, moving[i]);
    }
}

CHASLES_ALSO_FOR_AVX2
SweptBoxes::Relation SweptBoxes::relation(const BoxNode& moving, const BoxNode& fixed) const {
    const BoxMiddle a = middle_of(moving);
    const BoxMiddle b = middle_of(fixed);
    LaneVector path;
    for (int i = 0; i < 3; ++i) { // along the fixed body's axes
        const Lanes centre = combined(turn_.row[i], a.centre) + offset_[i];
        const Lanes reach = combined(turn_size_.row[i], a.half) + times(weight_, b.half[i]) + slack_;
        if (is_apart(centre - times(weight_, b.centre[i]), reach))
            return {true, 0, 0};
        path[i] = centre;
    }
    for (int i = 0; i < 3; ++i) { // along the moving body's axes
        const LaneVector column{turn_.row[0][i], turn_.row[1][i], turn_.row[2][i]};
        const LaneVector column_size{turn_size_.row[0][i], turn_size_.row[1][i], turn_size_.row[2][i]};
        const Lanes centre = combined(column, b.centre) + inverse_offset_[i];
        const Lanes reach = combined(column_size, b.half) + times(weight_, a.half[i]) + slack_;
        if (is_apart(centre - times(weight_, a.centre[i]), reach))
            return {true, 0, 0};
    }
    Relation relation;
    for (int i = 0; i < 3; ++i)
        relation.travel = std::max(relation.travel, spread(path[i] * inverse_weight_));
    const double a_half = std::max({a.half[0], a.half[1], a.half[2]});
    const double b_half = std::max({b.half[0], b.half[1], b.half[2]});
    relation.travel += spin_ * a_half;
    relation.size = 2 * std::max(a_half, b_half);
    return relation;
}

} // namespace chasles::query
