"""What controllers make of a planned path: TOPP-RA's splines and Ruckig's steps, as polynomials."""

import numpy as np
import ruckig
import toppra
import toppra.algorithm
import toppra.constraint

import chasles

# Of Franka's data sheet, per second, second squared and third.
VELOCITIES = np.array([2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61])
ACCELERATIONS = np.array([15, 7.5, 10, 12.5, 15, 20, 20])
JERKS = np.array([7500, 3750, 5000, 6250, 7500, 10000, 10000])


def without_repeats(path: np.ndarray) -> np.ndarray:
    moves = np.linalg.norm(np.diff(path, axis=0), axis=1) > 1e-9
    return path[np.concatenate([[True], moves])]


def with_points_between(path: np.ndarray, spacing: float) -> np.ndarray:
    """Further points on the straight edges, at most so far apart (2-norm, rad)."""
    points = [path[:1]]
    for start, goal in zip(path[:-1], path[1:], strict=True):
        count = max(1, int(np.ceil(np.linalg.norm(goal - start) / spacing)))
        points.append(start + np.linspace(0, 1, count + 1)[1:, None] * (goal - start))
    return np.vstack(points)


def by_toppra(robot: chasles.Robot, path: np.ndarray) -> chasles.JointPath | None:
    """A cubic spline through the points, timed, and fitted again over time (ParametrizeSpline, the default).

    ParametrizeConstAccel would only time the first spline. None where TOPP-RA finds no timing.
    """
    lengths = np.linalg.norm(np.diff(path, axis=0), axis=1)
    spline = toppra.SplineInterpolator(np.concatenate([[0], np.cumsum(lengths)]), path)
    limits = [
        toppra.constraint.JointVelocityConstraint(np.column_stack([-VELOCITIES, VELOCITIES])),
        toppra.constraint.JointAccelerationConstraint(np.column_stack([-ACCELERATIONS, ACCELERATIONS])),
    ]
    trajectory = toppra.algorithm.TOPPRA(limits, spline).compute_trajectory()
    if trajectory is None:
        return None
    return chasles.JointPath.polynomials(robot, trajectory.cspl.x, trajectory.cspl.c)


def ruckig_steps(start: np.ndarray, goal: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times, positions and velocities at the ends of all steps of all joints, from rest to rest."""
    joints = len(start)
    question = ruckig.InputParameter(joints)
    question.current_position, question.target_position = list(start), list(goal)
    question.max_velocity, question.max_acceleration = list(VELOCITIES), list(ACCELERATIONS)
    question.max_jerk = list(JERKS)
    trajectory = ruckig.Trajectory(joints)
    result = ruckig.Ruckig(joints).calculate(question, trajectory)
    if result not in (ruckig.Result.Working, ruckig.Result.Finished):
        raise RuntimeError(f"ruckig: {result}")
    ends = np.concatenate([[0.0, trajectory.duration], *(np.cumsum(p.t) for p in trajectory.profiles[0])])
    ends = np.unique(np.clip(ends, 0, trajectory.duration))
    times = ends[np.concatenate([[True], np.diff(ends) > 1e-9])]
    states = [trajectory.at_time(float(time)) for time in times]
    return times, np.array([s[0] for s in states]), np.array([s[1] for s in states])


def by_ruckig(robot: chasles.Robot, path: np.ndarray) -> chasles.JointPath:
    """A stop at each point. Joints are synchronised in time (the default): they do not stay on the straight edge."""
    all_times, all_positions, all_velocities = [np.zeros(1)], [path[:1]], [np.zeros((1, path.shape[1]))]
    for start, goal in zip(path[:-1], path[1:], strict=True):
        times, positions, velocities = ruckig_steps(start, goal)
        all_times.append(all_times[-1][-1] + times[1:])
        all_positions.append(positions[1:])
        all_velocities.append(velocities[1:])
    return chasles.JointPath.cubic(robot, *map(np.concatenate, (all_times, all_positions, all_velocities)))
