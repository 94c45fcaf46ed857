// chasles.UntestedPairs: what an answer about many bodies does not look at.
#include "chasles/scene/untested_pairs.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"
#include "view/names.h"

#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

namespace nb = nanobind;

/// The names by reason; links without shapes stand for their pairs.
nb::dict reasons_of(const UntestedPairs& untested) {
    nb::dict reasons;
    for (std::size_t i = 0; i < UntestedPairs::reasons; ++i)
        if (untested.counts[i] > 0)
            reasons[nb::str(view::name_of(UntestedReason(i)).data())] = untested.counts[i];
    return reasons;
}

nb::list named_pairs(const UntestedPairs& untested) {
    nb::list named;
    for (const UntestedPair& pair : untested.named)
        named.append(nb::make_tuple(pair.first, pair.second, std::string(view::name_of(pair.reason))));
    return named;
}

std::string text_of(const UntestedPairs& untested) {
    std::string text;
    for (std::size_t i = 0; i < UntestedPairs::reasons; ++i)
        if (untested.counts[i] > 0)
            text += fmt::format("{}{} {}", text.empty() ? ": " : ", ", untested.counts[i],
                                view::name_of(UntestedReason(i)));
    return fmt::format("<chasles.UntestedPairs: {} of {} pairs{}>", untested.total(),
                       untested.total() + untested.tested, text);
}

} // namespace

void bind_untested(nb::module_& module) {
    nb::class_<UntestedPairs>(module, "UntestedPairs", doc("UntestedPairs"))
        .def_ro("tested", &UntestedPairs::tested, doc("UntestedPairs.tested"))
        .def("__len__", &UntestedPairs::total)
        .def_prop_ro("reasons", reasons_of, nb::sig("def reasons(self) -> dict[str, int]"),
                     "The number of pairs by reason: 'no_shapes', 'at_rest', 'adjacent', 'disabled', 'ignored', "
                     "'touching_at_start'.")
        .def_prop_ro("named", named_pairs, nb::sig("def named(self) -> list[tuple[str, str, str]]"),
                     "Both names and the reason of each pair; of each reason at most 100, and of 'no_shapes' none.")
        .def_ro("without_shapes", &UntestedPairs::without_shapes, doc("UntestedPairs.without_shapes"))
        .def("__repr__", text_of);
}

} // namespace chasles::python
