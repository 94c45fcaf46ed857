// Nothing that users hold is aligned beyond a double. Eigen aligns its vectorisable types by the widest register that
// the compiler may use, so such a member would give a user's -mavx2 another layout than the library was built with.
#include "chasles/chasles.h"

template <class... Types>
constexpr bool has_one_layout = ((alignof(Types) <= alignof(double)) && ...);

static_assert(has_one_layout<chasles::Pose>);
static_assert(has_one_layout<chasles::ScrewMotion, chasles::SweepMotion, chasles::Motion>);
static_assert(has_one_layout<chasles::Polyhedron, chasles::PolyhedronOptions, chasles::MeshReport>);
static_assert(has_one_layout<chasles::FirstContactQuery, chasles::FirstContact, chasles::Contact, chasles::Overlap>);
static_assert(has_one_layout<chasles::PathQuery, chasles::PathContact, chasles::BatchQuery>);
