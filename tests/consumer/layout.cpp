// No public type is aligned beyond a double. Eigen aligns its vectorisable types to the widest register that the
// compiler may use. A member of such a type would give a user who compiles with -mavx2 a layout that differs from the
// library's.
#include "chasles/chasles.h"

template <class... Types>
constexpr bool has_one_layout = ((alignof(Types) <= alignof(double)) && ...);

static_assert(has_one_layout<chasles::Pose>);
static_assert(has_one_layout<chasles::ScrewMotion, chasles::SweepMotion, chasles::Motion>);
static_assert(has_one_layout<chasles::Polyhedron, chasles::PolyhedronOptions, chasles::MeshReport>);
static_assert(has_one_layout<chasles::FirstContactQuery, chasles::FirstContact, chasles::Contact, chasles::Overlap>);
static_assert(has_one_layout<chasles::PathQuery, chasles::PathContact, chasles::BatchQuery>);
static_assert(has_one_layout<chasles::QueryOptions, chasles::BatchOptions>);
