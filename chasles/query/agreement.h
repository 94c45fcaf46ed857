// Whether all gradients at a minimum are one. Source: docs/derivations/41-gradients.md, "Where it is defined".
#pragma once

#include "chasles/base/limit_of_thread.h"

#include <Eigen/Core>

#include <algorithm>
#include <optional>
#include <utility>

namespace chasles::query {

class Agreement {
public:
    /// Of turns about points that are up to `lever` away.
    explicit Agreement(double lever) : noise_(rounding_of_steps * std::max(1.0, lever)) {}

    /// Whether the gradient is the first one, up to the rounding of its time and points, and that of differences of
    /// places. If not, or if the limit of the thread is reached, no others need be added.
    bool add(Eigen::VectorXd gradient) {
        if (!first_) {
            first_ = std::move(gradient);
            return true;
        }
        const double size = std::max(first_->norm(), gradient.norm());
        is_one_ = is_one_ && !is_cancelled() && (gradient - *first_).norm() <= rounding * size + noise_;
        return is_one_;
    }
    [[nodiscard]] const Eigen::VectorXd& first() const { return *first_; }
    /// Whether all that were added agree.
    [[nodiscard]] bool is_one() const { return is_one_; }

private:
    static constexpr double rounding = 0x1p-20, rounding_of_steps = 0x1p-28;

    double noise_;
    std::optional<Eigen::VectorXd> first_;
    bool is_one_ = true;
};

} // namespace chasles::query
