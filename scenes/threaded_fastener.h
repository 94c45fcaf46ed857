// A metric bolt and its nut with real thread flanks, as closed triangle meshes.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "scenes/metric_thread.h"

namespace chasles::scenes {

/// A hexagon bolt, threaded up to its head (like ISO 4017), and a thin hexagon nut (like ISO 4035); lengths in
/// millimetres.
///
/// The axis is z. The bolt's head ends at z = 0 and its tip is at z = bolt_length; the nut stands on z = 0. In these
/// positions both threads are in phase: the nut's tooth is in the middle of the bolt's gap. Raising the nut by a whole
/// number of pitches keeps the threads in phase. Turning the nut counter-clockwise raises it.
struct ThreadedFastener {
    double nominal_diameter = 16;
    double pitch = 2;
    double bolt_length = 30;
    double head_height = 10;
    double nut_height = 8;
    double width_across_flats = 24;
    double radial_clearance = 0.1; ///< the nut has the basic profile, and every radius of the bolt is smaller by this;
                                   ///< the middle of the tolerances 6g/6H of M16 gives 0.11
    int segments = 36;             ///< facets per turn

    [[nodiscard]] MetricThread bolt_thread() const;
    [[nodiscard]] MetricThread nut_thread() const;
};

/// The distance by which the nut could move along the axis from the middle of its play if the flanks had no facets.
double axial_clearance(const ThreadedFastener& fastener);

/// Upper bounds, for any position on the thread, on how much the facets of both bodies reduce axial_clearance() and the
/// radial clearance. Source: docs/derivations/09-threaded-fastener.md.
double axial_facet_error(const ThreadedFastener& fastener);
double radial_facet_error(const ThreadedFastener& fastener);

/// The bodies. Both functions throw InvalidInput if a size is not positive, if the hexagon is too small for the thread,
/// if the bolt is too thin for its pitch, if there are fewer than 12 or more than 10,000 segments, or if the facets
/// would use up the clearance.
Polyhedron bolt(const ThreadedFastener& fastener);
Polyhedron nut(const ThreadedFastener& fastener);

} // namespace chasles::scenes
