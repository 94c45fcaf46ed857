#include "chasles/query/first_contact.h"

#include "chasles/query/pair_query.h"
#include "chasles/query/requirements.h"
#include "chasles/query/swap_roles.h"

namespace chasles {

void check_motion(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion) {
    query::require_near(moving.body(), fixed.body(), motion.trajectory());
}

FirstContact first_contact(const FirstContactQuery& query) {
    query::check_options(query.options);
    query::require(!query.memory || query.memory->is_of(query.moving, query.fixed), "memory", "is of other bodies");
    return query::answer_or_unknown({query.moving.body(), query.fixed.body(), query.motion.trajectory(), query.options,
                                     1, query.memory ? query.memory->of_searches() : search::no_memory()});
}

FirstContact FirstContact::swapped() const {
    FirstContact other = *this;
    query::swap_roles(other);
    query::swap_roles(other.held);
    return other;
}

} // namespace chasles
