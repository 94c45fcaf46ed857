// Chasles, asked as the others are: from two poses, with the hierarchies built.
#pragma once

#include "bench/peer.h"

namespace chasles::bench {

/// What all others are compared with: the time of the first contact.
Peer chasles_first();

/// Whether there is a contact at all.
Peer chasles_any();

} // namespace chasles::bench
