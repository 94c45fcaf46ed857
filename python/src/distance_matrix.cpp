// chasles.DistanceMatrix: the least distances of all pairs of a scene.
#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "chasles/base/number_text.h"
#include "python/src/arrays.h"
#include "python/src/docstrings.h"
#include "python/src/interruptible.h"
#include "python/src/names.h"
#include "python/src/query_options.h"
#include "python/src/scene.h"
#include "view/nearest_first.h"
#include "view/proven_verdict.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

nb::list answers_of(const PythonScene& given, const DistanceMatrix& found) {
    nb::list answers;
    for (const auto& [moving, fixed, nearest] : found.pairs) {
        const std::string &a = given.scene.bodies()[moving].name, &b = given.scene.bodies()[fixed].name;
        LeastAnswer answer{nearest, given.shapes.at(a), given.shapes.at(b), relative_motion(given, a, b)};
        answer.pair = {a, b};
        answers.append(nb::cast(std::move(answer)));
    }
    return answers;
}

PythonMatrix distances_of_all(const PythonScene& given, double tolerance, nb::handle find, unsigned threads,
                              std::optional<double> seconds) {
    const Asking question = given.asking();
    if (seconds && !(*seconds > 0))
        throw InvalidInput("seconds: must be positive");
    const LeastDistanceOptions options{.tolerance = tolerance, .find = find_from(find)};
    PythonMatrix matrix;
    run_interruptibly(
        [&](Progress& progress) {
            const Limit limit(seconds.value_or(std::numeric_limits<double>::infinity()));
            matrix.found = given.scene.least_distances(
                options, {.threads = threads, .progress = [&](std::size_t done) { progress.done = done; }});
        },
        nb::none());
    if (matrix.found.untested.total() > 0)
        matrix.found.untested = given.scene.untested(); // with names
    matrix.names = names_of(given);
    matrix.scene = given.use.state();
    matrix.answers = answers_of(given, matrix.found);
    return matrix;
}

/// (n, n), symmetric; NaN where there is no pair.
nb::object array_of_ends(const PythonMatrix& matrix, double Bracket::*end) {
    const std::size_t count = matrix.names.size();
    std::vector<double> numbers(count * count, std::numeric_limits<double>::quiet_NaN());
    for (const auto& [moving, fixed, nearest] : matrix.found.pairs)
        numbers[moving * count + fixed] = numbers[fixed * count + moving] = nearest.distance.*end;
    return array_of(std::span(numbers), {count, count});
}

std::string summary(const PythonMatrix& matrix) {
    const auto& pairs = matrix.found.pairs;
    const auto touching =
        std::ranges::count_if(pairs, [](const auto& pair) { return pair.nearest.distance.upper == 0; });
    const auto open = std::ranges::count_if(
        pairs, [](const auto& pair) { return view::proven_verdict(pair.nearest) == Verdict::unknown; });
    const std::size_t not_tested = matrix.found.untested.total();
    return fmt::format("{} bodies, {} pairs, {} in contact{}{}", matrix.names.size(), pairs.size(), touching,
                       open > 0 ? fmt::format(", {} perhaps", open) : "",
                       not_tested > 0 ? fmt::format(", {} not tested", not_tested) : "");
}

std::string result_text(const LeastDistance& found) {
    if (found.distance.upper > 0)
        return view::distance_text(found);
    if (found.inside)
        return "contact, inside";
    return found.overlap ? "contact, overlapping" : "contact";
}

/// A line for each pair: those in contact first, by their times, then the nearest ones.
std::string table_of(const PythonMatrix& matrix) {
    const std::vector<const PairDistance*> pairs = view::nearest_first(matrix.found);
    std::string text = summary(matrix);
    for (const PairDistance* pair : pairs)
        text += fmt::format("\n{:<24}at time {:<18}{} on {}", result_text(pair->nearest),
                            time_text(pair->nearest.time.lower), matrix.names[pair->moving], matrix.names[pair->fixed]);
    const std::size_t left = matrix.found.pairs.size() - pairs.size();
    return left > 0 ? text + fmt::format("\nand {} more, farther apart", left) : text;
}

} // namespace

void bind_distance_matrix(nb::module_& module, nb::class_<PythonScene>& scene) {
    using Matrix = PythonMatrix;
    nb::class_<Matrix>(module, "DistanceMatrix", doc("DistanceMatrix"), collected<Matrix>())
        .def_prop_ro(
            "names", [](const Matrix& m) { return m.names; },
            "The names of the bodies, in the order of rows and columns.")
        .def_prop_ro(
            "pairs", [](const Matrix& m) { return nb::list(m.answers); },
            nb::sig("def pairs(self) -> list[LeastDistance]"),
            "The answer of each tested pair, with its names as `pair`, in the order of its bodies.")
        .def_prop_ro(
            "lower", [](const Matrix& m) { return array_of_ends(m, &Bracket::lower); },
            nb::sig("def lower(self) -> " CHASLES_ARRAY),
            "Array (n, n), symmetric: the proven lower ends of the least distances, mesh unit; 0 for pairs that touch. "
            "NaN for pairs that are not tested, and on the diagonal.")
        .def_prop_ro(
            "upper", [](const Matrix& m) { return array_of_ends(m, &Bracket::upper); },
            nb::sig("def upper(self) -> " CHASLES_ARRAY),
            "Array (n, n), symmetric: the upper ends, as `lower`; 0 exactly where contact is proven.")
        .def_prop_ro(
            "untested", [](const Matrix& m) { return m.found.untested; }, "What the answer does not look at.")
        .def("__str__", table_of)
        .def("__repr__", [](const Matrix& m) { return "<chasles.DistanceMatrix: " + summary(m) + ">"; });
    scene.def(
        "least_distances", distances_of_all, nb::kw_only(), "tolerance"_a = default_tolerance,
        "find"_a.none() = "first", "threads"_a = 0, "seconds"_a = nb::none(),
        nb::sig("def least_distances(self, *, tolerance: float = 1e-6, " CHASLES_FIND_TYPE
                ", threads: int = 0, seconds: float | None = None) -> DistanceMatrix"),
        "The least distance of each two bodies over the whole time: the clearance matrix of an assembly. Margins have "
        "no effect, and two\nbodies that both stand still are no pair.\n\nParameters\n----------\ntolerance : float\n"
        "    Width of each bracket to aim for, as a part of the distance; in [1e-12, 1].\nfind : Find or str\n"
        "    'first': one pair of nearest features; 'first_with_all_contacts': every pair.\nthreads : int\n    At most "
        "so many; 0 for all cores. The answer does not depend on it.\nseconds : float, optional\n    After this time, "
        "pairs that were not searched have the distance of the boxes that they sweep and that of two\n    points at "
        "the start, and are not certain. So it is at a Limit.\n\nReturns\n-------\nDistanceMatrix\n\nRaises\n------\n"
        "InvalidInput\n    For an option out of its range.");
}

} // namespace chasles::python
