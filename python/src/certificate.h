// Certificates of scenes and of robots.
#pragma once

#include "python/src/robot.h"
#include "python/src/scene.h"

namespace chasles::python {

/// `certificate` and `verify`.
void bind_certificates(nanobind::class_<PythonScene>& scene);
void bind_certificates(nanobind::class_<RobotChecker>& checker);

} // namespace chasles::python
