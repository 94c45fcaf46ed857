"""The steps for LeRobot, in its own pipelines. test_lerobot.py runs this file, in a process of its own."""

import doctest
import math

import numpy as np
import pytest
import torch
from arm_by_numpy import Bars, bare_arm, samples
from conftest import ROOT
from lerobot.processor import PolicyProcessorPipeline, RobotProcessorPipeline, TransitionKey
from lerobot.processor.converters import (
    policy_action_to_transition,
    robot_action_observation_to_transition,
    transition_to_policy_action,
    transition_to_robot_action,
)
from seven_joints import arm, box, chunk, clear_configuration, pose
from test_docs import code_of

import chasles
from chasles.lerobot import ActionGateStep, ChunkGateStep, JointMap
from chasles.policy import PolicyGate

MARGIN, LONG = 0.005, 60_000.0
DEGREES = math.pi / 180
KEYS = [f"joint{i + 1}.pos" for i in range(7)]


@pytest.fixture(scope="module")
def robot():
    description = arm().description()
    for link in description["links"]:
        if link["name"] in ("base", "hand"):
            link["collisions"] = []
    return bare_arm(chasles.Robot(**description))


@pytest.fixture
def wall():
    """In the way of joint2, whose positive angles lead to it."""
    scene = chasles.Scene()
    scene.add("wall", box(0.01, 2, 2), pose(0.5, 0, 1))
    return scene


def policy_pipeline(step):
    return PolicyProcessorPipeline(
        steps=[step], to_transition=policy_action_to_transition, to_output=transition_to_policy_action
    )


def robot_pipeline(step):
    return RobotProcessorPipeline(
        steps=[step], to_transition=robot_action_observation_to_transition, to_output=transition_to_robot_action
    )


def gate(robot, scene=None, **options):
    return PolicyGate(robot, scene, **{"margin": MARGIN, "mode": "shorten", "milliseconds": LONG, **options})


def leaning(*angles):
    """Actions in degrees, (1, n, 7): joint2 at these angles."""
    actions = torch.zeros(1, len(angles), 7)
    actions[0, :, 1] = torch.tensor(angles)
    return actions


def state(angle=0.0):
    return np.array([0, angle, 0, 0, 0, 0, 0], float)


# --- Chunks ---


def test_a_chunk_keeps_its_shape_and_stops_where_it_is_proven(robot):
    """10,000 poses on the way through all actions that come out keep the margin, by NumPy."""
    random, verdicts, poses = np.random.default_rng(1), set(), 0
    for _ in range(4):
        bars = Bars(random)
        checker = chasles.RobotChecker(robot, bars.scene(), margin=MARGIN)
        for _ in range(5):
            present = clear_configuration(robot, checker, random)
            actions = torch.tensor(chunk(robot, random, present) / DEGREES, dtype=torch.float32)[None]
            step = ChunkGateStep(
                gate(robot, bars.scene()), JointMap(robot, robot.variables, scale=DEGREES), lambda at=present: at / DEGREES
            )
            out = policy_pipeline(step)(actions)
            passed = len(step.decision.actions)
            assert out.shape == actions.shape and out.dtype == actions.dtype
            assert torch.equal(out[0, :passed], actions[0, :passed]), "what passes is unchanged"
            assert passed == 0 or torch.equal(out[0, passed:], out[0, passed - 1].expand(50 - passed, 7))
            at = samples(np.vstack([present, out[0].double().numpy() * DEGREES]))[1]
            assert bars.distances(at).min() > MARGIN - 1e-12
            verdicts.add(step.decision.verdict)
            poses += len(at)
    assert poses >= 10_000 and {"passed", "shortened"} <= verdicts


@pytest.mark.parametrize("dtype", [torch.float32, torch.float64, torch.bfloat16])
def test_a_refused_chunk_is_the_present_state(robot, wall, dtype):
    step = ChunkGateStep(gate(robot, wall, mode="refuse"), JointMap(robot, robot.variables, scale=DEGREES), lambda: state(2))
    for actions in (leaning(10, 60), leaning(60), leaning(60)[0], leaning(60)[0, 0]):
        out = policy_pipeline(step)(actions.to(dtype))
        assert step.decision.verdict == "refused" and step.decision.pair[1] == "wall"
        assert out.shape == actions.shape and out.dtype == dtype
        assert torch.equal(out, torch.tensor(state(2)).to(dtype).expand(actions.shape))
    assert torch.equal(policy_pipeline(step)(leaning(10).to(dtype)), leaning(10).to(dtype))


def test_a_slowed_chunk_goes_as_far_as_its_period_allows(robot, wall):
    fast = gate(robot, wall, mode="scale", full_speed_from=0.5)
    step = ChunkGateStep(fast, JointMap(robot, robot.variables, scale=DEGREES), lambda: state())
    out = policy_pipeline(step)(leaning(*range(1, 11)))
    assert step.decision.verdict == "slowed" and out.shape == (1, 10, 7)
    steps = np.diff(out[0, :, 1].numpy(), prepend=0)
    assert np.all(steps > 0) and np.all(steps <= step.decision.speeds[0] + 1e-6) and steps[-1] < 1


def test_a_robot_that_sags_is_told_to_stay_where_it_was_stopped(robot, wall):
    angles = iter([0.0, 0.3, 0.6, 40.0, 0.9])
    step = ChunkGateStep(gate(robot, wall), JointMap(robot, robot.variables, scale=DEGREES), lambda: state(next(angles)))
    pipeline = policy_pipeline(step)
    told = [float(pipeline(leaning(90))[0, 0, 1]) for _ in range(3)]
    assert told == [0, 0, 0]
    assert pipeline(leaning(90))[0, 0, 1] == 40, "in the wall: no way is proven"
    pipeline.reset()
    assert float(pipeline(leaning(90))[0, 0, 1]) == pytest.approx(0.9)


# --- Single actions ---


def test_an_action_goes_from_the_observed_state(robot, wall):
    step = ActionGateStep(gate(robot, wall), JointMap(robot, robot.variables, scale=DEGREES), KEYS)
    pipeline = robot_pipeline(step)
    observation = {**dict(zip(KEYS, state(5), strict=True)), "camera": np.zeros((2, 2))}
    for angle, verdict in ((8.0, "passed"), (60.0, "refused")):
        action = dict(zip(KEYS, state(angle), strict=True))
        out = pipeline((action, observation))
        assert step.decision.verdict == verdict
        assert out == (action if verdict == "passed" else dict(zip(KEYS, state(5), strict=True)))
    with pytest.raises(chasles.InvalidInput, match="observation: has no joint1.pos, joint2.pos"):
        pipeline((action, {"camera": 1}))
    with pytest.raises(chasles.InvalidInput, match="action: grip.pos: is none of the keys"):
        pipeline(({**action, "grip.pos": 1.0}, observation))
    with pytest.raises(chasles.InvalidInput, match="action: has no joint7.pos"):
        pipeline(({key: 0.0 for key in KEYS[:6]}, observation))


def test_the_record_is_in_the_transition(robot, wall):
    step = ActionGateStep(gate(robot, wall), JointMap(robot, robot.variables, scale=DEGREES), KEYS)
    pipeline, seen = robot_pipeline(step), []
    pipeline.register_after_step_hook(lambda _, transition: seen.append(transition[TransitionKey.INFO]))
    pipeline((dict(zip(KEYS, state(60), strict=True)), dict(zip(KEYS, state(), strict=True))))
    assert seen == [{"chasles_gate": step.decision.record()}] and seen[0]["chasles_gate"]["pair"][1] == "wall"


# --- Files, maps and what is refused ---


def test_a_pipeline_from_a_file_takes_its_gate_by_overrides(robot, wall, tmp_path):
    options = {"gate": gate(robot, wall), "joints": JointMap(robot, robot.variables, scale=DEGREES), "present": state}
    policy_pipeline(ChunkGateStep(**options)).save_pretrained(tmp_path, config_filename="gate.json")
    converters = {"to_transition": policy_action_to_transition, "to_output": transition_to_policy_action}
    with pytest.raises(ValueError, match='overrides={"chasles_chunk_gate": {"gate": gate, "joints": joints}}'):
        PolicyProcessorPipeline.from_pretrained(tmp_path, config_filename="gate.json", **converters)
    loaded = PolicyProcessorPipeline.from_pretrained(
        tmp_path, config_filename="gate.json", overrides={"chasles_chunk_gate": options}, **converters
    )
    assert torch.equal(loaded(leaning(5, 60)), leaning(5, 5))


def test_a_map_says_which_number_is_which_variable(robot):
    names = ["joint3", None, "joint1"]
    joints = JointMap(robot, names, scale=[DEGREES, 1, -1], offset=[0, 0, 0.5], others=np.arange(7) / 10)
    assert joints.count == 3
    assert joints.configurations([[90, 7, 0.25], [0, 8, 0]]) == pytest.approx(
        np.array([[0.25, 0.1, math.pi / 2, 0.3, 0.4, 0.5, 0.6], [0.5, 0.1, 0, 0.3, 0.4, 0.5, 0.6]])
    )
    with pytest.raises(chasles.InvalidInput, match=r"actions: the shape is \(2,\); \(..., 3\) is needed"):
        joints.configurations([1, 2])


@pytest.mark.parametrize(
    "names, options, message",
    [
        ("joint1", {}, "variables: 'joint1' is one text"),
        (["elbow"], {}, "variables: elbow: the robot has no such variable; it has joint1, joint2"),
        (["joint1", "joint1"], {}, "variables: joint1: is named twice"),
        ([None], {}, "variables: names no variable"),
        (["joint1"], {"scale": 0}, "scale: is 0"),
        (["joint1"], {"scale": [1, 2]}, "scale: one finite number, or 1 of them"),
        (["joint1"], {"offset": math.nan}, "offset: one finite number"),
        (["joint1"], {"others": [0, 0]}, r"others: the shape is \(2,\); \(7,\) is needed"),
    ],
)
def test_maps_that_say_nothing_are_refused(robot, names, options, message):
    with pytest.raises(chasles.InvalidInput, match="^" + message):
        JointMap(robot, names, **options)


def test_what_a_step_cannot_do_is_refused_by_name(robot):
    joints, other = JointMap(robot, robot.variables), chasles.Robot(links=[{"name": "a"}])
    with pytest.raises(TypeError, match="robot: a str is not a chasles.Robot"):
        JointMap("arm", ["joint1"])
    for arguments, message in (
        ((None, joints, state), "gate: a NoneType is not a chasles.policy.PolicyGate"),
        ((gate(robot), None, state), "joints: a NoneType is not a chasles.lerobot.JointMap"),
        ((gate(other), joints, state), "joints: is the map of another robot"),
        ((gate(robot), joints, None), "present: a function is needed"),
        (
            (gate(robot, mode="scale", full_speed_from=1.0, interpolation="natural_spline"), joints, state),
            'gate: the mode "scale" with another interpolation',
        ),
    ):
        with pytest.raises(chasles.InvalidInput, match="^" + message):
            ChunkGateStep(*arguments)
    step = ChunkGateStep(gate(robot), joints, state)
    for shape, message in (
        ((2, 5, 7), "action: a batch of 2 robots"),
        ((5, 7), "action: a batch of 5 robots"),
        ((1, 5, 6), r"action: the shape is \(1, 5, 6\)"),
        ((1, 0, 7), r"action: the shape is \(1, 0, 7\)"),
    ):
        with pytest.raises(chasles.InvalidInput, match="^" + message):
            policy_pipeline(step)(torch.zeros(shape))
    for value, message in ((np.zeros(3), r"present: the shape is \(3,\)"), (np.full(7, np.nan), "present: .*no numbers")):
        step.present = lambda value=value: value
        with pytest.raises(chasles.InvalidInput, match="^" + message):
            policy_pipeline(step)(torch.zeros(1, 5, 7))
    for keys in (KEYS[:3], "abcdefg", [KEYS[0]] * 7):
        with pytest.raises(chasles.InvalidInput, match="^keys: .*7 different names are needed"):
            ActionGateStep(gate(robot), joints, keys)


def test_the_page_tells_the_truth():
    code = code_of(ROOT / "docs" / "policy.md")
    example = doctest.DocTestParser().get_doctest(code, {}, "docs/policy.md", "docs/policy.md", 0)
    failures: list[str] = []
    doctest.DocTestRunner().run(example, out=failures.append)
    assert not failures and len(example.examples) > 25, "".join(failures)
