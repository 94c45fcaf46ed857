// References to Python objects that Python's garbage collector sees.
//
// A motion along functions of Python is copied into answers, products and scenes. A copy in C++ keeps no reference to
// the functions: the collector would not see the reference, and a cycle through it would never be freed. Instead each
// Python object with a motion in it owns the functions, and tells the collector.
#pragma once

#include <nanobind/nanobind.h>
#include <vector>

namespace chasles::python {

/// Python objects that have to live as long as the object that has this member. Copied with the GIL only.
using Owners = std::vector<nanobind::object>;

inline Owners joined(Owners first, const Owners& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

/// The slots of a Python type whose C++ object has references. `for_each_reference(object, visit)` is found by the type
/// of the object, and calls visit(reference) for each nanobind::object.
template <typename T>
struct CollectedSlots {
    static int traverse(PyObject* self, visitproc visit, void* arg) {
        Py_VISIT(Py_TYPE(self));
        if (!nanobind::inst_ready(self))
            return 0;
        int result = 0;
        for_each_reference(*nanobind::inst_ptr<T>(self), [&](nanobind::object& reference) {
            if (result == 0 && reference.is_valid())
                result = visit(reference.ptr(), arg);
        });
        return result;
    }
    /// The collector calls it for garbage only.
    static int clear(PyObject* self) {
        if (nanobind::inst_ready(self))
            for_each_reference(*nanobind::inst_ptr<T>(self), [](nanobind::object& reference) { reference.reset(); });
        return 0;
    }
    static inline PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(traverse)},
                                         {Py_tp_clear, reinterpret_cast<void*>(clear)},
                                         {0, nullptr}};
};

/// For nanobind::class_: the collector sees the references of objects of this type.
template <typename T>
nanobind::type_slots collected() {
    return nanobind::type_slots(CollectedSlots<T>::slots);
}

} // namespace chasles::python
