#include "chasles/manipulation/slide.h"

#include "chasles/manipulation/contact_rows.h"
#include "chasles/manipulation/friction.h"
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
constexpr double negligible_share = 0x1p-10;
/// Contacts keep this share of the margin during a step; the certified step asks for less (`safe_level`).
constexpr double kept_share = 0.75;
/// The spring loses at least this share of what it would lose by its force at the start of the step.
constexpr double least_gain = 0.1;
/// Each halves the wish. A hand that pulls by 500 margins may turn a body that is easy to turn by 10,000 margins: ten
/// are too few. A step that is too short to count ends them.
constexpr int attempts = 24;

/// A contact that a lock lets move by less than this share is not in the way of the lock's twists.
constexpr double least_row = 0x1p-20;
/// Nothing is done against a lack of gap at a contact that resists as if the body had this many times its mass.
constexpr double least_ease = 0x1p-10;

const Pose& target_of(const SlideProblem& problem) {
    return problem.target ? *problem.target : problem.goal;
}

/// Leaves the twists of the lock.
void lock(const Metric& projection, const Metric& metric, Rows& rows) {
    rows *= projection;
    const Eigen::LLT<Metric> root(metric);
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        if (root.matrixL().solve(rows.row(i).transpose()).norm() < least_row)
            rows.row(i).setZero();
}

/// The wish less the friction of the contacts. Zero if they hold the body.
Twist after_friction(const FrictionProblem& contacts, const Twist& wish, double margin) {
    FrictionProblem touching = contacts;
    keep_nearer(touching, (touch_share - 1) * margin);
    if (is_held(touching, holding_forces(touching, wish), wish))
        return Twist::Zero();
    return changed_wish(contacts, sliding_forces(contacts, wish), wish);
}

class Slider {
public:
    explicit Slider(const SlideProblem& problem)
        : problem_(problem), centre_(problem.pose.isometry() * problem.spring.centre()),
          contacts_(normal_rows(problem.contacts, centre_)), metric_(problem.spring.metric(problem.pose)),
          wish_(problem.spring.wish(problem.pose, problem.goal)), drive_(wish_), answers_(6, contacts_.rows.rows()) {
        restrict();
        answers_ = metric_.llt().solve(contacts_.rows.transpose());
        kept_ = problem.margin;
        for (const ModelledContact& contact : problem.contacts)
            kept_ = std::min(kept_, contact.contact.gap);
        kept_ *= kept_share;
    }

    Slide run() const {
        if (is_free())
            return {SlideKind::free, target_of(problem_)};
        const Twist recovery = recovery_for(Eigen::VectorXd::Zero(contacts_.gaps.size()));
        const Pose recovered = displaced_by(recovery);
        // far within the margin the next step would be certified for little, and blocked by what it gains
        if (kept_ < kept_share * kept_share * problem_.margin && !is_short(recovery))
            return {SlideKind::partial, recovered};
        double share = 1; // of the wish
        for (int i = 0; i < attempts; ++i) {
            const Twist step = step_for(share * drive_);
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
    /// By the lock and by friction.
    void restrict() {
        const bool is_locked = problem_.lock && !problem_.lock->is_free();
        const Metric projection = is_locked ? problem_.lock->projection(metric_, centre_) : Metric(Metric::Identity());
        if (is_locked) {
            lock(projection, metric_, contacts_.rows);
            wish_ = projection * wish_;
        }
        drive_ = problem_.friction > 0 ? driven(projection) : wish_;
    }

    /// By what the contacts leave of the wish.
    [[nodiscard]] Twist driven(const Metric& projection) const {
        FrictionProblem friction{contacts_, tangent_rows(problem_.contacts, centre_) * projection, problem_.friction,
                                 metric_};
        friction.normals.gaps = (contacts_.gaps.array() - problem_.margin).cwiseMax(0);
        return after_friction(friction, wish_, problem_.margin);
    }

    [[nodiscard]] Pose displaced_by(const Twist& step) const {
        const Pose end = displaced(problem_.pose, problem_.spring.centre(), step);
        return problem_.lock ? problem_.lock->onto(end) : end;
    }

    [[nodiscard]] double length_of(const Twist& step) const {
        return step.head<3>().norm() + problem_.size * step.tail<3>().norm();
    }
    [[nodiscard]] bool is_short(const Twist& step) const { return length_of(step) < problem_.rest; }

    /// How many times the longest step along contacts.
    [[nodiscard]] static double excess_of(const Twist& step, double size) {
        return std::max(step.head<3>().norm() / (longest_way * size), step.tail<3>().norm() / longest_turn);
    }

    /// Whether the screw to the target leads away from all contacts, or along them, without friction.
    [[nodiscard]] bool is_free() const {
        if (drive_ != wish_)
            return false;
        const double tolerance = negligible_share * problem_.margin;
        const Pose soon = Motion::screw(problem_.pose, target_of(problem_)).pose_at(0x1p-10);
        const Displacement displacement = Displacement::between(problem_.pose, soon);
        const auto leads_away = [&](const ModelledContact& contact) {
            const double lost = (contact.contact.gap - gap_after(contact, displacement)) * 0x1p10;
            return lost <= std::max(0.0, contact.contact.gap - problem_.margin) + tolerance;
        };
        return std::ranges::all_of(problem_.contacts, leads_away) && keeps_gaps(target_of(problem_));
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

    /// More than friction takes.
    [[nodiscard]] bool loses_energy(const Pose& from, const Pose& end, const Twist& step) const {
        const double work = drive_.dot(metric_ * step), taken = (wish_ - drive_).dot(metric_ * step);
        return problem_.spring.energy_lost(from, end, problem_.goal) - taken >= least_gain * work;
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
            if (change < negligible_share * problem_.margin)
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
        for (int sweep = 0; sweep < sweeps && change > negligible_share * problem_.margin; ++sweep) {
            change = 0;
            for (Eigen::Index i = 0; i < bend.size(); ++i) {
                const double ease = contacts_.rows.row(i).dot(answers_.col(i));
                if (ease < least_ease)
                    continue;
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
    Eigen::Vector3d centre_;
    TwistConstraints contacts_; ///< the gaps are whole
    Metric metric_;
    Twist wish_;                                       ///< of the spring, as far as the lock leaves it
    Twist drive_;                                      ///< the wish less friction
    Eigen::Matrix<double, 6, Eigen::Dynamic> answers_; ///< of the body to a push of 1 at each contact
    double kept_ = 0;
};

} // namespace

Slide next_slide(const SlideProblem& problem) {
    return problem.contacts.empty() ? Slide{SlideKind::free, target_of(problem)} : Slider(problem).run();
}

} // namespace chasles::manipulation
