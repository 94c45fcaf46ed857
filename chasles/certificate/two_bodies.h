// What a certificate proves of two bodies. Source: docs/certificate.md, "Outside", "Proof" and "Witness".
#pragma once

#include "chasles/certificate/certificate.h"
#include "chasles/certificate/separating_normal.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace chasles::certificate {

/// Of a contact: when, and which body is inside of the other one at the start.
struct Claim {
    Verdict verdict = Verdict::clear;
    std::size_t piece = std::numeric_limits<std::size_t>::max(); ///< with the contact, if there is one
    Bracket tau{1, 1};                                           ///< of the contact in this piece
    std::optional<bool> moving_is_inside = {};

    Claim() = default;
    /// The bracket is made wider by 2^-44 at both ends: the bodies are apart before it, and pass through each other
    /// after it.
    Claim(const FirstContact& found, std::size_t piece_of_contact, const Bracket& tau_of_contact);
};

/// The claim of an answer about pieces that begin and end at these times.
Claim claim_at(const std::vector<double>& times, const FirstContact& found);

/// What stands after the word `verdict`.
std::string words_of(const Claim& claim);

/// `order` with the name of the body, if it has one, and the faces.
std::string order_line(const std::string& name, const FaceTree& tree);

/// Two bodies, one of which moves as seen from the other one. All is kept by reference.
class TwoBodies {
public:
    TwoBodies(const FaceTree& moving, const FaceTree& fixed, const CertifiedMotion& motion, double margin);

    /// Adds the lines that prove them free of contact up to that of the claim.
    void add_proof(const Claim& claim, Certificate& result) const;
    /// Adds the line that proves the contact of the claim.
    void add_witness(const Claim& claim, Certificate& result) const;

private:
    [[nodiscard]] PieceOfBodies piece(std::size_t index) const {
        return {moving_, fixed_, motion_.piece(index), reach_};
    }
    void add_outside(Certificate& result) const;
    [[nodiscard]] std::optional<std::string> witness_inside(bool of_moving) const;

    const FaceTree& moving_;
    const FaceTree& fixed_;
    const CertifiedMotion& motion_;
    DoubleDouble reach_;
};

} // namespace chasles::certificate
