// Two bodies and one piece of motion, for tests of what a search uses.
#pragma once

#include "chasles/query/first_contact.h"
#include "chasles/search/piece_context.h"

namespace chasles::test {

struct BodiesInMotion {
    Polyhedron moving;
    Polyhedron fixed;
    Motion motion;
    search::PieceContext context{moving.body(), fixed.body(), motion.trajectory().pieces()->at(0)};

    [[nodiscard]] contact::RelativeConfiguration at(double tau) const { return context.configuration_at(tau); }
};

} // namespace chasles::test
