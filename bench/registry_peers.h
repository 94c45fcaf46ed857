// Libraries of the Python Package Index and of crates.io, each in its own process. bench/registry/install.sh installs
// them.
#pragma once

#include "bench/process_peer.h"

#include <vector>

namespace chasles::bench {

/// The interpreter of the virtual environment and its scripts. Empty, with the reason, if there is no environment.
struct PythonPeers {
    std::string interpreter;
    std::string scripts;
    std::string absent_because;
};
PythonPeers python_peers();

/// The programs that run Parry. Empty, with the reason, if they are not built.
struct RustPeers {
    std::string program;
    std::string absent_because;
};
RustPeers rust_peers();

/// All peers of the registries. `to_start` may still fail to start; `absent` are the peers that are not installed.
struct RegistryPeers {
    std::vector<ProcessPeer> to_start;
    std::vector<AbsentPeer> absent;
};
RegistryPeers registry_peers();

} // namespace chasles::bench
