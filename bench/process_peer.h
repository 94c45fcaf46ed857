// A library that runs in its own process, because it is not a C++ library or has no Debian package.
//
// The protocol has one line per message, with words and decimal numbers separated by blanks:
//
//   peer                                     child
//                                            ready, or: absent WHY
//   body V T x y z ... a b c ...             done           V vertices, T triangles; numbered from 0 as they come
//   ask MOVING FIXED x y z w x y z  x ...    answer TOUCHES TIME SECONDS
//
// `ask` has the numbers of two bodies, and the poses of start and goal: a translation and a unit quaternion, w first.
// TOUCHES is 0 or 1. TIME in [0, 1] is the time of the first contact, or - if the library does not report it. SECONDS
// is the time of the library by the child's own clock, which excludes the communication. Any reply may instead be:
// failed WHY.
#pragma once

#include "bench/child_process.h"
#include "bench/peer.h"

namespace chasles::bench {

/// The command that starts a library, and the library's motion.
struct ProcessPeer {
    struct Limits {
        ChildProcess::Limit start{60};
        ChildProcess::Limit body{60};
        ChildProcess::Limit question{10};
    };

    std::string name;
    std::vector<std::string> command; ///< the program and its arguments
    std::function<Eigen::Isometry3d(const Displacement&, double time)> pose_at;
    bool is_for_convex_bodies_only = false;
    Limits limits{};
};

/// Throws PeerFailed unless the child's first line is `ready`.
void expect_ready(ChildProcess& child, ChildProcess::Limit limit);

/// The answer of a line. Throws PeerFailed if the line reports a failure or is not an answer.
PeerAnswer answer_in(const std::string& line);

/// Throws PeerFailed if the child does not start, and for every query without an answer. The next query and the next
/// pair of bodies then start a new child. A body is identified by the address of its vertices, which must not change.
Peer process_peer(const ProcessPeer& peer);

} // namespace chasles::bench
