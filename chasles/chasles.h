// The stable surface of the library: include this, and link to chasles::chasles.
#pragma once

#include "chasles/base/invalid_input.h"
#include "chasles/contact/constraint_rows.h"
#include "chasles/mesh/polyhedron.h"
#include "chasles/mesh/primitives.h"
#include "chasles/motion/motion.h"
#include "chasles/motion/own_trajectory.h"
#include "chasles/motion/pose.h"
#include "chasles/motion/timed_poses.h"
#include "chasles/query/batch.h"
#include "chasles/query/first_contact.h"
#include "chasles/query/least_distance.h"
#include "chasles/query/path.h"
#include "chasles/robot/pair_proof.h"
#include "chasles/robot/robot.h"
#include "chasles/scene/scene.h"
#include "chasles/scene/stepper.h"
