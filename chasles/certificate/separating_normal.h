// A plane that stands still and keeps two nodes apart while the moving one moves through a cell.
// Source: docs/certificate.md, "Proof".
#pragma once

#include "chasles/certificate/face_tree.h"
#include "chasles/certificate/piece_motion.h"

#include <array>
#include <optional>
#include <string>

namespace chasles::certificate {

__extension__ using Integer = __int128;
/// A normal whose components are integers below 2^101.
using IntegerNormal = std::array<Integer, 3>;

std::string words_of(const IntegerNormal& normal);

/// Why no plane was found.
struct NotSeparated {
    bool overlap = true; ///< at every tau that was looked at
    double loss = 0;     ///< how much of the gap along the best direction the motion takes away
};

/// Two bodies on a piece. They are kept by reference.
class PieceOfBodies {
public:
    PieceOfBodies(const FaceTree& moving, const FaceTree& fixed, CertifiedPiece piece, const DoubleDouble& reach);

    using Node = FaceTree::Node;
    [[nodiscard]] const FaceTree& moving() const { return moving_; }
    [[nodiscard]] const FaceTree& fixed() const { return fixed_; }
    [[nodiscard]] const PieceMotion<DoubleDouble>& motion() const { return piece_.refined; }
    [[nodiscard]] const DoubleDouble& reach() const { return reach_; }
    [[nodiscard]] double size() const { return size_; } ///< of all lengths that enter
    [[nodiscard]] bool is_exact() const { return piece_.is_exact; }

    /// The direction along which two nodes are farthest apart at a tau, and how far; below 0 where they overlap.
    struct Gap {
        Corner direction;
        double gap = 0;
    };
    [[nodiscard]] Gap gap_at(const Node& a, const Node& b, double tau) const;
    /// Planes found are steps that hold, but for rounding: the checker decides.
    [[nodiscard]] std::optional<IntegerNormal> separate(const Node& a, const Node& b, const Cell& cell,
                                                        const Corner& hint, NotSeparated& why) const;

private:
    [[nodiscard]] std::optional<IntegerNormal> along(const Wide& direction, double gap, const Node& a, const Node& b,
                                                     const Cell& cell, double& least) const;
    template <class S>
    [[nodiscard]] S least_of(const PieceMotion<S>& motion, const Wide& normal, const Node& a, const Node& b,
                             const Cell& cell) const;
    [[nodiscard]] std::optional<IntegerNormal> by_features(const Node& a, const Node& b, const Cell& cell) const;

    const FaceTree& moving_;
    const FaceTree& fixed_;
    CertifiedPiece piece_;
    DoubleDouble reach_;
    double size_;
};

} // namespace chasles::certificate
