// A library that is asked in a process of its own, because it is not one of C++ or not one of Debian's.
//
// The protocol is one line a message, words and decimal numbers between blanks:
//
//   peer                                     child
//                                            ready, or: absent WHY
//   body V T x y z ... a b c ...             done           V vertices, T triangles; numbered from 0 as they come
//   ask MOVING FIXED x y z w x y z  x ...    answer TOUCHES TIME SECONDS
//
// A question has the numbers of two bodies and two poses, of start and goal: a translation and a unit quaternion, w
// first. TOUCHES is 0 or 1; TIME, in [0, 1], is that of the first contact, or - where it is not told; SECONDS is what
// the library took, by the child's own clock, so that the way there and back is not timed. Instead of any answer a
// child may say: failed WHY.
#pragma once

#include "bench/child_process.h"
#include "bench/peer.h"

namespace chasles::bench {

/// How to start a library, and what it does.
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

/// Throws PeerFailed if a child's first line is another one.
void expect_ready(ChildProcess& child, ChildProcess::Limit limit);

/// What an answer's line says. Throws PeerFailed if it says that there is none, or is none.
PeerAnswer answer_in(const std::string& line);

/// Throws PeerFailed if it does not start. So does every question that is not answered; the next one, and the next
/// pair of bodies, get a new child. Bodies are told apart by where their vertices are, and have to stay there.
Peer process_peer(const ProcessPeer& peer);

} // namespace chasles::bench
