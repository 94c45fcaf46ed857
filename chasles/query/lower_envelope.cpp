#include "chasles/query/lower_envelope.h"

#include <algorithm>
#include <limits>

namespace chasles::query {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

LowerEnvelope::LowerEnvelope() : steps_{{0, infinity, infinity, 0}} {}

const LowerEnvelope& LowerEnvelope::none() {
    static const LowerEnvelope empty;
    return empty;
}

std::size_t LowerEnvelope::step_at(double time) const {
    return std::size_t(std::ranges::upper_bound(steps_, time, {}, &Step::begin) - steps_.begin()) - 1;
}

double LowerEnvelope::greatest_upper(const Bracket& part) const {
    double greatest = 0;
    for (std::size_t i = step_at(part.lower); i < steps_.size() && steps_[i].begin <= part.upper; ++i)
        greatest = std::max(greatest, steps_[i].upper);
    return greatest;
}

void LowerEnvelope::append(std::vector<Step>& steps, const Step& step) {
    if (steps.empty() || !steps.back().is_same(step))
        steps.push_back(step);
}

/// Both lists of steps are passed through together.
void LowerEnvelope::add(const DistanceProfile& distance, const Bracket& part, std::uint32_t name) {
    const std::size_t last = distance.times.size() - 2;
    const auto end_of_other = [&](std::size_t k) {
        return k == last ? part.upper : part.lower + distance.times[k + 1] * (part.upper - part.lower);
    };
    std::vector<Step> steps;
    std::size_t own = 0, other = 0;
    for (double begin = 0, end = 1; begin < 1; begin = end) {
        while (end_of(own) <= begin)
            ++own;
        Step step = steps_[own];
        step.begin = begin;
        end = end_of(own);
        if (begin < part.lower) {
            end = std::min(end, part.lower);
        } else if (begin < part.upper) {
            while (end_of_other(other) <= begin)
                ++other;
            end = std::min(end, end_of_other(other));
            step.take(distance.lower[other], distance.upper[other], name);
        }
        append(steps, step);
    }
    steps_ = std::move(steps);
    certain_ &= distance.certain;
    work_ += distance.work;
}

void LowerEnvelope::Step::take(double other_lower, double other_upper, std::uint32_t other_name) {
    lower = std::min(lower, other_lower);
    if (other_upper < upper) {
        upper = other_upper;
        name = other_name;
    }
}

void LowerEnvelope::leave(double least) {
    for (Step& step : steps_)
        step.lower = std::min(step.lower, least);
    certain_ &= least >= greatest_upper();
}

DistanceProfile LowerEnvelope::result() const {
    DistanceProfile profile;
    for (const Step& step : steps_) {
        profile.times.push_back(step.begin);
        profile.lower.push_back(step.lower);
        profile.upper.push_back(step.upper);
        profile.nearest.push_back(step.name);
    }
    profile.times.push_back(1);
    profile.lower.push_back(profile.lower.back());
    profile.upper.push_back(profile.upper.back());
    profile.certain = certain_;
    profile.work = work_;
    return profile;
}

} // namespace chasles::query
