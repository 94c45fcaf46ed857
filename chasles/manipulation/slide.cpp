#include "chasles/manipulation/slide.h"

#include "chasles/motion/motion.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>

namespace chasles::manipulation {

namespace {

/// The longest step along contacts: of the size of the body, and in radians.
constexpr double longest_way = 0.5;
constexpr double longest_turn = 0.5;
/// What is shorter than this share of the margin does not matter.
constexpr double negligible = 0x1p-10;
/// Contacts keep this share of the margin during a step; the certified step asks for less (`safe_level`).
constexpr double kept_share = 0.75;
/// The spring loses at least this share of what it would lose by its force at the start of the step.
constexpr double least_gain = 0.1;
/// Each halves the wish. A hand that pulls by 500 margins may turn a body that is easy to turn by 10,000 margins: ten
/// are too few. A step that is too short to count ends them.
constexpr int attempts = 24;

TwistConstraints constraints_of(const SlideProblem& problem) {
    const auto count = Eigen::Index(problem.contacts.size());
    TwistConstraints constraints{Rows(count, 6), Eigen::VectorXd(count)};
    const Eigen::Vector3d centre = problem.pose.isometry() * problem.spring.centre();
    for (Eigen::Index i = 0; i < count; ++i) {
        const Contact& contact = problem.contacts[std::size_t(i)].contact;
        constraints.rows.row(i) << contact.normal.transpose(),
            (contact.point - centre).cross(contact.normal).transpose();
        constraints.gaps[i] = contact.gap;
    }
    return constraints;
}

class Slider {
public:
    explicit Slider(const SlideProblem& problem)
        : problem_(problem), contacts_(constraints_of(problem)), metric_(problem.spring.metric(problem.pose)),
          wish_(problem.spring.wish(problem.pose, problem.goal)), answers_(6, contacts_.rows.rows()) {
        answers_ = metric_.llt().solve(contacts_.rows.transpose());
        kept_ = problem.margin;
        for (const ModelledContact& contact : problem.contacts)
            kept_ = std::min(kept_, contact.contact.gap);
        kept_ *= kept_share;
    }

    Slide run() const {
        if (is_free())
            return {SlideKind::free, problem_.goal};
        const Twist recovery = recovery_for(Eigen::VectorXd::Zero(contacts_.gaps.size()));
        const Pose recovered = displaced_by(recovery);
        // far within the margin the next step would be certified for little, and blocked by what it gains
        if (kept_ < kept_share * kept_share * problem_.margin && !is_short(recovery))
            return {SlideKind::partial, recovered};
        double share = 1; // of the wish
        for (int i = 0; i < attempts; ++i) {
            const Twist step = step_for(share * wish_);
            if (is_short(step))
                break;
            const double excess = excess_of(step, problem_.size);
            if (const Pose end = displaced_by(step);
                excess <= 1 && keeps_gaps(end) && loses_energy(recovered, end, step - recovery))
                return {SlideKind::partial, end};
            share /= std::max(2.0, excess);
        }
        return is_short(recovery) ? Slide{SlideKind::rest, problem_.pose} : Slide{SlideKind::partial, recovered};
    }

private:
    [[nodiscard]] Pose displaced_by(const Twist& step) const {
        return displaced(problem_.pose, problem_.spring.centre(), step);
    }

    [[nodiscard]] double length_of(const Twist& step) const {
        return step.head<3>().norm() + problem_.size * step.tail<3>().norm();
    }
    [[nodiscard]] bool is_short(const Twist& step) const { return length_of(step) < problem_.rest; }

    /// How many times the longest step along contacts.
    [[nodiscard]] static double excess_of(const Twist& step, double size) {
        return std::max(step.head<3>().norm() / (longest_way * size), step.tail<3>().norm() / longest_turn);
    }

    /// Whether the screw to the goal leads away from all contacts, or along them.
    [[nodiscard]] bool is_free() const {
        const double tolerance = negligible * problem_.margin;
        const Pose soon = Motion::screw(problem_.pose, problem_.goal).pose_at(0x1p-10);
        const Displacement displacement = Displacement::between(problem_.pose, soon);
        const auto leads_away = [&](const ModelledContact& contact) {
            const double lost = (contact.contact.gap - gap_after(contact, displacement)) * 0x1p10;
            return lost <= std::max(0.0, contact.contact.gap - problem_.margin) + tolerance;
        };
        return std::ranges::all_of(problem_.contacts, leads_away) && keeps_gaps(problem_.goal);
    }

    /// In the middle and at the end of the screw.
    [[nodiscard]] bool keeps_gaps(const Pose& end) const {
        const Pose middle = Motion::screw(problem_.pose, end).pose_at(0.5);
        const Displacement half = Displacement::between(problem_.pose, middle);
        const Displacement whole = Displacement::between(problem_.pose, end);
        return std::ranges::all_of(problem_.contacts, [&](const ModelledContact& contact) {
            return std::min(gap_after(contact, half), gap_after(contact, whole)) >= kept_;
        });
    }

    [[nodiscard]] bool loses_energy(const Pose& from, const Pose& end, const Twist& step) const {
        const double work = wish_.dot(metric_ * step);
        return problem_.spring.energy_lost(from, end, problem_.goal) >= least_gain * work;
    }

    /// The step for a wish: rows to first order, and then to second order by what the features do.
    [[nodiscard]] Twist step_for(const Twist& wish) const {
        constexpr int rounds = 3;
        Eigen::VectorXd bend = Eigen::VectorXd::Zero(contacts_.gaps.size());
        Twist step = Twist::Zero();
        for (int i = 0; i < rounds; ++i) {
            step = step_for(wish, bend);
            const Eigen::VectorXd next = bend_of(step);
            const double change = (next - bend).cwiseAbs().maxCoeff();
            bend = next;
            if (change < negligible * problem_.margin)
                break;
        }
        return step;
    }

    [[nodiscard]] Twist step_for(const Twist& wish, const Eigen::VectorXd& bend) const {
        const Twist recovery = recovery_for(bend);
        TwistConstraints left = contacts_;
        left.gaps += bend + contacts_.rows * recovery - Eigen::VectorXd::Constant(bend.size(), problem_.margin);
        return recovery + admissible_twist(left, metric_, wish - recovery).twist;
    }

    /// How much more the gaps open than the rows say. A contact that opens may be pressed by no more than the margin:
    /// the way back to it would lead through it.
    [[nodiscard]] Eigen::VectorXd bend_of(const Twist& step) const {
        const Displacement displacement = Displacement::between(problem_.pose, displaced_by(step));
        Eigen::VectorXd bend = -(contacts_.gaps + contacts_.rows * step);
        for (Eigen::Index i = 0; i < bend.size(); ++i)
            bend[i] = std::min(problem_.margin, bend[i] + gap_after(problem_.contacts[std::size_t(i)], displacement));
        return bend;
    }

    /// Out of contacts that are nearer than the margin, or would be by their bend; to where they balance, if there is
    /// no room for all. The multipliers of soft rows, one after another.
    [[nodiscard]] Twist recovery_for(const Eigen::VectorXd& bend) const {
        // between two walls a sweep leaves 1 / (1 + softness)^2 of the error
        constexpr int sweeps = 60;
        constexpr double softness = 0x1p-4;
        Twist recovery = Twist::Zero();
        Eigen::VectorXd pushes = Eigen::VectorXd::Zero(bend.size());
        double change = problem_.margin;
        for (int sweep = 0; sweep < sweeps && change > negligible * problem_.margin; ++sweep) {
            change = 0;
            for (Eigen::Index i = 0; i < bend.size(); ++i) {
                const double ease = contacts_.rows.row(i).dot(answers_.col(i));
                const double lacking =
                    problem_.margin - contacts_.gaps[i] - bend[i] - contacts_.rows.row(i).dot(recovery);
                const double push =
                    std::max(0.0, pushes[i] + (lacking - softness * ease * pushes[i]) / ((1 + softness) * ease));
                recovery += (push - pushes[i]) * answers_.col(i);
                change = std::max(change, std::abs(push - pushes[i]) * ease);
                pushes[i] = push;
            }
        }
        return recovery;
    }

    const SlideProblem& problem_;
    TwistConstraints contacts_; ///< the gaps are whole
    Metric metric_;
    Twist wish_;
    Eigen::Matrix<double, 6, Eigen::Dynamic> answers_; ///< of the body to a push of 1 at each contact
    double kept_ = 0;
};

} // namespace

Slide next_slide(const SlideProblem& problem) {
    return problem.contacts.empty() ? Slide{SlideKind::free, problem.goal} : Slider(problem).run();
}

AdmissibleTwist pushes(const SlideProblem& problem, double touch) {
    TwistConstraints constraints = constraints_of(problem);
    for (Eigen::Index i = 0; i < constraints.gaps.size(); ++i) {
        if (constraints.gaps[i] > touch)
            constraints.rows.row(i).setZero();
        constraints.gaps[i] = 0;
    }
    return admissible_twist(constraints, problem.spring.metric(problem.pose),
                            problem.spring.wish(problem.pose, problem.goal));
}

} // namespace chasles::manipulation
