#include "chasles/manipulation/least_squares_nonnegative.h"

#include <Eigen/QR>

#include <algorithm>
#include <vector>

namespace chasles::manipulation {

namespace {

/// A slope below this share of the wanted vector is rounding: seven products and the residual are off by some units.
constexpr double least_slope = 32 * 0x1p-53;
/// A column of length 1 that is nearer than this to the span of the others would get unknowns without a reliable digit.
constexpr double least_pivot = 0x1p-36;

/// The active set: unknowns that may be positive, in the order in which they were chosen.
class ActiveSet {
public:
    ActiveSet(const Columns& columns, const Equations& wanted)
        : wanted_(wanted), unit_(columns), lengths_(columns.colwise().norm()), is_refused_(columns.cols(), false),
          unknowns_(Eigen::VectorXd::Zero(columns.cols())), residual_(-wanted) {
        for (Eigen::Index i = 0; i < unit_.cols(); ++i)
            if (lengths_[i] > 0) // a column of zeros has no slope and is never chosen
                unit_.col(i) /= lengths_[i];
    }

    /// Begins with those of the unknowns that are positive together.
    void guess(std::span<const Eigen::Index> likely) {
        active_.assign(likely.begin(), likely.end());
        std::erase_if(active_, [&](Eigen::Index i) { return !(lengths_[i] > 0); });
        if (Eigen::Index(active_.size()) > unit_.rows())
            active_.resize(std::size_t(unit_.rows()));
        while (!active_.empty()) {
            const Factors factors(active_columns());
            if (are_dependent(factors))
                return active_.clear();
            const Values values = factors.solve(wanted_);
            if (values.minCoeff() > 0) {
                for (std::size_t k = 0; k < active_.size(); ++k)
                    unknowns_[active_[k]] = values[Eigen::Index(k)];
                return find_residual();
            }
            std::size_t k = 0;
            std::erase_if(active_, [&](Eigen::Index) { return !(values[Eigen::Index(k++)] > 0); });
        }
    }

    NonnegativeSolution solve() {
        // in exact arithmetic the residual shortens with each entry, so no set comes twice; the bound is for rounding
        const Eigen::Index most_entries = 8 * (unit_.cols() + most_equations);
        Eigen::Index next = steepest();
        for (Eigen::Index entries = 0; next >= 0 && entries < most_entries; entries += enter(next), next = steepest())
            ;
        for (Eigen::Index i = 0; i < unknowns_.size(); ++i)
            if (unknowns_[i] > 0)
                unknowns_[i] /= lengths_[i];
        return {unknowns_, residual_};
    }

private:
    using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_equations, 1>;
    using Part = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_equations, most_equations>;
    using Factors = Eigen::ColPivHouseholderQR<Part>;

    [[nodiscard]] bool is_active(Eigen::Index i) const { return std::ranges::find(active_, i) != active_.end(); }

    /// The unknown whose growth makes the residual shorter most quickly; -1 if none does.
    [[nodiscard]] Eigen::Index steepest() const {
        if (Eigen::Index(active_.size()) >= std::min<Eigen::Index>(unit_.rows(), unit_.cols()))
            return -1;
        Eigen::Index best = -1;
        double slope = least_slope * wanted_.norm();
        for (Eigen::Index i = 0; i < unit_.cols(); ++i)
            if (const double own = -unit_.col(i).dot(residual_);
                own > slope && !is_refused_[std::size_t(i)] && !is_active(i))
                slope = own, best = i;
        return best;
    }

    /// Makes an unknown positive, and keeps the change if the residual gets shorter. If not, the unknown is refused
    /// until another one has entered.
    bool enter(Eigen::Index next) {
        const std::vector<Eigen::Index> before = active_;
        const Eigen::VectorXd unknowns_before = unknowns_;
        const Equations residual_before = residual_;
        active_.push_back(next);
        settle();
        // a change of 1e-9 makes the residual shorter by 1e-18, so squares of lengths must not be subtracted
        const Equations change = unit_ * (unknowns_before - unknowns_);
        if (unknowns_[next] > 0 && change.dot(2 * residual_before - change) > 0) {
            is_refused_.assign(is_refused_.size(), false);
            return true;
        }
        active_ = before;
        unknowns_ = unknowns_before;
        residual_ = residual_before;
        is_refused_[std::size_t(next)] = true;
        return false;
    }

    /// Goes to the least squares of the active set, and leaves out unknowns that become negative on the way.
    void settle() {
        while (!active_.empty()) {
            const Factors factors(active_columns());
            if (are_dependent(factors))
                return; // the residual stays as it is
            go_towards(factors.solve(wanted_));
            if (std::erase_if(active_, [&](Eigen::Index i) { return unknowns_[i] == 0; }) == 0)
                break;
        }
        find_residual();
    }

    void find_residual() {
        residual_ = -wanted_;
        for (const Eigen::Index i : active_)
            residual_ += unknowns_[i] * unit_.col(i);
    }

    [[nodiscard]] static bool are_dependent(const Factors& factors) {
        return std::abs(factors.matrixR()(factors.cols() - 1, factors.cols() - 1)) < least_pivot;
    }

    /// Until the first unknown is zero, which then is exactly so.
    void go_towards(const Values& target) {
        const auto share_until_zero = [&](std::size_t k) {
            const double now = unknowns_[active_[k]], then = target[Eigen::Index(k)];
            return then > 0 ? 2 : now / (now - then);
        };
        double share = 1;
        for (std::size_t k = 0; k < active_.size(); ++k)
            share = std::min(share, share_until_zero(k));
        for (std::size_t k = 0; k < active_.size(); ++k) {
            double& unknown = unknowns_[active_[k]];
            const double next = unknown + share * (target[Eigen::Index(k)] - unknown);
            unknown = share_until_zero(k) > share && next > 0 ? next : 0;
        }
    }

    [[nodiscard]] Part active_columns() const {
        Part part(unit_.rows(), Eigen::Index(active_.size()));
        for (std::size_t k = 0; k < active_.size(); ++k)
            part.col(Eigen::Index(k)) = unit_.col(active_[k]);
        return part;
    }

    const Equations& wanted_;
    Columns unit_; ///< columns of length 1
    Eigen::VectorXd lengths_;
    std::vector<bool> is_refused_; ///< has been tried since the last change
    std::vector<Eigen::Index> active_;
    Eigen::VectorXd unknowns_; ///< of the columns of length 1
    Equations residual_;
};

} // namespace

NonnegativeSolution least_squares_nonnegative(const Columns& columns, const Equations& wanted,
                                              std::span<const Eigen::Index> likely) {
    ActiveSet set(columns, wanted);
    set.guess(likely);
    return set.solve();
}

} // namespace chasles::manipulation
