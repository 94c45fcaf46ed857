// Distances over time as Python objects.
#pragma once

#include "python/src/bind.h"
#include "python/src/robot.h"
#include "python/src/scene.h"

namespace chasles::python {

/// Adds the method `profile`.
void bind_profile(nanobind::class_<PythonScene>& scene);
void bind_profile(nanobind::class_<PythonRobot>& robot);

} // namespace chasles::python
