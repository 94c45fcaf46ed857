// The queries that every library of the comparison runs, and their answers.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/pose.h"

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace chasles::bench {

/// The start and the goal of the moving body in the frame of the fixed body. Each peer has its own motion in between.
struct Displacement {
    Pose start;
    Pose goal;
};

/// Whether and when the bodies touch during the motion.
struct PeerAnswer {
    bool touches = false;
    std::optional<double> time;      ///< time of the first contact in [0, 1], if the peer reports it
    std::optional<double> seconds{}; ///< duration of the query by the peer's own clock, if it has one
};

/// The reason why a peer gives no answer, in one line.
struct PeerFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Two bodies with all data that a peer prepares once. ask() may throw PeerFailed.
struct PeerPair {
    std::function<PeerAnswer(const Displacement&)> ask;
    /// The pose of the moving body at a time of the peer's own motion.
    std::function<Eigen::Isometry3d(const Displacement&, double time)> pose_at;
};

/// A library and one of its queries.
struct Peer {
    std::string name;
    /// The bodies must outlive the pair. May throw PeerFailed.
    std::function<PeerPair(const Polyhedron& moving, const Polyhedron& fixed)> prepare;
    bool is_for_convex_bodies_only = false;
};

/// A library that is not available. The table lists it, to show that it was not compared.
struct AbsentPeer {
    std::string name;
    std::string reason;
};

} // namespace chasles::bench
