// Reads the fixtures of Rigid IPC (Ferguson et al., "Intersection-free Rigid Body Dynamics", 2021) as scenes.
//
// What a fixture means is not written down; it follows from the simulator's source, github.com/ipc-sim/rigid-ipc (docs/
// scenes-rigid-ipc.md says it for users):
// - src/io/read_rb_scene.cpp: vertices are scaled about the origin of the mesh (`dimensions`, the sizes of the box,
//   stand instead of `scale`), then turned about it by `rotation`, degrees about the fixed axes x, y, z in this order,
//   then moved by `position`. Angular velocities are in degrees a second about axes of the world. Bodies that are not
//   `enabled` are left out. Bodies of one `group_id` are not tested against each other, nor are static and kinematic
//   bodies.
// - src/physics/rigid_body.cpp: the centre of mass is the point that moves straight; a body whose freedoms are all
// fixed
//   is static. Fixed freedoms are the three translations and the three rotations about axes of the world.
// - src/physics/mass.cpp: the centre of mass is that of the volume, or of the surface where the mesh is not closed.
// - src/problems/distance_barrier_rb_problem.cpp: kinematic bodies keep their velocities, static ones stand still.
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

/// Whether bodies keep their given velocities, or those that may fall do so.
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
