// Any motion of a certificate, piece by piece. Source: docs/certificate.md, "Motion".
#pragma once

#include "chasles/certificate/chain_piece.h"
#include "chasles/certificate/rational_piece.h"
#include "chasles/motion/motion.h"
#include "chasles/motion/motion_description.h"

#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace chasles::certificate {

/// Throws InvalidInput "certificate: WHY".
[[noreturn]] void refuse(const std::string& why);

/// One piece; all places are in the frame of the fixed body.
template <class S>
class PieceMotion {
public:
    PieceMotion(RationalPiece<S> piece) : piece_(std::move(piece)) {} // NOLINT(google-explicit-constructor)
    PieceMotion(ChainPiece<S> piece) : piece_(std::move(piece)) {}    // NOLINT(google-explicit-constructor)

    [[nodiscard]] Vector3<S> place(const Corner& corner, const S& tau) const {
        return std::visit([&](const auto& piece) { return piece.place(corner, tau); }, piece_);
    }
    [[nodiscard]] Vector3<S> turned(const Vector3<S>& direction, const S& tau) const {
        return std::visit([&](const auto& piece) { return piece.turned(direction, tau); }, piece_);
    }
    /// Of the corners in the ball.
    [[nodiscard]] PlaneForm<S> against(const Vector3<S>& normal, const S& offset, const Cell& cell,
                                       const Ball& node) const {
        return std::visit([&](const auto& piece) { return piece.against(normal, offset, cell, node); }, piece_);
    }

private:
    std::variant<RationalPiece<S>, ChainPiece<S>> piece_;
};

struct CertifiedPiece {
    PieceMotion<DoubleDouble> refined;
    PieceMotion<double> rounded;
    double size;   ///< of all lengths that enter
    bool is_exact; ///< a checker has places in fractions, not in enclosures
};

/// Motions one after another: those of a path, or one.
class CertifiedMotion {
public:
    /// Throws InvalidInput "certificate: WHY" for motions that are not certified.
    explicit CertifiedMotion(std::span<const Motion> path);
    /// A chain of so many pieces.
    CertifiedMotion(motion::ChainLinks chain, std::size_t piece_count);

    [[nodiscard]] std::string lines() const;
    [[nodiscard]] std::size_t piece_count() const { return piece_count_; }
    [[nodiscard]] CertifiedPiece piece(std::size_t index) const;
    [[nodiscard]] bool is_screw() const { return whole_.kind == motion::MotionDescription::Kind::screw; }

    /// What is asked about as one motion: a piece of a screw, or a motion of a path.
    struct Part {
        Motion motion;
        std::size_t first_piece;
        std::vector<double> times; ///< of the ends of its pieces
    };
    [[nodiscard]] const std::vector<Part>& parts() const { return parts_; } ///< none of a chain that was given

private:
    void add(const Motion& motion);

    motion::MotionDescription whole_;
    std::size_t piece_count_ = 0;
    std::vector<Part> parts_;
};

/// Whether two links are written in the same words.
bool is_same(const motion::ChainLink& a, const motion::ChainLink& b);

/// Whether a chain has no link that moves.
bool is_at_rest(const motion::ChainLinks& chain);

/// The lines `link` of a chain, and so many lines `knot`.
std::string lines_of(const motion::ChainLinks& chain, std::size_t knots);

/// The chain of a body as seen from another one. What carries both is left out.
motion::ChainLinks chain_between(const motion::ChainLinks& moving, const motion::ChainLinks& fixed);

} // namespace chasles::certificate
