// Chasles as a peer: queries between two poses, with the hierarchies already built.
#pragma once

#include "bench/peer.h"

namespace chasles::bench {

/// The reference of the comparison: the time of the first contact.
Peer chasles_first();

/// Yes or no: whether there is any contact.
Peer chasles_any();

} // namespace chasles::bench
