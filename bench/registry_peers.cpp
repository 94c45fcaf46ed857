#include "bench/registry_peers.h"

#include "bench/peer_motions.h"

#include <filesystem>
#include <fstream>

namespace chasles::bench {

namespace {

/// The folder in which install.sh installs the peers and writes the reasons of failures.
const std::filesystem::path installed = CHASLES_BENCH_REGISTRY;

/// Empty if the program exists, otherwise the reason why it does not.
std::string why_absent(const std::filesystem::path& program, const std::string& reason_file) {
    std::string reason;
    if (std::ifstream file(installed / reason_file); std::getline(file, reason))
        return reason;
    std::error_code unreadable;
    return std::filesystem::exists(program, unreadable) ? "" : "bench/registry/install.sh did not run";
}

} // namespace

PythonPeers python_peers() {
    const std::filesystem::path interpreter = installed / "venv/bin/python";
    return {interpreter.string(), CHASLES_BENCH_REGISTRY_SCRIPTS, why_absent(interpreter, "python-is-absent.txt")};
}

RustPeers rust_peers() {
    const std::filesystem::path program = installed / "parry/release/parry_peer";
    return {program.string(), why_absent(program, "parry-is-absent.txt")};
}

RegistryPeers registry_peers() {
    RegistryPeers all;
    const PythonPeers python = python_peers();
    const auto add = [&all](const ProcessPeer& peer, const std::string& absent_because) {
        if (absent_because.empty())
            all.to_start.push_back(peer);
        else
            all.absent.push_back({peer.name, absent_because});
    };
    const auto add_python = [&](const char* name, const char* way, const auto& pose_at) {
        add({.name = name, .command = {python.interpreter, python.scripts + "/peers.py", way}, .pose_at = pose_at},
            python.absent_because);
    };
    add_python("Coal, start pose only", "coal-start", on_uniform_screw);
    add_python("Coal, distance at the start", "coal-distance", on_uniform_screw);
    add_python("Coal, 100 samples", "coal-samples", on_uniform_screw);
    add_python("python-fcl, default request", "fcl-default", without_turning);
    add_python("python-fcl, screw", "fcl-screw", on_uniform_screw);
    const RustPeers rust = rust_peers();
    add({.name = "Parry, meshes", .command = {rust.program, "mesh"}, .pose_at = on_uniform_screw}, rust.absent_because);
    add({.name = "Parry, convex polyhedra",
         .command = {rust.program, "convex"},
         .pose_at = on_uniform_screw,
         .is_for_convex_bodies_only = true},
        rust.absent_because);
    return all;
}

} // namespace chasles::bench
