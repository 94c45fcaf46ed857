"""A validator of `chasles.ros` in a node of rclpy, and another node that sends it trajectories. Run by test_ros_node.py."""

import json
import os
import sys
import time

os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ["ROS_DOMAIN_ID"] = str(os.getpid() % 100)

import rclpy
from rclpy.executors import SingleThreadedExecutor
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

import chasles
import chasles.ros

robot = chasles.Robot.load(sys.argv[1])
assert chasles.ros.main(["--urdf", sys.argv[1], "--topic", "9x"]) == 2
rclpy.init()
node, other = rclpy.create_node("validator"), rclpy.create_node("other")
validator = chasles.ros.Validator(node, robot, forward="safe", seconds=10.0)
answers, passed = [], []
other.create_subscription(String, "joint_trajectory/validation", lambda m: answers.append(json.loads(m.data)), 10)
other.create_subscription(JointTrajectory, "safe", passed.append, 10)
send = other.create_publisher(JointTrajectory, "joint_trajectory", 10)
states = other.create_publisher(JointState, "joint_states", 10)
executor = SingleThreadedExecutor()
executor.add_node(node)
executor.add_node(other)


def wait(condition):
    end = time.monotonic() + 60
    while not condition() and time.monotonic() < end:
        executor.spin_once(timeout_sec=0.05)
    assert condition()


def trajectory(*rows):
    message = JointTrajectory(joint_names=robot.variables)
    for second, row in enumerate(rows, 1):
        point = JointTrajectoryPoint(positions=list(map(float, row)))
        point.time_from_start.sec = second
        message.points.append(point)
    return message


wait(lambda: send.get_subscription_count() and states.get_subscription_count())
wait(lambda: other.count_publishers("safe") and node.count_subscribers("joint_trajectory/validation"))
send.publish(trajectory([0.5, 0.5, 0, 0.01]))
wait(lambda: len(answers) == 1)
assert answers[0]["verdict"] == "error" and "waist" in answers[0]["error"]
states.publish(JointState(name=[*robot.variables, "right"], position=[0.0, 0.0, 0.0, 0.01, 0.01]))
wait(lambda: validator.values)
send.publish(trajectory([0.5, 0.5, 0, 0.01]))
wait(lambda: len(answers) == 2 and passed)
assert answers[1]["verdict"] == "clear" and list(passed[0].points[0].positions) == [0.5, 0.5, 0, 0.01]
send.publish(trajectory([0.5, 0.5, 0, 0.01], [0.5, 2.9, 0, 0.01]))
wait(lambda: len(answers) == 3)
assert answers[2]["verdict"] == "contact" and answers[2]["pair"] == ["right_finger", "post"] and len(passed) == 1
lost = trajectory(*[[0.5, 0.5, 0, 0.01]] * 3)  # only some points have velocities, and the last ones are no numbers
lost.points[1].velocities, lost.points[2].velocities = [0.0] * 4, [float("nan")] * 4
send.publish(lost)
wait(lambda: len(answers) == 4)
assert answers[3]["verdict"] == "error" and "point 2: velocities" in answers[3]["error"]
send.publish(trajectory([0.5, 0.5, 0, 0.01], [0.5, 0.5, 0, 0.06]))
wait(lambda: len(answers) == 5)
assert answers[4]["warnings"] == ["path: left: 0.06 in configuration 1 is beyond the limits [0, 0.04]"]
