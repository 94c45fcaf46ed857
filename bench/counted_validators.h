// OMPL's questions to a validator, counted and timed.
#pragma once

#include <cstddef>
#include <ctime>
#include <memory>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <utility>
#include <vector>

namespace chasles::bench {

/// Of this process: other work on the machine does not count.
inline double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Questions of one kind.
struct Questions {
    std::size_t count = 0, refused = 0; ///< refused: the answer was no
    double seconds = 0;

    template <class Ask>
    bool timed(const Ask& ask) {
        const double start = processor_seconds();
        const bool answer = ask();
        seconds += processor_seconds() - start;
        ++count;
        refused += !answer;
        return answer;
    }
    void operator+=(const Questions& other) {
        count += other.count;
        refused += other.refused;
        seconds += other.seconds;
    }
};

/// What a planner asks. The states that a motion validator asks for itself are part of its motions.
struct AskedQuestions {
    Questions states, motions, motions_with_last; ///< `with_last`: with the last valid state
    /// Some of the motions, for other programs: start and goal, one row each.
    std::vector<std::vector<double>> kept = {};
    bool is_in_motion = false;

    static constexpr std::size_t stride = 20, most_kept = 10;
};

/// One thread at a time.
class CountedStates : public ::ompl::base::StateValidityChecker {
public:
    CountedStates(const ::ompl::base::SpaceInformationPtr& information,
                  std::shared_ptr<::ompl::base::StateValidityChecker> inner, AskedQuestions& asked)
        : StateValidityChecker(information), inner_(std::move(inner)), asked_(asked) {}

    bool isValid(const ::ompl::base::State* state) const override {
        if (asked_.is_in_motion)
            return inner_->isValid(state);
        return asked_.states.timed([&] { return inner_->isValid(state); });
    }

private:
    std::shared_ptr<::ompl::base::StateValidityChecker> inner_;
    AskedQuestions& asked_;
};

/// Likewise.
class CountedMotions : public ::ompl::base::MotionValidator {
public:
    using State = ::ompl::base::State;

    CountedMotions(const ::ompl::base::SpaceInformationPtr& information,
                   std::shared_ptr<::ompl::base::MotionValidator> inner, AskedQuestions& asked)
        : MotionValidator(information), inner_(std::move(inner)), asked_(asked) {}

    bool checkMotion(const State* s1, const State* s2) const override {
        if (asked_.motions.count % AskedQuestions::stride == 0 && asked_.kept.size() < AskedQuestions::most_kept)
            keep(s1, s2);
        return of_motion(asked_.motions, [&] { return inner_->checkMotion(s1, s2); });
    }
    bool checkMotion(const State* s1, const State* s2, std::pair<State*, double>& last) const override {
        return of_motion(asked_.motions_with_last, [&] { return inner_->checkMotion(s1, s2, last); });
    }

private:
    void keep(const State* s1, const State* s2) const {
        std::vector<double> start, goal;
        si_->getStateSpace()->copyToReals(start, s1);
        si_->getStateSpace()->copyToReals(goal, s2);
        start.insert(start.end(), goal.begin(), goal.end());
        asked_.kept.push_back(std::move(start));
    }

    template <class Ask>
    bool of_motion(Questions& questions, const Ask& ask) const {
        asked_.is_in_motion = true;
        const bool answer = questions.timed(ask);
        asked_.is_in_motion = false;
        return answer;
    }

    std::shared_ptr<::ompl::base::MotionValidator> inner_;
    AskedQuestions& asked_;
};

} // namespace chasles::bench
