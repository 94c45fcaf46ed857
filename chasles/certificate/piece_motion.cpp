#include "chasles/certificate/piece_motion.h"

#include "chasles/base/invalid_input.h"
#include "chasles/certificate/hexadecimal.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/even_trajectory.h"
#include "chasles/motion/fixed_pose.h"
#include "chasles/motion/screw_trajectory.h"
#include "chasles/motion/sweep_trajectory.h"

#include <algorithm>
#include <numbers>

namespace chasles::certificate {

namespace {

using motion::ChainLink;
using Kind = motion::MotionDescription::Kind;

std::string hexadecimals_of(const Pose& pose) {
    const Eigen::Vector3d& p = pose.translation;
    const Eigen::Quaterniond& q = pose.rotation;
    std::string text;
    for (const double number : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()})
        text += " " + hexadecimal(number);
    return text;
}

std::string hexadecimals_of(const Eigen::Vector3d& vector) {
    return " " + hexadecimal(vector.x()) + " " + hexadecimal(vector.y()) + " " + hexadecimal(vector.z());
}

/// A pose, and that of the body it is seen from.
std::string pose_line(const Pose& pose, const Pose* seen_from, bool with_both) {
    return "pose" + hexadecimals_of(pose) + (with_both ? hexadecimals_of(seen_from ? *seen_from : Pose()) : "") + "\n";
}

std::string link_line(const ChainLink& link) {
    using enum ChainLink::Kind;
    const std::string head = link.is_inverse ? "link back " : "link ";
    switch (link.kind) {
    case pose:
        return head + "pose" + hexadecimals_of(link.poses.front()) + "\n";
    case slide:
        return head + "slide" + hexadecimals_of(link.vector) + "\n";
    case turn:
        return head + "turn" + hexadecimals_of(link.vector) + "\n";
    case velocity:
        return head + "velocity" + hexadecimals_of(link.vector) + "\n";
    case twist:
        return head + "twist\n";
    }
    return "";
}

/// The words of a link in the line of a knot.
std::string words_at(const ChainLink& link, std::size_t knot) {
    if (!link.values.empty())
        return " " + hexadecimal(link.values[knot]);
    return link.kind == ChainLink::Kind::pose ? "" : hexadecimals_of(link.poses[knot]);
}

std::size_t knot_count(const ChainLink& link) {
    return link.kind == ChainLink::Kind::pose ? 0 : std::max(link.values.size(), link.poses.size());
}

using WideLink = EvenLink<DoubleDouble>;

EvenLink<double> rounded(const WideLink& link) {
    using motion::in_double;
    const auto& rows = link.orientation.row;
    return {link.is_inverse,        {{in_double(rows[0]), in_double(rows[1]), in_double(rows[2])}},
            in_double(link.arm),    in_double(link.place),
            in_double(link.travel), in_double(link.axis),
            double(link.angle),     double(link.rate)};
}

WideLink even_link(const ChainLink& link, std::size_t piece) {
    const auto kind = link.kind == ChainLink::Kind::velocity ? motion::EvenKind::velocity : motion::EvenKind::twist;
    const motion::EvenFrame frame(kind, link.poses[piece], link.poses[piece + 1], link.vector, true);
    const auto& numbers = frame.refined();
    if (!(double(numbers.angle) < std::numbers::pi))
        refuse("piece " + std::to_string(piece) + " is a half turn, which has no shorter way round");
    WideLink result;
    result.orientation = rotation_matrix(numbers.orientation);
    result.arm = numbers.arm - result.orientation * numbers.reference;
    result.place = numbers.start - numbers.arm;
    result.travel = numbers.travel;
    result.axis = numbers.direction;
    result.rate = numbers.angle;
    return result;
}

WideLink wide_link(const ChainLink& link, std::size_t piece) {
    using enum ChainLink::Kind;
    WideLink result;
    const auto value = [&](std::size_t knot) { return DoubleDouble(link.values[knot]); };
    if (link.kind == pose) {
        const motion::FixedPose fixed(link.poses.front());
        result.place = fixed.refined.translation;
        result.orientation = rotation_matrix(fixed.refined.rotation);
    } else if (link.kind == slide) {
        const Wide along = widened(motion::vector_in<double>(link.vector));
        result.place = scale(along, value(piece));
        result.travel = scale(along, value(piece + 1) - value(piece));
    } else if (link.kind == turn) {
        result.axis = motion::FixedAxis(link.vector).refined;
        result.angle = value(piece);
        result.rate = value(piece + 1) - value(piece);
    } else {
        result = even_link(link, piece);
    }
    result.is_inverse = link.is_inverse;
    return result;
}

Motion screw_of(const motion::MotionEnds& ends) {
    using Screw = motion::ErasedTrajectory<motion::ScrewTrajectory>;
    return Motion(std::make_shared<const Screw>(motion::ScrewTrajectory(ends, std::numbers::pi)));
}

double size_of(const Wide& v) {
    return length(motion::in_double(v));
}

CertifiedPiece chain_piece(const std::vector<ChainLink>& given, std::size_t piece) {
    std::vector<WideLink> links;
    std::vector<EvenLink<double>> in_double;
    double size = 0;
    for (const ChainLink& link : given) {
        links.push_back(wide_link(link, piece));
        in_double.push_back(rounded(links.back()));
        size += size_of(links.back().place) + size_of(links.back().travel) + size_of(links.back().arm);
    }
    return {ChainPiece(std::move(links)), ChainPiece(std::move(in_double)), size, false};
}

CertifiedPiece rational_piece(const motion::RationalMotion<DoubleDouble>& cubic, bool is_exact) {
    const double size = size_of(cubic.origin) + size_of(cubic.displacement) + size_of(cubic.moment);
    return {RationalPiece(cubic), RationalPiece(motion::rounded(cubic)), size, is_exact};
}

} // namespace

void refuse(const std::string& why) {
    throw InvalidInput("certificate: " + why);
}

bool is_same(const ChainLink& a, const ChainLink& b) {
    if (link_line(a) != link_line(b) || knot_count(a) != knot_count(b))
        return false;
    for (std::size_t knot = 0; knot < knot_count(a); ++knot)
        if (words_at(a, knot) != words_at(b, knot))
            return false;
    return true;
}

bool is_at_rest(const motion::ChainLinks& chain) {
    return std::ranges::all_of(chain.links(), [](const ChainLink& link) { return knot_count(link) == 0; });
}

std::string lines_of(const motion::ChainLinks& chain, std::size_t knots) {
    std::string text;
    for (const ChainLink& link : chain.links())
        text += link_line(link);
    for (std::size_t knot = 0; knot < knots; ++knot) {
        text += "knot";
        for (const ChainLink& link : chain.links())
            text += words_at(link, knot);
        text += "\n";
    }
    return text;
}

motion::ChainLinks chain_between(const motion::ChainLinks& moving, const motion::ChainLinks& fixed) {
    const auto apart = std::ranges::mismatch(moving.links(), fixed.links(), is_same);
    motion::ChainLinks chain;
    const auto add = [&](ChainLink link) { static_cast<void>(chain.add(std::move(link), chain.times())); };
    for (auto link = fixed.links().end(); link != apart.in2;) {
        ChainLink back = *--link;
        back.is_inverse = !back.is_inverse;
        add(std::move(back));
    }
    for (auto link = apart.in1; link != moving.links().end(); ++link)
        add(*link);
    if (chain.links().empty())
        chain.add(Pose(), false);
    return chain;
}

CertifiedMotion::CertifiedMotion(std::span<const Motion> path) {
    for (const Motion& motion : path)
        add(motion);
}

CertifiedMotion::CertifiedMotion(motion::ChainLinks chain, std::size_t piece_count) : piece_count_(piece_count) {
    whole_.kind = Kind::chain;
    whole_.chain = std::move(chain);
}

void CertifiedMotion::add(const Motion& motion) {
    motion::MotionDescription next = motion.trajectory().description();
    if (next.kind == Kind::other)
        refuse("the motion is none of those that are certified: screws, sweeps, and products of poses, velocities, "
               "twists, hinges and sliders that move evenly between the same times");
    const bool is_first = parts_.empty();
    const auto add_part = [&](const Motion& part, std::vector<double> times) {
        const std::size_t first = piece_count_;
        piece_count_ += times.size() - 1;
        parts_.push_back({part, first, std::move(times)});
    };
    if (next.kind == Kind::screw)
        for (const motion::MotionEnds& ends : next.pieces)
            add_part(screw_of(ends), {0, 1});
    else
        add_part(motion, next.chain.times());
    if (next.kind == Kind::sweep && !(0 < double(motion::SweepPiece(next.pieces[0], next.centre).cubic().end_cosine)))
        refuse("the sweep is a half turn");
    if (is_first)
        whole_ = std::move(next);
    else if (!whole_.append(next))
        refuse("the motions of the path are of several kinds, or one does not begin where the last one ends");
}

std::string CertifiedMotion::lines() const {
    const std::string count = std::to_string(piece_count());
    if (whole_.kind == Kind::chain)
        return "motion chain " + count + " " + std::to_string(whole_.chain.links().size()) + "\n" +
               lines_of(whole_.chain, piece_count_ + 1);
    const bool with_both = std::ranges::any_of(
        whole_.pieces, [](const motion::MotionEnds& ends) { return ends.start_is_in_world || ends.goal_is_in_world; });
    std::string text = is_screw() ? "motion screw " + count + "\n"
                                  : "motion sweep " + count + "\ncentre" + hexadecimals_of(whole_.centre) + "\n";
    for (const motion::MotionEnds& ends : whole_.pieces)
        text += pose_line(ends.start, ends.start_seen_from(), with_both);
    const motion::MotionEnds& last = whole_.pieces.back();
    return text + pose_line(last.goal, last.goal_seen_from(), with_both);
}

CertifiedPiece CertifiedMotion::piece(std::size_t index) const {
    if (whole_.kind == Kind::chain)
        return chain_piece(whole_.chain.links(), index);
    return is_screw() ? rational_piece(motion::ScrewPiece(whole_.pieces[index]).cubic(), true)
                      : rational_piece(motion::SweepPiece(whole_.pieces[index], whole_.centre).cubic(), false);
}

} // namespace chasles::certificate
