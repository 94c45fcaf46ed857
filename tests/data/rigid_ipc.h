// Reads the fixtures of Rigid IPC (Ferguson et al., "Intersection-free Rigid Body Dynamics", 2021) as scenes.
//
// docs/scenes-rigid-ipc.md lists the conventions. They follow from the simulator's source,
// github.com/ipc-sim/rigid-ipc:
//
// src/io/read_rb_scene.cpp: The mesh is scaled about its origin, turned about its origin by `rotation`, and moved by
// `position`. `dimensions` are the sizes of the box of the mesh and replace `scale`. Rotations are degrees about the
// fixed axes x, y, z in this order. Angular velocities are degrees a second about axes of the world. Bodies that are
// not `enabled` are left out. Bodies of one group are not tested against each other; all static and kinematic bodies
// are one group.
//
// src/physics/rigid_body.cpp: The centre of mass moves straight. The six freedoms are translations along and turns
// about axes of the world. A body is static if all of its freedoms are fixed.
//
// src/physics/mass.cpp: The centre of mass is that of the volume. For an open mesh it is that of the surface.
//
// src/problems/distance_barrier_rb_problem.cpp: Kinematic bodies keep their velocities. Static bodies stand still.
#pragma once

#include "chasles/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace chasles::test {

struct RigidIpcBody {
    std::string name;  ///< number in the fixture and name of the mesh
    std::string group; ///< bodies of one group are not tested against each other; empty: in no group
    Polyhedron shape;  ///< scaled; its origin is the centre of mass
    Pose start;
    Eigen::Vector3d velocity;         ///< of the centre of mass, m/s
    Eigen::Vector3d angular_velocity; ///< about axes of the world, rad/s
    Eigen::Vector3d acceleration;     ///< gravity, m/s^2; zero for bodies that do not fall
};

struct RigidIpcFixture {
    std::string name;       ///< below `fixtures`, without .json
    double time_step = 0;   ///< s
    double max_time = 0;    ///< s; infinite if the fixture has none
    std::size_t unused = 0; ///< bodies that are not enabled
    std::vector<RigidIpcBody> bodies;
};

/// Bodies keep their given velocities, or dynamic bodies also fall under gravity.
enum class RigidIpcFlight { even, falling };

/// The names of all fixtures below FOLDER/fixtures, in the order of the alphabet.
std::vector<std::string> rigid_ipc_names(const std::filesystem::path& folder);

/// Reads FOLDER/fixtures/NAME.json with its meshes in FOLDER/meshes.
RigidIpcFixture read_rigid_ipc(const std::filesystem::path& folder, const std::string& name);

/// The motion of a body during so many seconds, without any contact: the centre of mass on a straight line or a
/// parabola, and an even turn about it.
Motion rigid_ipc_motion(const RigidIpcBody& body, double seconds, RigidIpcFlight flight);

Scene rigid_ipc_scene(const RigidIpcFixture& fixture, double seconds, RigidIpcFlight flight);

} // namespace chasles::test
