"""One motion of every kind: a cube comes down the x axis from 3 to -1, or turns about z."""

import chasles

START, GOAL = [3, 0.2, 0.3, 1, 0, 0, 0], [-1, 0.2, 0.3, 1, 0, 0, 0]


def trajectory():
    return chasles.Trajectory(
        lambda time: [3 - 4 * time, 0.2, 0.3, 1, 0, 0, 0],
        lambda start, end: {"turn_rate": 0, "turn_acceleration": 0, "speed": 4, "acceleration": 0},
    )


def slider():
    return chasles.Motion.at_rest(START) * chasles.Motion.slider([-1, 0, 0], [0, 4])


KINDS = {
    "screw": lambda: chasles.ScrewMotion.between(START, GOAL),
    "screw of two bodies": lambda: chasles.ScrewMotion.relative(START, GOAL, [0, 0, 0, 1, 0, 0, 0], GOAL),
    "sweep": lambda: chasles.SweepMotion.between(START, GOAL),
    "velocity": lambda: chasles.ConstantVelocity.between(START, GOAL),
    "twist": lambda: chasles.ConstantTwist.between(START, GOAL),
    "timed poses": lambda: chasles.TimedPoses.through([0, 1, 2], [START, START, GOAL]),
    "trajectory": trajectory,
    "rest": lambda: chasles.Motion.at_rest(START),
    "hinge": lambda: chasles.Motion.hinge([2, 2, 0], [0, 0, 1], [0, 3]),
    "slider": slider,
    "polynomial": lambda: chasles.Motion.polynomial([[3, 0.2, 0.3], [-4, 0, 0]]),
    "spline": lambda: chasles.Spline.through([0, 0.5, 1], [START, [1.5, 0.2, 0.3, 1, 0, 0, 0], GOAL]),
    "b spline": lambda: chasles.Spline.b_spline([START, START, GOAL, GOAL]),
    "product": lambda: chasles.ConstantVelocity.between(START, GOAL) * chasles.Motion.hinge([0, 0, 0], [0, 0, 1], [0, 1]),
    "relative": lambda: chasles.relative(slider(), chasles.Motion.hinge([9, 9, 0], [0, 0, 1], [0, 0.01])),
    "rest of": lambda: chasles.rest_of(slider(), 0.25),
    "reversed": lambda: (chasles.Motion.hinge([2, 2, 0], [0, 0, 1], [3, -3]) * chasles.Motion.at_rest(START)).reversed(),
    "relative trajectory": lambda: chasles.relative(trajectory(), chasles.Motion.at_rest([0, 0, 0, 1, 0, 0, 0])),
}
