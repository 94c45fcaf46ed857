#include "chasles/query/first_contact.h"

#include "chasles/query/pair_query.h"

#include <utility>

namespace chasles {

FirstContact first_contact(const FirstContactQuery& query) {
    query::check_options(query.options);
    return query::answer({query.moving.body(), query.fixed.body(), query.motion.trajectory(), query.options});
}

FirstContact FirstContact::swapped() const {
    FirstContact other = *this;
    for (std::vector<Contact>* list : {&other.contacts, &other.held})
        for (Contact& contact : *list)
            contact = contact.swapped();
    if (other.overlap)
        other.overlap->edge_is_moving = !other.overlap->edge_is_moving;
    std::swap(other.pose, other.fixed_pose);
    return other;
}

} // namespace chasles
