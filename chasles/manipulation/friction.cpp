#include "chasles/manipulation/friction.h"

#include "chasles/base/sort.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <utility>
#include <vector>

namespace chasles::manipulation {

namespace {

/// What remains of the wish is rounding, or not worth another iteration.
constexpr double negligible = 0x1p-26;
constexpr double cone_rounding = 0x1p-30;
constexpr int most_solutions = 150; ///< of the convex problem with planes, in all rounds; for the worst case
constexpr int most_rounds = 30;
constexpr std::size_t most_new_cuts = 12;

/// The convex problem: the twist nearest to a wish, |v - wish|_M, for which n v + gap >= coefficient * |T v| at each
/// contact. Its cones are approached by planes, each of which touches its cone at the twist that the planes before have
/// left.
class ConeTwist {
public:
    explicit ConeTwist(const FrictionProblem& problem)
        : problem_(problem), root_(problem.metric), normals_(in_unit_metric(problem.normals.rows)),
          tangents_(in_unit_metric(problem.tangents)),
          scales_(cone_rounding * (1 + problem.coefficient) * normals_.rowwise().norm()) {}

    /// The planes of the last call that push are kept for the next one.
    FrictionForces solve(const Eigen::VectorXd& gaps, const Twist& wish) {
        const Twist wanted = root_.matrixU() * wish;
        AdmissibleTwist answer{wanted, Eigen::VectorXd()};
        do {
            answer = admissible_twist(constraints(gaps), wanted, pushing_);
            find_pushing(answer);
            // not the answer's twist, which is at rest where rounding violates a plane
            answer.twist = wanted + answer.wrench;
            ++solutions_;
        } while (!is_exhausted() && cut(answer, gaps, wanted.norm()));
        return forces_of(answer);
    }

    /// The last answer may leave the cones.
    [[nodiscard]] bool is_exhausted() const { return solutions_ >= most_solutions; }

private:
    /// A plane at the cone of a contact.
    struct Cut {
        Eigen::Index contact = 0;
        Eigen::Vector2d friction = Eigen::Vector2d::Zero(); ///< its direction; of length 1, or 0 at the tip of the cone
    };

    /// For twists L^T v, M = L L^T, whose metric is the unit matrix.
    [[nodiscard]] Rows in_unit_metric(const Rows& rows) const {
        return root_.matrixL().solve(rows.transpose()).transpose();
    }

    [[nodiscard]] Eigen::Vector2d sliding(Eigen::Index contact, const Twist& twist) const {
        return tangents_.middleRows<2>(2 * contact) * twist;
    }

    [[nodiscard]] TwistConstraints constraints(const Eigen::VectorXd& gaps) const {
        const auto count = Eigen::Index(cuts_.size());
        TwistConstraints planes{Rows(count, 6), Eigen::VectorXd(count)};
        for (Eigen::Index k = 0; k < count; ++k) {
            const auto& [contact, friction] = cuts_[std::size_t(k)];
            planes.rows.row(k) = normals_.row(contact) +
                                 problem_.coefficient * (friction.transpose() * tangents_.middleRows<2>(2 * contact));
            planes.gaps[k] = gaps[contact];
        }
        return planes;
    }

    /// The cones that the twist leaves most: minus by how much, and which one.
    [[nodiscard]] std::vector<std::pair<double, Eigen::Index>>
    cones_left(const AdmissibleTwist& answer, const Eigen::VectorXd& gaps, double length) const {
        std::vector<std::pair<double, Eigen::Index>> left;
        for (Eigen::Index i = 0; i < gaps.size(); ++i) {
            const double above = normals_.row(i).dot(answer.twist) + gaps[i];
            const double excess = problem_.coefficient * sliding(i, answer.twist).norm() - above;
            if (excess > scales_[i] * length)
                left.emplace_back(-excess, i);
        }
        chasles::sort(left);
        left.resize(std::min(left.size(), most_new_cuts));
        return left;
    }

    void find_pushing(const AdmissibleTwist& answer) {
        pushing_.clear();
        for (Eigen::Index k = 0; k < answer.multipliers.size(); ++k)
            if (answer.multipliers[k] > 0)
                pushing_.push_back(k);
    }

    /// Adds planes where the twist leaves the cones most, and drops those that do not push. False if it leaves none.
    bool cut(const AdmissibleTwist& answer, const Eigen::VectorXd& gaps, double length) {
        const std::vector<std::pair<double, Eigen::Index>> left = cones_left(answer, gaps, length);
        if (left.empty())
            return false;
        for (std::size_t k = 0; k < pushing_.size(); ++k) // ascending
            cuts_[k] = cuts_[std::size_t(std::exchange(pushing_[k], Eigen::Index(k)))];
        cuts_.resize(pushing_.size());
        for (const auto& [excess, contact] : left)
            cuts_.push_back({contact, -sliding(contact, answer.twist).stableNormalized()});
        return true;
    }

    [[nodiscard]] FrictionForces forces_of(const AdmissibleTwist& answer) const {
        FrictionForces forces{root_.matrixU().solve(answer.twist), Eigen::VectorXd::Zero(scales_.size()),
                              Eigen::VectorXd::Zero(2 * scales_.size())};
        for (Eigen::Index k = 0; k < answer.multipliers.size(); ++k) {
            const auto& [contact, friction] = cuts_[std::size_t(k)];
            forces.normal[contact] += answer.multipliers[k];
            forces.tangential.segment<2>(2 * contact) += problem_.coefficient * answer.multipliers[k] * friction;
        }
        return forces;
    }

    const FrictionProblem& problem_;
    Eigen::LLT<Metric> root_;
    Rows normals_, tangents_; ///< for the unit metric
    Eigen::VectorXd scales_;  ///< of what is rounding, for a wish of length 1
    std::vector<Cut> cuts_;
    std::vector<Eigen::Index> pushing_; ///< of the cuts, in the last answer
    int solutions_ = 0;
};

/// Anderson's acceleration of x -> f(x), for few unknowns.
class Acceleration {
public:
    /// The next x, after x has led to f(x).
    Twist next(const Twist& x, const Twist& image) {
        const Twist residual = image - x;
        if (has_last_)
            remember(residual - last_residual_, image - last_image_);
        last_residual_ = residual;
        last_image_ = image;
        has_last_ = true;
        if (count_ == 0)
            return image;
        const Eigen::Index used = std::min<Eigen::Index>(count_, memory);
        const Eigen::VectorXd weights =
            Eigen::ColPivHouseholderQR<Directions>(residuals_.leftCols(used)).solve(residual);
        return image - images_.leftCols(used) * weights;
    }

private:
    static constexpr Eigen::Index memory = 6;
    void remember(const Twist& residual, const Twist& image) {
        residuals_.col(count_ % memory) = residual;
        images_.col(count_ % memory) = image;
        ++count_;
    }

    using History = Eigen::Matrix<double, 6, memory>;
    History residuals_ = History::Zero(), images_ = History::Zero(); ///< differences
    Twist last_residual_ = Twist::Zero(), last_image_ = Twist::Zero();
    Eigen::Index count_ = 0;
    bool has_last_ = false;
};

/// How far each contact slides.
Eigen::VectorXd slides(const FrictionProblem& problem, const Twist& twist) {
    const Eigen::VectorXd along = problem.tangents * twist;
    Eigen::VectorXd lengths(along.size() / 2);
    for (Eigen::Index i = 0; i < lengths.size(); ++i)
        lengths[i] = along.segment<2>(2 * i).norm();
    return lengths;
}

} // namespace

void keep_nearer(FrictionProblem& problem, double most_gap) {
    for (Eigen::Index i = 0; i < problem.normals.gaps.size(); ++i) {
        if (problem.normals.gaps[i] <= most_gap)
            continue;
        problem.normals.rows.row(i).setZero();
        if (problem.tangents.rows() > 0)
            problem.tangents.middleRows<2>(2 * i).setZero();
    }
}

FrictionForces holding_forces(const FrictionProblem& problem, const Twist& wish) {
    return ConeTwist(problem).solve(Eigen::VectorXd::Zero(problem.normals.gaps.size()), wish);
}

bool is_held(const FrictionProblem& problem, const FrictionForces& holding, const Twist& wish) {
    const double left = holding.twist.dot(problem.metric * holding.twist);
    return left <= negligible * negligible * wish.dot(problem.metric * wish);
}

FrictionForces sliding_forces(const FrictionProblem& problem, const Twist& wish) {
    const double tolerance = negligible * std::sqrt(wish.dot(problem.metric * wish));
    ConeTwist cones(problem);
    Acceleration acceleration;
    Twist slid = Twist::Zero();
    FrictionForces forces;
    for (int i = 0; i < most_rounds; ++i) {
        // the cones, opened by as much as the sliding would lift the body
        forces = cones.solve(problem.normals.gaps + problem.coefficient * slides(problem, slid), wish);
        const Twist change = forces.twist - slid;
        forces.has_converged = std::sqrt(change.dot(problem.metric * change)) <= tolerance && !cones.is_exhausted();
        if (forces.has_converged || cones.is_exhausted())
            break;
        slid = acceleration.next(slid, forces.twist);
    }
    return forces;
}

Twist changed_wish(const FrictionProblem& problem, const FrictionForces& forces, const Twist& wish) {
    return wish + problem.metric.llt().solve(problem.tangents.transpose() * forces.tangential);
}

} // namespace chasles::manipulation
