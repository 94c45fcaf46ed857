// The parts of the module. Each function is in the source file of its name.
#pragma once

#include <nanobind/nanobind.h>

namespace chasles::python {

void bind_polyhedron(nanobind::module_& module);
void bind_own_trajectories(nanobind::module_& module);
void bind_trajectories(nanobind::module_& module);
void bind_motions(nanobind::module_& module);
void bind_contacts(nanobind::module_& module);
void bind_answers(nanobind::module_& module);
void bind_queries(nanobind::module_& module);
void bind_batches(nanobind::module_& module);
void bind_least_distance(nanobind::module_& module);
void bind_profile(nanobind::module_& module);
void bind_untested(nanobind::module_& module);
void bind_scene(nanobind::module_& module);
void bind_nearest_pair(nanobind::module_& module);
void bind_stepper(nanobind::module_& module);
void bind_drag(nanobind::module_& module);
void bind_limit(nanobind::module_& module);
void bind_robot(nanobind::module_& module);
void bind_robot_answers(nanobind::module_& module);
void bind_joint_path(nanobind::module_& module);
void bind_robot_clearance(nanobind::module_& module);
void bind_certificate(nanobind::module_& module);
void bind_view(nanobind::module_& module);
void bind_record(nanobind::module_& module);
void bind_timing(nanobind::module_& module);
void bind_end_of_process(nanobind::module_& module);
void bind_use(nanobind::module_& module);
/// Called by bind_drag.
void bind_drag_options(nanobind::module_& module);

} // namespace chasles::python
