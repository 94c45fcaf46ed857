#include "chasles/certificate/two_bodies.h"

#include "chasles/base/limit_of_thread.h"
#include "chasles/certificate/certified_body.h"
#include "chasles/certificate/hexadecimal.h"
#include "chasles/certificate/prover.h"
#include "chasles/certificate/witness.h"
#include "chasles/mesh/body.h"

#include <algorithm>

namespace chasles::certificate {

namespace {

void miss(Certificate& result, const std::string& what) {
    if (result.missing.empty())
        result.missing = "not proven: " + what;
}

} // namespace

Claim::Claim(const FirstContact& found, std::size_t piece_of_contact, const Bracket& tau_of_contact)
    : verdict(found.verdict) {
    constexpr double beside = 0x1p-44;
    if (verdict == Verdict::contact) {
        piece = piece_of_contact;
        tau = {std::max(tau_of_contact.lower - beside, 0.0), std::min(tau_of_contact.upper + beside, 1.0)};
    } else if (verdict == Verdict::contact_at_start) {
        piece = 0;
        tau = {0, 0};
    }
    if (found.inside)
        moving_is_inside = found.inside->moving_is_inside;
}

Claim claim_at(const std::vector<double>& times, const FirstContact& found) {
    const auto after = std::ranges::lower_bound(times, found.time.upper);
    const auto piece = std::size_t(std::max<std::ptrdiff_t>(after - times.begin(), 1) - 1);
    const double begin = times[piece], duration = times[piece + 1] - begin;
    const auto share = [&](double time) { return std::clamp((time - begin) / duration, 0.0, 1.0); };
    return {found, piece, {share(found.time.lower), share(found.time.upper)}};
}

std::string words_of(const Claim& claim) {
    if (claim.verdict == Verdict::clear)
        return "clear";
    if (claim.verdict == Verdict::contact_at_start)
        return "start";
    return "contact " + std::to_string(claim.piece) + " " + hexadecimal(claim.tau.lower) + " " +
           hexadecimal(claim.tau.upper);
}

std::string order_line(const std::string& name, const FaceTree& tree) {
    std::string text = name.empty() ? "order" : "order " + name;
    for (const std::uint32_t face : tree.order())
        text += " " + std::to_string(face);
    return text + "\n";
}

TwoBodies::TwoBodies(const FaceTree& moving, const FaceTree& fixed, const CertifiedMotion& motion, double margin)
    : moving_(moving), fixed_(fixed), motion_(motion),
      reach_(DoubleDouble(moving.body().radius()) + DoubleDouble(fixed.body().radius()) + DoubleDouble(margin)) {}

void TwoBodies::add_outside(Certificate& result) const {
    const PieceOfBodies start = piece(0);
    for (const bool of_moving : {true, false}) {
        const Polyhedron &body = (of_moving ? moving_ : fixed_).body(), &other = (of_moving ? fixed_ : moving_).body();
        if (!other.body().volume().is_solid())
            continue;
        for (const auto& [face, corner] : corners_of_parts(body)) {
            throw_if_cancelled();
            const std::optional<Ray> ray = ray_from(start, of_moving, face, corner);
            if (ray && ray->winding <= 0)
                result.text += "outside " + ray->words + "\n";
            else
                miss(result, "that no part of a body is inside of the other one at the start");
        }
    }
}

void TwoBodies::add_proof(const Claim& claim, Certificate& result) const {
    add_outside(result);
    std::size_t open = 0;
    for (std::size_t index = 0; index < motion_.piece_count() && index <= claim.piece; ++index) {
        const Proof proof = prove(piece(index), index == claim.piece ? claim.tau.lower : 1);
        result.text += "proof " + std::to_string(index) + "\n" + proof.steps;
        result.planes += proof.planes;
        open += proof.open;
    }
    if (open > 0)
        miss(result, std::to_string(open) + " steps, where the bodies are nearer to each other than planes can tell");
}

void TwoBodies::add_witness(const Claim& claim, Certificate& result) const {
    if (claim.moving_is_inside) {
        if (const auto words = witness_inside(*claim.moving_is_inside))
            result.text += *words + "\n";
        else
            miss(result, "that a part of a body is inside of the other one");
    } else if (const auto words = witness_at(piece(claim.piece), claim.tau.upper)) {
        result.text += *words + "\n";
    } else {
        miss(result, "the contact: no edge was found that passes through a convex face");
    }
}

std::optional<std::string> TwoBodies::witness_inside(bool of_moving) const {
    const PieceOfBodies start = piece(0);
    for (const auto& [face, corner] : corners_of_parts((of_moving ? moving_ : fixed_).body()))
        if (const auto ray = ray_from(start, of_moving, face, corner); ray && ray->winding > 0)
            return "witness inside " + ray->words;
    return std::nullopt;
}

} // namespace chasles::certificate
