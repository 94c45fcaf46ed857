// Options that several queries share, with their docstrings.
#pragma once

#include "chasles/query/least_distance.h"
#include "chasles/query/path.h"
#include "python/src/docstrings.h"

#include <string>

namespace chasles::python {

inline constexpr double default_time_tolerance = QueryOptions().time_tolerance;
/// Of least distances.
inline constexpr double default_tolerance = LeastDistanceOptions().tolerance;

#define CHASLES_OPTION_TYPES "margin: float = 0.0, hold: float | None = None, time_tolerance: float = 1e-12, "
#define CHASLES_FIND_TYPE "find: chasles.enums.Find | str = 'first'"

/// A paragraph, indented as the description of a parameter.
inline std::string indented(std::string text) {
    for (std::size_t line = text.find('\n'); line != std::string::npos; line = text.find('\n', line + 5))
        text.insert(line + 1, "    ");
    return "    " + text + "\n";
}

/// The descriptions of the bodies and of the motion, after the first paragraph of a docstring.
inline std::string motion_docs() {
    return "The moving body moves from `start` to `goal` by one screw in the frame of the fixed\nbody, or as "
           "`motion` says.\n\n"
           "Parameters\n----------\nmoving, fixed : Polyhedron\nstart, goal : array (4, 4) or (7,)\n"
           "    Poses of the moving body: matrices, or x y z qw qx qy qz with a quaternion of any length.\n"
           "motion : str or motion\n    'screw' (the default), 'sweep', 'velocity' or 'twist' from start to goal, "
           "about the "
           "bodies'\n    origins; or a motion of any kind instead of the poses.\n"
           "fixed_start, fixed_goal : array (4, 4) or (7,)\n"
           "    Poses of the fixed body, if it moves too; all poses are then in the world.\n";
}

inline constexpr const char* max_turn_docs =
    "max_turn : float, optional\n"
    "    Largest turn of one piece of the screw from start to goal, radians; 10 degrees by default. A\n"
    "    given motion has its own.\n";

inline constexpr const char* invalid_input_docs =
    "Raises\n------\nInvalidInput\n    A ValueError. Its message names the input, the place and the reason.";

/// The descriptions of the shared options for a docstring. `max_turn` is the text of the option of that name.
inline std::string option_docs(const std::string& max_turn) {
    return "margin : float\n" + indented(doc("QueryOptions.margin")) + "hold : float, optional\n" +
           indented(doc("QueryOptions.hold")) + "time_tolerance : float\n" +
           indented(doc("QueryOptions.time_tolerance")) + max_turn + "find : Find or str\n" +
           indented(std::string("'first': ") + doc("Find.first") + ";\n'any': " + doc("Find.any") +
                    ";\n'first_with_all_contacts': " + doc("Find.first_with_all_contacts"));
}

} // namespace chasles::python
