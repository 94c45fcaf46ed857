// What every library of the comparison is asked, and what it answers.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/pose.h"

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace chasles::bench {

/// Where the moving body starts and where it ends, in the frame of the fixed one. What it does in between is the
/// peer's.
struct Displacement {
    Pose start;
    Pose goal;
};

/// Do the bodies touch on the way, and when?
struct PeerAnswer {
    bool touches = false;
    std::optional<double> time;      ///< of the first contact, in [0, 1], from peers that tell it
    std::optional<double> seconds{}; ///< what the question took, from peers that know better than whoever asks them
};

/// Why a peer gives no answer, in one line.
struct PeerFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Two bodies as a peer holds them, with all that it prepares once. Asking may throw PeerFailed.
struct PeerPair {
    std::function<PeerAnswer(const Displacement&)> ask;
    /// Where the peer's own motion has the moving body at a time.
    std::function<Eigen::Isometry3d(const Displacement&, double time)> pose_at;
};

/// A library, and a way to ask it.
struct Peer {
    std::string name;
    /// The bodies have to outlive the pair. May throw PeerFailed.
    std::function<PeerPair(const Polyhedron& moving, const Polyhedron& fixed)> prepare;
    bool is_for_convex_bodies_only = false;
};

/// A library that cannot be asked here. It is named all the same, so that nobody thinks that it was beaten.
struct AbsentPeer {
    std::string name;
    std::string reason;
};

} // namespace chasles::bench
