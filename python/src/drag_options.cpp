// chasles.DragLock and chasles.MassProperties: how a dragged body may move, and how hard turning is.
#include "chasles/base/invalid_input.h"
#include "chasles/manipulation/dragged_body.h"
#include "python/src/arrays.h"
#include "python/src/bind.h"
#include "python/src/poses.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nanobind/stl/string.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

constexpr std::array<const char*, 5> lock_kinds{"free", "hinge", "slider", "cylinder", "plane"}; // as DragLockKind

DragLockKind lock_kind(const std::string& name) {
    const auto found = std::ranges::find(lock_kinds, name);
    if (found == lock_kinds.end())
        throw InvalidInput("drag: lock: the kind must be free, hinge, slider, cylinder or plane, not " + name);
    return DragLockKind(found - lock_kinds.begin());
}

/// What says nothing about a lock is refused.
DragLock lock_from(const std::string& name, nb::handle direction, nb::handle point) {
    DragLock lock{lock_kind(name)};
    const auto set = [&](const char* part, nb::handle given, bool is_part, Eigen::Vector3d& value) {
        if (given.is_none())
            return;
        if (!is_part)
            throw InvalidInput(fmt::format("drag: lock: {}: says nothing about a lock of the kind {}", part, name));
        value = vector_from(given, part);
    };
    const bool has_line = lock.kind == DragLockKind::hinge || lock.kind == DragLockKind::cylinder;
    set("direction", direction, lock.kind != DragLockKind::free, lock.direction);
    set("point", point, has_line, lock.point);
    return lock;
}

constexpr const char* lock_doc =
    "How a dragged body may move, in the world, from where it is when the dragging begins.\n\n"
    "    hand = chasles.DraggedBody(scene, \"door\", lock=chasles.DragLock(\"hinge\", [0, 0, 1], [2, 0, 0]))\n\n"
    "Parameters\n----------\nkind : str\n"
    "    \"hinge\": it turns about a line. \"slider\": it slides along a direction. \"cylinder\": both. \"plane\": it\n"
    "    slides in a plane and turns about its normal. \"free\": every motion.\ndirection : array (3,), optional\n"
    "    Of the line, or the normal of the plane; of any length but zero. By default (0, 0, 1).\n"
    "point : array (3,), optional\n"
    "    On the line of a hinge or a cylinder, mesh unit; by default the origin.\n\n"
    "Raises\n------\nInvalidInput\n    For an unknown kind, and for a direction or a point that says nothing about "
    "the kind. `DraggedBody` refuses directions and points that cannot be "
    "used.";

constexpr const char* mass_doc =
    "How a dragged body resists a hand: its mass, as a share of its whole mass.\n\n"
    "    hand = chasles.DraggedBody(scene, \"nut\", mass=chasles.MassProperties(0.4 * numpy.eye(3), [0, 0, 2]))\n\n"
    "Parameters\n----------\ninertia : array (3, 3)\n"
    "    Moments of inertia about the centre in the body's frame, per mass (mesh unit squared).\ncentre : array (3,)\n"
    "    Of mass, in the body's frame, mesh unit.\n\n"
    "Raises\n------\nInvalidInput\n    For another shape. `DraggedBody` refuses an inertia that is not symmetric and "
    "positive definite.";

void require_parts(const nb::tuple& state, std::size_t parts) {
    if (state.size() != parts)
        throw InvalidInput(fmt::format("state: must have {} parts, not {}", parts, state.size()));
}

using InertiaRows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

MassProperties mass_from(nb::handle inertia, nb::handle centre) {
    const DoubleArray rows(inertia, "inertia");
    if (rows.shape_text() != "(3, 3)")
        throw InvalidInput("inertia: shape " + rows.shape_text() + "; a matrix of inertia has shape (3, 3)");
    return {vector_from(centre, "centre"), Eigen::Map<const InertiaRows>(rows.numbers().data())};
}

void bind_lock(nb::module_& module) {
    nb::class_<DragLock>(module, "DragLock", lock_doc)
        .def(
            "__init__",
            [](DragLock* lock, const std::string& kind, nb::handle direction, nb::handle point) {
                new (lock) DragLock(lock_from(kind, direction, point));
            },
            "kind"_a, "direction"_a = nb::none(), "point"_a = nb::none(),
            nb::sig("def __init__(self, kind: str, direction: numpy.typing.ArrayLike | None = None, point: "
                    "numpy.typing.ArrayLike | None = None) -> None"))
        .def_prop_ro(
            "kind", [](const DragLock& lock) { return lock_kinds.at(std::size_t(lock.kind)); }, "As it was given.")
        .def("__getstate__",
             [](const DragLock& lock) {
                 return nb::make_tuple(lock_kinds.at(std::size_t(lock.kind)), array_of(lock.direction),
                                       array_of(lock.point));
             })
        .def("__setstate__",
             [](DragLock& lock, const nb::tuple& state) {
                 require_parts(state, 3);
                 new (&lock) DragLock{lock_kind(nb::cast<std::string>(state[0])), vector_from(state[1], "direction"),
                                      vector_from(state[2], "point")};
             })
        .def("__repr__", [](const DragLock& lock) {
            return fmt::format("<chasles.DragLock: {}>", lock_kinds.at(std::size_t(lock.kind)));
        });
}

void bind_mass(nb::module_& module) {
    nb::class_<MassProperties>(module, "MassProperties", mass_doc)
        .def(
            "__init__",
            [](MassProperties* mass, nb::handle inertia, nb::handle centre) {
                new (mass) MassProperties(mass_from(inertia, centre));
            },
            "inertia"_a.none(), "centre"_a = nb::make_tuple(0, 0, 0),
            nb::sig("def __init__(self, inertia: numpy.typing.ArrayLike, centre: numpy.typing.ArrayLike = (0, 0, 0)) "
                    "-> None"))
        .def("__getstate__",
             [](const MassProperties& mass) {
                 const InertiaRows inertia = mass.inertia;
                 return nb::make_tuple(array_of(std::span(inertia.data(), 9), {3, 3}), array_of(mass.centre));
             })
        .def("__setstate__", [](MassProperties& mass, const nb::tuple& state) {
            require_parts(state, 2);
            new (&mass) MassProperties(mass_from(state[0], state[1]));
        });
}

} // namespace

void bind_drag_options(nb::module_& module) {
    bind_lock(module);
    bind_mass(module);
}

} // namespace chasles::python
