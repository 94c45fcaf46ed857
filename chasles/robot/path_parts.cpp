// Polynomials are cut in exact arithmetic, so that no digits cancel. Even turns are cut in double-double.
#include "chasles/robot/path_parts.h"

#include "chasles/algebra/dyadic.h"
#include "chasles/algebra/sine_cosine.h"
#include "chasles/robot/model.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace chasles::robot {

namespace {

using algebra::Dyadic;
using Segment = JointPath::Segment;
using Wide = algebra::DoubleDouble;

/// The binary digits of shares of a segment, which are quotients.
constexpr int digits_of_shares = 200;

/// a / b for 0 <= a and 0 < b, rounded down to 200 binary digits or more.
Dyadic quotient(const Dyadic& a, const Dyadic& b) {
    const int shift = digits_of_shares + std::max(0, int(b.digits()) - int(a.digits()));
    return {Dyadic::Integer(Dyadic::Integer(a.mantissa() << unsigned(shift)) / b.mantissa()),
            a.exponent() - b.exponent() - shift};
}

/// The share of the segment that has passed at a stamp.
Dyadic share_at(const Segment& segment, double stamp) {
    const Dyadic begin(segment.begin);
    return quotient(Dyadic(stamp) - begin, Dyadic(segment.end) - begin);
}

/// The number with about 105 binary digits.
Wide rounded(const Dyadic& number) {
    const double high = number.truncated();
    return Wide::exact_sum(high, (number - Dyadic(high)).truncated());
}

std::vector<Dyadic> exact_coefficients(const Segment& segment, Eigen::Index variable) {
    std::vector<Dyadic> all;
    for (Eigen::Index k = 0; k < segment.coefficients.rows(); ++k) {
        all.emplace_back(segment.coefficients(k, variable));
        if (segment.remainders.size() > 0)
            all.back() += Dyadic(segment.remainders(k, variable));
    }
    return all;
}

/// The polynomial of the share of a part [start, start + width].
void restrict_to(std::vector<Dyadic>& coefficients, const Dyadic& start, const Dyadic& width) {
    for (std::size_t first = 0; first + 1 < coefficients.size(); ++first)
        for (std::size_t k = coefficients.size() - 1; k-- > first;)
            coefficients[k] += start * coefficients[k + 1];
    Dyadic power(1.0);
    for (Dyadic& c : coefficients) {
        c = c * power;
        power = power * width;
    }
}

Segment empty_segment(double begin, double end, Eigen::Index rows, Eigen::Index columns) {
    return {begin, end, Eigen::MatrixXd::Zero(rows, columns), Eigen::MatrixXd::Zero(rows, columns)};
}

void set(Segment& segment, Eigen::Index power, Eigen::Index variable, const Wide& value) {
    segment.coefficients(power, variable) = value.high();
    segment.remainders(power, variable) = value.low();
}

/// The orientation of a floating joint (x, y, z, w) at a share of a segment.
std::array<Wide, 4> orientation_at(const SegmentMotion::Turn& turn, const Wide& share) {
    const auto [sine, cosine] = algebra::sine_cosine(Wide(0.5) * turn.joint.value->at(share));
    const motion::Quaternion<Wide> q =
        turn.start.refined.rotation * motion::Quaternion<Wide>{cosine, scale(turn.joint.axis.refined, sine)};
    return {q.v.x, q.v.y, q.v.z, q.w};
}

} // namespace

Segment part_of(const Segment& segment, double lower, double upper, std::span<const std::size_t> quaternions) {
    if (lower == segment.begin && upper == segment.end)
        return segment;
    const Dyadic start = share_at(segment, lower), end = share_at(segment, upper);
    const Eigen::Index rows = segment.coefficients.rows(), columns = segment.coefficients.cols();
    Segment part = empty_segment(lower, upper, rows, columns);
    for (Eigen::Index i = 0; i < columns; ++i) {
        std::vector<Dyadic> coefficients = exact_coefficients(segment, i);
        restrict_to(coefficients, start, end - start);
        for (Eigen::Index k = 0; k < rows; ++k)
            set(part, k, i, rounded(coefficients[std::size_t(k)]));
    }
    for (const std::size_t first : quaternions) {
        const SegmentMotion::Turn turn = turn_of(segment, first);
        const auto from = orientation_at(turn, rounded(start)), to = orientation_at(turn, rounded(end));
        for (std::size_t i = 0; i < from.size(); ++i) {
            set(part, 0, Eigen::Index(first + i), from[i]);
            set(part, 1, Eigen::Index(first + i), to[i] - from[i]);
        }
    }
    return part;
}

Segment rest_at_begin(const Segment& segment) {
    Segment rest = empty_segment(segment.begin, segment.end, 1, segment.coefficients.cols());
    rest.coefficients.row(0) = segment.coefficients.row(0);
    if (segment.remainders.size() > 0)
        rest.remainders.row(0) = segment.remainders.row(0);
    return rest;
}

Segment rest_at_end(const Segment& segment) {
    Segment rest = empty_segment(segment.begin, segment.end, 1, segment.coefficients.cols());
    for (Eigen::Index i = 0; i < segment.coefficients.cols(); ++i) {
        Dyadic sum;
        for (const Dyadic& c : exact_coefficients(segment, i))
            sum += c;
        set(rest, 0, i, rounded(sum));
    }
    return rest;
}

} // namespace chasles::robot
