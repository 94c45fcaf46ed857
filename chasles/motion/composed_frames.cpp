// Frames that are made of other frames. Source: docs/derivations/26-frames.md.
#include "chasles/motion/axis_motion.h"
#include "chasles/motion/frame_in_both.h"
#include "chasles/motion/frames.h"
#include "chasles/motion/motion_description.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <utility>

namespace chasles::motion {

namespace {

/// `pose` relative to `frame`, both with quaternions of unit length.
template <class S>
GeneralPose<S> relative(const GeneralPose<S>& frame, const GeneralPose<S>& pose) {
    const Quaternion<S> back = frame.rotation.conjugate();
    return {rotated(back, pose.translation - frame.translation), back * pose.rotation};
}

/// Two frames of which one is at rest, or both of which have one axis.
std::vector<AxisSection> product_of(const std::vector<AxisSection>& outer, const std::vector<AxisSection>& inner) {
    const std::vector<AxisSection>& longer = outer.size() > 1 ? outer : inner;
    std::vector<AxisSection> sections;
    if (outer.empty() || inner.empty() || (outer.size() > 1 && inner.size() > 1))
        return sections;
    for (std::size_t i = 0; i < longer.size(); ++i) {
        const AxisMotion& carrying = outer[outer.size() > 1 ? i : 0].motion;
        const AxisMotion& carried = inner[inner.size() > 1 ? i : 0].motion;
        const bool has_rest = carrying.kind == AxisMotion::Kind::rest || carried.kind == AxisMotion::Kind::rest;
        std::optional<AxisMotion> motion = longer.size() == 1 || has_rest ? product(carrying, carried) : std::nullopt;
        if (!motion)
            return {};
        sections.push_back({longer[i].times, *std::move(motion)});
    }
    return sections;
}

std::vector<AxisSection> inverse_of(std::vector<AxisSection> sections) {
    for (AxisSection& section : sections)
        section.motion = section.motion.inverse();
    return sections;
}

/// Two frames that make a third one.
template <class Derived>
class FrameOfTwo : public FrameInBoth<Derived> {
public:
    FrameOfTwo(SharedFrame first, SharedFrame second)
        : first_(std::move(first)), second_(std::move(second)),
          size_(first_->size() + second_->size() + norm1(first_->reference()) + norm1(second_->reference())),
          rounding_(first_->rounding() + second_->rounding() + 1), factors_(first_->factors() + second_->factors()),
          is_refined_(first_->is_refined() && second_->is_refined()) {}

    [[nodiscard]] bool is_refined() const final { return is_refined_; }
    [[nodiscard]] double size() const final { return size_; }
    [[nodiscard]] double rounding() const final { return rounding_; }
    [[nodiscard]] int factors() const final { return factors_; }
    void add_cuts(std::vector<double>& cuts) const final {
        first_->add_cuts(cuts);
        second_->add_cuts(cuts);
    }

protected:
    [[nodiscard]] const MovingFrame& first() const { return *first_; }
    [[nodiscard]] const MovingFrame& second() const { return *second_; }

private:
    SharedFrame first_;
    SharedFrame second_;
    double size_;
    double rounding_;
    int factors_;
    bool is_refined_;
};

class ProductFrame final : public FrameOfTwo<ProductFrame> {
public:
    using FrameOfTwo::FrameOfTwo;

    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        return product(pose_of<S>(first(), time), pose_of<S>(second(), time));
    }
    [[nodiscard]] Vector3<double> reference() const override { return second().reference(); }
    [[nodiscard]] Vector3<Wide> refined_reference() const override { return second().refined_reference(); }

    [[nodiscard]] RateExpansion expansion(const Bracket& times) const override {
        return carried(first().expansion(times), second().expansion(times), half_of(times), size());
    }
    [[nodiscard]] std::optional<AxisExpansion> expansion_about(const Vector3<double>& direction,
                                                               const Bracket& times) const override {
        const auto outer = first().expansion_about(direction, times);
        const auto inner = outer ? second().expansion_about(seen_by(outer->all, direction), times) : std::nullopt;
        return inner ? std::optional(carried(*outer, *inner, half_of(times), size())) : std::nullopt;
    }
    [[nodiscard]] std::vector<AxisSection> axis_sections() const override {
        std::vector<AxisSection> outer = first().axis_sections();
        return outer.empty() ? outer : product_of(outer, second().axis_sections());
    }
    [[nodiscard]] bool add_links(ChainLinks& chain, bool is_inverse) const override {
        const MovingFrame &outer = is_inverse ? second() : first(), &inner = is_inverse ? first() : second();
        return outer.add_links(chain, is_inverse) && inner.add_links(chain, is_inverse);
    }
};

class RelativeFrame final : public FrameOfTwo<RelativeFrame> {
public:
    using FrameOfTwo::FrameOfTwo;

    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        return relative(pose_of<S>(second(), time), pose_of<S>(first(), time));
    }
    [[nodiscard]] Vector3<double> reference() const override { return first().reference(); }
    [[nodiscard]] Vector3<Wide> refined_reference() const override { return first().refined_reference(); }

    [[nodiscard]] RateExpansion expansion(const Bracket& times) const override {
        return seen_from(first().expansion(times), second().expansion(times), half_of(times), size());
    }
    /// The direction, which is one of the fixed body, in the common frame.
    [[nodiscard]] std::optional<AxisExpansion> expansion_about(const Vector3<double>& direction,
                                                               const Bracket& times) const override {
        const Vector3<double> in_common = rotated(second().at(middle_of(times)).rotation, direction);
        const auto fixed = second().expansion_about(in_common, times);
        const auto moving = fixed ? first().expansion_about(in_common, times) : std::nullopt;
        return moving ? std::optional(seen_from(*moving, *fixed, half_of(times), size())) : std::nullopt;
    }
    [[nodiscard]] std::vector<AxisSection> axis_sections() const override {
        std::vector<AxisSection> moving = first().axis_sections();
        return moving.empty() ? moving : product_of(inverse_of(second().axis_sections()), moving);
    }
    [[nodiscard]] bool add_links(ChainLinks& chain, bool is_inverse) const override {
        const MovingFrame &outer = is_inverse ? first() : second(), &inner = is_inverse ? second() : first();
        return outer.add_links(chain, true) && inner.add_links(chain, false);
    }
};

class JoinedFrames final : public FrameInBoth<JoinedFrames> {
public:
    JoinedFrames(std::vector<double> ends, std::vector<SharedFrame> frames)
        : ends_(std::move(ends)), frames_(std::move(frames)) {
        for (const SharedFrame& frame : frames_) {
            size_ = std::max(size_, frame->size());
            rounding_ = std::max(rounding_, frame->rounding());
            factors_ = std::max(factors_, 1 + frame->factors());
            is_refined_ = is_refined_ && frame->is_refined();
        }
    }
    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        std::size_t i = index_at(double(time));
        if (i > 0 && time < S(ends_[i])) // is rounded up to the end
            --i;
        const S local = (time - S(ends_[i])) / (S(ends_[i + 1]) - S(ends_[i]));
        return pose_of<S>(*frames_[i], local);
    }
    [[nodiscard]] bool is_refined() const override { return is_refined_; }
    [[nodiscard]] Vector3<double> reference() const override { return frames_.front()->reference(); }
    [[nodiscard]] Vector3<Wide> refined_reference() const override { return frames_.front()->refined_reference(); }
    [[nodiscard]] RateBounds rates(const Bracket& times) const override {
        const Segment segment = segment_of(times);
        return slowed(segment.frame.rates(segment.times), segment.duration);
    }
    [[nodiscard]] RateExpansion expansion(const Bracket& times) const override {
        const Segment segment = segment_of(times);
        return slowed(segment.frame.expansion(segment.times), segment.duration);
    }
    [[nodiscard]] std::optional<AxisExpansion> expansion_about(const Vector3<double>& direction,
                                                               const Bracket& times) const override {
        const Segment segment = segment_of(times);
        return slowed(segment.frame.expansion_about(direction, segment.times), segment.duration);
    }
    [[nodiscard]] std::optional<Vector3<Wide>> refined_axis(const Bracket& times) const override {
        const Segment segment = segment_of(times);
        return segment.frame.refined_axis(segment.times);
    }
    [[nodiscard]] double size() const override { return size_; }
    [[nodiscard]] double rounding() const override { return rounding_; }
    [[nodiscard]] int factors() const override { return factors_; }
    void add_cuts(std::vector<double>& cuts) const override { cuts.insert(cuts.end(), ends_.begin(), ends_.end()); }
    [[nodiscard]] std::vector<AxisSection> axis_sections() const override {
        std::vector<AxisSection> all;
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            std::vector<AxisSection> sections = frames_[i]->axis_sections();
            if (sections.size() != 1)
                return {};
            all.push_back({{ends_[i], ends_[i + 1]}, std::move(sections.front().motion)});
        }
        return all;
    }
    /// Only of frames that are one link each.
    [[nodiscard]] bool add_links(ChainLinks& chain, bool is_inverse) const override {
        ChainLinks all;
        bool fits = frames_.front()->add_links(all, is_inverse) && all.links().size() == 1;
        for (std::size_t i = 1; fits && i < frames_.size(); ++i) {
            ChainLinks next;
            fits = frames_[i]->add_links(next, is_inverse) && all.append(next);
        }
        return fits && chain.add(all.links().front(), ends_);
    }

private:
    struct Segment {
        const MovingFrame& frame;
        Bracket times; ///< of the frame
        double duration;
    };

    [[nodiscard]] Segment segment_of(const Bracket& times) const {
        const std::size_t i = index_at(times.lower); // the middle may be rounded to the end
        const double duration = ends_[i + 1] - ends_[i];
        const auto local = [&](double time) { return std::clamp((time - ends_[i]) / duration, 0.0, 1.0); };
        return {*frames_[i], {local(times.lower), local(times.upper)}, duration};
    }
    /// Of the frame that lasts at this time; at an end, of the later one.
    [[nodiscard]] std::size_t index_at(double time) const {
        const auto after = std::upper_bound(ends_.begin(), ends_.end(), time);
        return std::clamp<std::size_t>(std::size_t(after - ends_.begin()), 1, frames_.size()) - 1;
    }

    std::vector<double> ends_;
    std::vector<SharedFrame> frames_;
    double size_ = 0;
    double rounding_ = 1;
    int factors_ = 1;
    bool is_refined_ = true;
};

class PartFrame final : public FrameInBoth<PartFrame> {
public:
    PartFrame(SharedFrame frame, double from, double to)
        : frame_(std::move(frame)), from_(from), to_(to), duration_(to - from),
          part_{std::min(from, to), std::max(from, to)} {
        std::vector<double> all;
        frame_->add_cuts(all);
        for (const double cut : all)
            if (part_.lower < cut && cut < part_.upper)
                cuts_.push_back({std::min((cut - from_) / duration_, 1.0), cut});
        std::ranges::sort(cuts_, {}, &Cut::time);
    }

    template <class S>
    [[nodiscard]] GeneralPose<S> place(const S& time) const {
        return pose_of<S>(*frame_, of_frame(time));
    }
    [[nodiscard]] bool is_refined() const override { return frame_->is_refined(); }
    [[nodiscard]] Vector3<double> reference() const override { return frame_->reference(); }
    [[nodiscard]] Vector3<Wide> refined_reference() const override { return frame_->refined_reference(); }
    [[nodiscard]] RateBounds rates(const Bracket& times) const override {
        return slowed(frame_->rates(of_frame(times)), 1 / duration_);
    }
    [[nodiscard]] RateExpansion expansion(const Bracket& times) const override {
        return slowed(frame_->expansion(of_frame(times)), 1 / duration_);
    }
    [[nodiscard]] std::optional<AxisExpansion> expansion_about(const Vector3<double>& direction,
                                                               const Bracket& times) const override {
        return slowed(frame_->expansion_about(direction, of_frame(times)), 1 / duration_);
    }
    [[nodiscard]] std::optional<Vector3<Wide>> refined_axis(const Bracket& times) const override {
        return frame_->refined_axis(of_frame(times));
    }
    [[nodiscard]] double size() const override { return frame_->size(); }
    [[nodiscard]] double rounding() const override { return frame_->rounding() + 1; }
    [[nodiscard]] int factors() const override { return frame_->factors() + 1; }
    /// The frame of which this one is the way back; null for other parts.
    [[nodiscard]] SharedFrame forwards() const { return from_ == 1 && to_ == 0 ? frame_ : nullptr; }
    void add_cuts(std::vector<double>& cuts) const override {
        for (const Cut& cut : cuts_)
            cuts.push_back(cut.time);
    }
    [[nodiscard]] std::vector<AxisSection> axis_sections() const override {
        std::vector<AxisSection> parts;
        for (const auto& [times, motion] : frame_->axis_sections()) {
            const double lower = std::max(times.lower, part_.lower), upper = std::min(times.upper, part_.upper);
            if (!(lower < upper))
                continue;
            const auto within = [](double time, double from, double to) {
                return time == to ? 1 : (time - from) / (to - from);
            };
            const double from = duration_ > 0 ? lower : upper, to = duration_ > 0 ? upper : lower;
            parts.push_back(
                {{within(from, from_, to_), within(to, from_, to_)},
                 motion.part(within(from, times.lower, times.upper), within(to, times.lower, times.upper))});
        }
        if (duration_ < 0)
            std::ranges::reverse(parts);
        return parts;
    }

private:
    /// Where rates jump.
    struct Cut {
        double time;     ///< of this frame
        double of_frame; ///< the frame's time there
    };

    /// The frame's time at a time of this one.
    template <class S>
    [[nodiscard]] S of_frame(const S& time) const {
        return std::clamp(S(from_) + time * S(duration_), S(part_.lower), S(part_.upper));
    }
    /// Of an interval without a cut inside. Its ends are rounded, and must not leave the frame's time between both
    /// cuts: beyond them its rates are others.
    [[nodiscard]] Bracket of_frame(const Bracket& times) const {
        const auto next = std::ranges::upper_bound(cuts_, times.lower, {}, &Cut::time);
        const double begin = next == cuts_.begin() ? from_ : std::prev(next)->of_frame,
                     end = next == cuts_.end() ? to_ : next->of_frame;
        const auto within = [&](double time) {
            return std::clamp(of_frame(time), std::min(begin, end), std::max(begin, end));
        };
        const double first = within(times.lower), last = within(times.upper);
        return {std::min(first, last), std::max(first, last)};
    }

    SharedFrame frame_;
    double from_;
    double to_;
    double duration_;
    Bracket part_;          ///< of the frame's time
    std::vector<Cut> cuts_; ///< in order of this frame's time
};

} // namespace

SharedFrame product_frame(SharedFrame outer, SharedFrame inner) {
    return std::make_shared<const ProductFrame>(std::move(outer), std::move(inner));
}

SharedFrame relative_frame(SharedFrame moving, SharedFrame fixed) {
    return std::make_shared<const RelativeFrame>(std::move(moving), std::move(fixed));
}

SharedFrame joined_frames(std::vector<double> ends, std::vector<SharedFrame> frames) {
    return std::make_shared<const JoinedFrames>(std::move(ends), std::move(frames));
}

SharedFrame part_frame(SharedFrame frame, double from, double to) {
    return std::make_shared<const PartFrame>(std::move(frame), from, to);
}

SharedFrame reversed_frame(const SharedFrame& frame) {
    if (const auto* const part = dynamic_cast<const PartFrame*>(frame.get()))
        if (SharedFrame forwards = part->forwards())
            return forwards;
    return part_frame(frame, 1, 0);
}

} // namespace chasles::motion
