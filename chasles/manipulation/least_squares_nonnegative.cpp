#include "chasles/manipulation/least_squares_nonnegative.h"

#include <algorithm>
#include <vector>

namespace chasles::manipulation {

namespace {

/// A slope below this share of the wanted vector is rounding: seven products and the residual are off by some units.
constexpr double least_slope = 32 * 0x1p-53;
/// A column of length 1 that is nearer than this to the span of the others would get unknowns without a reliable digit.
constexpr double least_pivot = 0x1p-36;

using Column = Eigen::Matrix<double, most_equations, 1>; ///< zero after the last equation

Column padded(const auto& equations) {
    Column column = Column::Zero();
    column.head(equations.size()) = equations;
    return column;
}

/// Columns as Q R, one more at a time, as Gram and Schmidt do. Each column is made orthogonal to the others twice,
/// which leaves Q orthogonal up to rounding.
class Factors {
public:
    void clear() { count_ = 0; }

    /// False if a column of length 1 depends on those before. Then nothing happens.
    bool append(const Column& column) {
        if (count_ == most_equations)
            return false;
        Column rest = column;
        triangle_.col(count_).setZero();
        for (int pass = 0; pass < 2; ++pass)
            for (Eigen::Index k = 0; k < count_; ++k) {
                const double along = orthonormal_.col(k).dot(rest);
                triangle_(k, count_) += along;
                rest -= along * orthonormal_.col(k);
            }
        const double pivot = rest.norm();
        if (pivot < least_pivot)
            return false;
        triangle_(count_, count_) = pivot;
        orthonormal_.col(count_) = rest / pivot;
        ++count_;
        return true;
    }

    /// The least squares: a value for each column, then zeros.
    [[nodiscard]] Column solve(const Column& wanted) const {
        Column values = Column::Zero();
        for (Eigen::Index k = count_ - 1; k >= 0; --k) {
            double left = orthonormal_.col(k).dot(wanted);
            for (Eigen::Index j = k + 1; j < count_; ++j)
                left -= triangle_(k, j) * values[j];
            values[k] = left / triangle_(k, k);
        }
        return values;
    }

private:
    using Square = Eigen::Matrix<double, most_equations, most_equations>;
    Square orthonormal_ = Square::Zero(), triangle_ = Square::Zero();
    Eigen::Index count_ = 0;
};

/// The active set: unknowns that may be positive, in the order in which they were chosen.
class ActiveSet {
public:
    ActiveSet(const Columns& columns, const Equations& wanted)
        : equations_(columns.rows()), wanted_(padded(wanted)), unit_(most_equations, columns.cols()),
          lengths_(columns.colwise().norm()), is_refused_(std::size_t(columns.cols()), false),
          now_{{}, {}, Eigen::VectorXd::Zero(columns.cols()), -wanted_} {
        for (Eigen::Index i = 0; i < unit_.cols(); ++i) {
            unit_.col(i) = padded(columns.col(i));
            if (lengths_[i] > 0) // a column of zeros has no slope and is never chosen
                unit_.col(i) /= lengths_[i];
        }
    }

    /// Begins with those of the unknowns that are positive together.
    void guess(std::span<const Eigen::Index> likely) {
        now_.active.assign(likely.begin(), likely.end());
        std::erase_if(now_.active, [&](Eigen::Index i) { return !(lengths_[i] > 0); });
        factorize();
        do {
            const Column values = now_.factors.solve(wanted_);
            Eigen::Index k = 0;
            for (const Eigen::Index i : now_.active)
                now_.unknowns[i] = std::max(0.0, values[k++]);
        } while (drop_zeros());
        find_residual();
    }

    NonnegativeSolution solve() {
        // in exact arithmetic the residual shortens with each entry, so no set comes twice; the bound is for rounding
        const Eigen::Index most_entries = 8 * (unit_.cols() + most_equations);
        Eigen::Index next = steepest();
        for (Eigen::Index entries = 0; next >= 0 && entries < most_entries; entries += enter(next), next = steepest())
            ;
        NonnegativeSolution solution{now_.unknowns, now_.residual.head(equations_)};
        for (const Eigen::Index i : now_.active)
            solution.unknowns[i] /= lengths_[i];
        return solution;
    }

private:
    struct State {
        std::vector<Eigen::Index> active;
        Factors factors;          ///< of the active columns
        Eigen::VectorXd unknowns; ///< of the columns of length 1
        Column residual;
    };

    [[nodiscard]] bool is_active(Eigen::Index i) const {
        return std::ranges::find(now_.active, i) != now_.active.end();
    }

    /// The unknown whose growth makes the residual shorter most quickly; -1 if none does.
    [[nodiscard]] Eigen::Index steepest() const {
        if (Eigen::Index(now_.active.size()) >= std::min<Eigen::Index>(equations_, unit_.cols()))
            return -1;
        Eigen::Index best = -1;
        double slope = least_slope * wanted_.norm();
        for (Eigen::Index i = 0; i < unit_.cols(); ++i)
            if (const double own = -unit_.col(i).dot(now_.residual);
                own > slope && !is_refused_[std::size_t(i)] && !is_active(i))
                slope = own, best = i;
        return best;
    }

    /// Makes an unknown positive, and keeps the change if the residual gets shorter. If not, the unknown is refused
    /// until another one has entered.
    bool enter(Eigen::Index next) {
        const State before = now_;
        if (now_.factors.append(unit_.col(next))) {
            now_.active.push_back(next);
            settle();
            // a change of 1e-9 makes the residual shorter by 1e-18, so squares of lengths must not be subtracted
            const Column change = unit_ * (before.unknowns - now_.unknowns);
            if (now_.unknowns[next] > 0 && change.dot(2 * before.residual - change) > 0) {
                is_refused_.assign(is_refused_.size(), false);
                return true;
            }
            now_ = before;
        }
        is_refused_[std::size_t(next)] = true;
        return false;
    }

    /// Goes to the least squares of the active set, and leaves out unknowns that become negative on the way.
    void settle() {
        do
            go_towards(now_.factors.solve(wanted_));
        while (drop_zeros());
        find_residual();
    }

    /// Decomposes the active columns anew. A column that depends on those before leaves the active set.
    void factorize() {
        now_.factors.clear();
        std::size_t kept = 0;
        for (const Eigen::Index i : now_.active)
            if (now_.factors.append(unit_.col(i)))
                now_.active[kept++] = i;
            else
                now_.unknowns[i] = 0;
        now_.active.resize(kept);
    }

    /// Leaves out the unknowns that are zero. False if there are none.
    bool drop_zeros() {
        if (std::erase_if(now_.active, [&](Eigen::Index i) { return now_.unknowns[i] == 0; }) == 0)
            return false;
        factorize();
        return true;
    }

    void find_residual() {
        now_.residual = -wanted_;
        for (const Eigen::Index i : now_.active)
            now_.residual += now_.unknowns[i] * unit_.col(i);
    }

    /// Until the first unknown is zero, which then is exactly so.
    void go_towards(const Column& target) {
        const auto share_until_zero = [&](std::size_t k) {
            const double now = now_.unknowns[now_.active[k]], then = target[Eigen::Index(k)];
            return then > 0 ? 2 : now / (now - then);
        };
        double share = 1;
        for (std::size_t k = 0; k < now_.active.size(); ++k)
            share = std::min(share, share_until_zero(k));
        for (std::size_t k = 0; k < now_.active.size(); ++k) {
            double& unknown = now_.unknowns[now_.active[k]];
            const double next = unknown + share * (target[Eigen::Index(k)] - unknown);
            unknown = share_until_zero(k) > share && next > 0 ? next : 0;
        }
    }

    Eigen::Index equations_;
    Column wanted_;
    Eigen::Matrix<double, most_equations, Eigen::Dynamic> unit_; ///< columns of length 1
    Eigen::VectorXd lengths_;
    std::vector<bool> is_refused_; ///< has been tried since the last change
    State now_;
};

} // namespace

NonnegativeSolution least_squares_nonnegative(const Columns& columns, const Equations& wanted,
                                              std::span<const Eigen::Index> likely) {
    ActiveSet set(columns, wanted);
    set.guess(likely);
    return set.solve();
}

} // namespace chasles::manipulation
