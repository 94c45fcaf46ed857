// Spur gears with involute teeth, as closed triangle meshes.
#pragma once

#include "chasles/mesh/polyhedron.h"

namespace chasles::scenes {

/// A spur gear about z with a round bore and its lower face in z = 0. One tooth points along x. Any length unit.
struct SpurGear {
    std::size_t teeth = 20;
    double module = 1; ///< pitch diameter divided by the number of teeth
    double width = 4;
    double play = 0.2;      ///< backlash of two equal gears; the pitch is pi times the module
    double bore_radius = 0; ///< 0: half of the pitch radius

    [[nodiscard]] double pitch_radius() const { return 0.5 * module * double(teeth); }
};

/// The gear. Flanks are involutes with a pressure angle of 20 degrees. Chords make the teeth thinner, never thicker.
/// Throws InvalidInput if a size is not positive, if there are fewer than 17 or more than 1000 teeth, if the play is
/// not below half of a pitch, and if the bore does not fit into the gear.
Polyhedron spur_gear(const SpurGear& size);

/// The angle in radians about z by which the second gear is turned to mesh with the first gear at angle 0, if the
/// second gear's axis is at the sum of the pitch radii along x.
double meshing_angle(const SpurGear& second);

} // namespace chasles::scenes
