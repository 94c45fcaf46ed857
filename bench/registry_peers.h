// Libraries of the Python Package Index and of crates.io, each in a process of its own. bench/registry/install.sh
// brings them.
#pragma once

#include "bench/process_peer.h"

#include <vector>

namespace chasles::bench {

/// A virtual environment's interpreter and the scripts that it is given; empty, with the reason, if there is none.
struct PythonPeers {
    std::string interpreter;
    std::string scripts;
    std::string absent_because;
};
PythonPeers python_peers();

/// What Parry is asked by, likewise.
struct RustPeers {
    std::string program;
    std::string absent_because;
};
RustPeers rust_peers();

/// All that there may be. Whether they start is seen when they are started; those that are known not to are in
/// `absent`.
struct RegistryPeers {
    std::vector<ProcessPeer> to_start;
    std::vector<AbsentPeer> absent;
};
RegistryPeers registry_peers();

} // namespace chasles::bench
