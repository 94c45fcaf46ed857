// What a certificate proves of many bodies in one world. Source: docs/certificate.md, "Scenes".
#pragma once

#include "chasles/certificate/two_bodies.h"
#include "chasles/motion/moving_frame.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace chasles::certificate {

/// A body and its chain in the world.
struct MovingBody {
    std::string name; ///< for messages
    Polyhedron shape;
    motion::ChainLinks chain;
};

/// The links of a body that moves with a frame. Throws InvalidInput "certificate: NAME: WHY" for other motions.
motion::ChainLinks chain_of(const motion::MovingFrame& frame, const std::string& name);

struct ManyBodies {
    std::vector<MovingBody> bodies;
    std::size_t piece_count = 1; ///< of the chains of all bodies that move
    /// For the bodies i < j: in the order of i, then of j. Empty for a pair that is not tested.
    std::vector<std::optional<double>> margins;
};

/// The first contact of all pairs.
struct ManyClaim {
    Claim claim;
    std::size_t first = 0, second = 0; ///< the bodies of the contact, first < second; the first one is the moving one

    void exchange() {
        std::swap(first, second);
        if (claim.moving_is_inside)
            claim.moving_is_inside = !*claim.moving_is_inside;
    }
};

/// Throws InvalidInput "certificate: WHY" for bodies that are not certified. Throws Cancelled.
Certificate certify(const ManyBodies& question, const ManyClaim& answer);

/// Whether a certificate is about these bodies and pairs.
bool is_about(const std::string& text, const ManyBodies& question);

} // namespace chasles::certificate
