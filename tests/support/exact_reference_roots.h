// Exact real roots in [0, 1] of polynomials with whole coefficients: isolation by Descartes' rule of signs on dyadic
// intervals, signs of other polynomials at the roots, and the order of roots. Every case is decided.
// Source: G. Collins, A. Akritas, "Polynomial real root isolation using Descartes' rule of signs", 1976.
#pragma once

#include "tests/support/exact_reference_numbers.h"

#include <optional>
#include <stdexcept>
#include <vector>

namespace chasles::reference {

/// Coefficients of 1, tau, ...; no trailing zeros, empty for zero.
using Coefficients = std::vector<Integer>;

inline Coefficients trimmed(Coefficients p) {
    while (!p.empty() && p.back() == 0)
        p.pop_back();
    return p;
}

template <std::size_t Count>
Coefficients coefficients(const std::array<Integer, Count>& p) {
    return trimmed({p.begin(), p.end()});
}

/// The coefficients without their common divisor.
inline Coefficients primitive(Coefficients p) {
    Integer divisor(0);
    for (const Integer& c : p)
        divisor = gcd(divisor, c);
    if (divisor > 1)
        for (Integer& c : p)
            c /= divisor;
    return p;
}

/// The exact quotient by a primitive divisor. Throws if there is a remainder, which means that a formula is wrong.
inline Coefficients divided_exactly(Coefficients p, const Coefficients& by) {
    p = trimmed(std::move(p));
    if (p.empty())
        return p;
    if (p.size() < by.size())
        throw std::logic_error("exact reference: the weight does not divide");
    Coefficients quotient(p.size() - by.size() + 1);
    for (std::size_t top = quotient.size(); top-- > 0;) {
        quotient[top] = p[top + by.size() - 1] / by.back();
        for (std::size_t i = 0; i < by.size(); ++i)
            p[top + i] -= quotient[top] * by[i];
    }
    if (!trimmed(std::move(p)).empty())
        throw std::logic_error("exact reference: the weight does not divide");
    return quotient;
}

/// The greatest common divisor, up to a positive or negative factor.
inline Coefficients common_divisor(Coefficients a, Coefficients b) {
    a = primitive(std::move(a));
    while (!b.empty()) {
        b = primitive(std::move(b));
        while (a.size() >= b.size()) { // a pseudo-remainder
            const Integer lead = a.back();
            const std::size_t shift = a.size() - b.size();
            for (Integer& c : a)
                c *= b.back();
            for (std::size_t i = 0; i < b.size(); ++i)
                a[shift + i] -= lead * b[i];
            a = trimmed(std::move(a));
        }
        std::swap(a, b);
    }
    return a;
}

inline Coefficients square_free(const Coefficients& p) {
    Coefficients derivative;
    for (std::size_t i = 1; i < p.size(); ++i)
        derivative.push_back(p[i] * Integer(static_cast<long>(i)));
    return primitive(divided_exactly(primitive(p), common_divisor(p, derivative)));
}

/// The interval ]from, from + 1[ over 2^depth.
struct Cell {
    Integer from;
    unsigned depth = 0;
};

/// The sign of p at from / 2^depth.
inline int sign_at_dyadic(const Coefficients& p, const Integer& from, unsigned depth) {
    Integer value(0);
    for (std::size_t i = p.size(); i-- > 0;)
        value = value * from + Integer(p[i] << static_cast<unsigned>(depth * (p.size() - 1 - i)));
    return value.sign();
}

/// Bernstein coefficients on a cell, each times a positive number.
inline Coefficients bernstein_on(const Coefficients& p, const Cell& cell) {
    const std::size_t count = p.size();
    Coefficients local(count);
    for (std::size_t i = 0; i < count; ++i)
        local[i] = p[i] << static_cast<unsigned>(cell.depth * (count - 1 - i));
    for (std::size_t i = 0; i + 1 < count && cell.from != 0; ++i) // Taylor shift
        for (std::size_t j = count - 1; j-- > i;)
            local[j] += local[j + 1] * cell.from;
    Coefficients result(count, Integer(0));
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i <= k; ++i)
            result[k] += local[i] * Integer(binomial(count - 1 - i, k - i));
    return result;
}

struct Signs {
    int variations = 0; ///< the number of roots in the open cell, plus an even number
    int first = 0;      ///< the sign just after the cell's lower end
};

inline Signs signs_of(const Coefficients& bernstein) {
    Signs signs;
    int last = 0;
    for (const Integer& c : bernstein) {
        const int sign = c.sign();
        if (sign == 0)
            continue;
        signs.variations += sign * last < 0 ? 1 : 0;
        signs.first = signs.first == 0 ? sign : signs.first;
        last = sign;
    }
    return signs;
}

/// One real root: a dyadic number, or the only root of a polynomial in a cell, which is simple.
class Root {
public:
    static Root point(const Integer& at, unsigned depth) { return {{}, {at, depth}, true, 0}; }
    /// The root at a double in [0, 1].
    static Root point(double x) {
        int exponent = 0;
        const auto mantissa = static_cast<long long>(std::ldexp(std::frexp(x, &exponent), 53));
        if (exponent > 53 || x < 0)
            throw std::logic_error("exact reference: a tau out of its range");
        return point(Integer(mantissa), static_cast<unsigned>(53 - exponent));
    }
    static Root in_cell(const Coefficients& p, const Cell& cell, int sign_behind_lower) {
        return {p, cell, false, sign_behind_lower};
    }

    /// The sign of q at the root.
    int sign(const Coefficients& q);

    /// -1, 0 or 1 if `a` is before, equal to, or after `b`.
    friend int compare(Root& a, Root& b);

    [[nodiscard]] double lower() const {
        return static_cast<double>(Rational(cell_.from, Integer(Integer(1) << cell_.depth)));
    }
    /// Whether the root is before `other` by the current cells. False does not prove the contrary.
    [[nodiscard]] bool is_plainly_before(const Root& other) const {
        return aligned(upper_end(), cell_.depth, other.cell_.depth) <=
               aligned(other.cell_.from, other.cell_.depth, cell_.depth);
    }
    /// An approximation within 2^-bits.
    Rational narrowed(unsigned bits = 60) {
        while (!is_point_ && cell_.depth < bits)
            narrow();
        return {cell_.from, Integer(Integer(1) << cell_.depth)};
    }

private:
    Root(Coefficients p, Cell cell, bool is_point, int sign)
        : polynomial_(std::move(p)), cell_(std::move(cell)), is_point_(is_point), sign_behind_lower_(sign) {}

    [[nodiscard]] Integer upper_end() const { return is_point_ ? cell_.from : Integer(cell_.from + 1); }
    static Integer aligned(const Integer& x, unsigned depth, unsigned other) {
        return other > depth ? Integer(x << (other - depth)) : x;
    }
    /// Whether a divisor of the polynomial has this root. The cell has at most one root of the divisor, and it is
    /// simple.
    [[nodiscard]] bool is_root_of(const Coefficients& divisor) const {
        return divisor.size() > 1 && signs_of(bernstein_on(divisor, cell_)).variations % 2 == 1;
    }

    void halve() {
        const Cell right{2 * cell_.from + 1, cell_.depth + 1};
        const int middle = sign_at_dyadic(polynomial_, right.from, right.depth);
        is_point_ = middle == 0;
        cell_ = middle == 0 || middle == sign_behind_lower_ ? right : Cell{2 * cell_.from, right.depth};
    }

    /// Narrows the cell to about 2^-40 of its width, by a guess in doubles that the signs at both ends prove. If this
    /// fails, halves the cell.
    void narrow() {
        constexpr unsigned steps = 40;
        const Coefficients bernstein = bernstein_on(polynomial_, cell_);
        const double share = root_in_doubles(bernstein);
        const Integer from = (cell_.from << steps) + Integer(static_cast<long long>(std::ldexp(share, steps)));
        const Cell guess{from, cell_.depth + steps};
        if (sign_at_dyadic(polynomial_, guess.from, guess.depth) == sign_behind_lower_ &&
            sign_at_dyadic(polynomial_, guess.from + 1, guess.depth) == -sign_behind_lower_)
            cell_ = guess;
        else
            halve();
    }

    /// An approximation in [0, 1[ of the sign change of the polynomial with these Bernstein coefficients (times
    /// binomials).
    static double root_in_doubles(const Coefficients& bernstein) {
        unsigned bits = 0;
        for (const Integer& c : bernstein)
            bits = std::max(bits, c == 0 ? 0u : unsigned(msb(abs(c))));
        std::vector<double> c;
        for (const Integer& b : bernstein)
            c.push_back(static_cast<double>(Integer(bits > 60 ? b >> (bits - 60) : b)));
        const auto value = [&](double x) {
            double result = 0;
            double power = 1;
            for (std::size_t i = 0; i < c.size(); ++i, power *= x)
                result += c[i] * power * std::pow(1 - x, double(c.size() - 1 - i));
            return result;
        };
        double lower = 0;
        double upper = 1;
        const double sign = signs_of(bernstein).first;
        for (int i = 0; i < 45; ++i) {
            const double middle = 0.5 * (lower + upper);
            (value(middle) * sign > 0 ? lower : upper) = middle;
        }
        return lower;
    }

    Coefficients polynomial_;
    Cell cell_;
    bool is_point_ = false;
    int sign_behind_lower_ = 0;
};

inline int Root::sign(const Coefficients& q) {
    if (q.empty())
        return 0;
    for (int tries = 0;; ++tries) {
        if (is_point_)
            return sign_at_dyadic(q, cell_.from, cell_.depth);
        const Signs signs = signs_of(bernstein_on(q, cell_));
        if (signs.variations == 0)
            return signs.first;
        if (tries == 2 && is_root_of(common_divisor(polynomial_, q)))
            return 0;
        narrow();
    }
}

inline int compare(Root& a, Root& b) {
    for (int tries = 0;; ++tries) {
        if (a.is_point_ && b.is_point_)
            return Root::aligned(a.cell_.from, a.cell_.depth, b.cell_.depth)
                .compare(Root::aligned(b.cell_.from, b.cell_.depth, a.cell_.depth));
        if (a.is_plainly_before(b))
            return -1;
        if (b.is_plainly_before(a))
            return 1;
        if (a.is_point_ || b.is_point_) { // inside the other one's cell
            const Root& at = a.is_point_ ? a : b;
            const Root& other = a.is_point_ ? b : a;
            const int there = sign_at_dyadic(other.polynomial_, at.cell_.from, at.cell_.depth);
            const int order = there == 0 ? 0 : there == other.sign_behind_lower_ ? -1 : 1;
            return a.is_point_ ? order : -order;
        }
        if (tries > 1) {
            const Coefficients shared = common_divisor(a.polynomial_, b.polynomial_);
            const Integer a_from = Root::aligned(a.cell_.from, a.cell_.depth, b.cell_.depth);
            const Integer b_from = Root::aligned(b.cell_.from, b.cell_.depth, a.cell_.depth);
            const Integer a_to = Root::aligned(a.upper_end(), a.cell_.depth, b.cell_.depth);
            const Integer b_to = Root::aligned(b.upper_end(), b.cell_.depth, a.cell_.depth);
            if (a.is_root_of(shared) && b.is_root_of(shared) &&
                ((a_from >= b_from && a_to <= b_to) || (b_from >= a_from && b_to <= a_to)))
                return 0; // one cell holds the other, and only one root
        }
        a.narrow();
        if (!b.is_point_)
            b.narrow();
    }
}

namespace detail {

/// False if the cells became too small: then the polynomial has a multiple root.
inline bool isolate(const Coefficients& p, const Cell& cell, unsigned deepest, std::vector<Root>& roots) {
    const Signs signs = signs_of(bernstein_on(p, cell));
    if (signs.variations == 0)
        return true;
    if (signs.variations == 1) {
        roots.push_back(Root::in_cell(p, cell, signs.first));
        return true;
    }
    if (cell.depth == deepest)
        return false;
    const Cell left{2 * cell.from, cell.depth + 1};
    const Cell right{2 * cell.from + 1, cell.depth + 1};
    if (!isolate(p, left, deepest, roots))
        return false;
    if (sign_at_dyadic(p, right.from, right.depth) == 0)
        roots.push_back(Root::point(right.from, right.depth));
    return isolate(p, right, deepest, roots);
}

} // namespace detail

/// The distinct roots in [0, 1], in order. `p` must not be zero.
inline std::vector<Root> roots_of(const Coefficients& p) {
    std::vector<Root> roots;
    const auto isolate_all = [&](const Coefficients& q, unsigned deepest) {
        roots.clear();
        if (sign_at_dyadic(q, 0, 0) == 0)
            roots.push_back(Root::point(0, 0));
        if (!detail::isolate(q, {0, 0}, deepest, roots))
            return false;
        if (sign_at_dyadic(q, 1, 0) == 0)
            roots.push_back(Root::point(1, 0));
        return true;
    };
    if (!isolate_all(p, 16))
        isolate_all(square_free(p), 100000);
    return roots;
}

} // namespace chasles::reference
