// Families of elementary questions: a vertex and a triangle, or two edges, under one motion.
#pragma once

#include "tests/attack/lattice.h"

#include <span>

namespace chasles::attack {

enum class QuestionKind : std::uint8_t { vertex_face, face_vertex, edge_edge };

/// Body coordinates of four points: one, two or three moving points, the others fixed.
struct Question {
    QuestionKind kind = QuestionKind::vertex_face;
    std::vector<Eigen::Vector3d> moving;
    std::vector<Eigen::Vector3d> fixed;
};

/// Several questions with one motion.
struct QuestionGroup {
    PosedMotion posed; ///< one piece
    std::vector<Question> questions;
};

struct ElementaryFamily {
    const char* name;
    double share;
    QuestionGroup (*make)(AttackRandom& random);
};

inline constexpr std::size_t questions_of_group = 32;

std::span<const ElementaryFamily> elementary_families();

} // namespace chasles::attack
