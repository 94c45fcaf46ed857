// What a robot file says, as dicts, lists and arrays: of the fields of chasles::RobotDescription, under the same names.
#pragma once

#include "chasles/robot/robot_description.h"

#include <nanobind/nanobind.h>

namespace chasles::python {

/// Keys that are left out have the values of the C++ fields. Throws InvalidInput and TypeError "robot: WHERE: WHY".
RobotDescription description_from(nanobind::handle dict);

/// The inverse, bit for bit: every key, with poses as seven numbers.
nanobind::dict dict_of(const RobotDescription& robot);

} // namespace chasles::python
