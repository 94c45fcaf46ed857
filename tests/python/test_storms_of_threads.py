"""Threads that change and ask the same objects: without the refusals these programs crash within a second."""

import subprocess
import sys

import pytest

HEAD = """
import sys, threading, time
sys.path.insert(0, {tests!r})
import numpy as np
import chasles
from cubes import CUBE_FACES, CUBE_VERTICES, pose

cube = chasles.Polyhedron(CUBE_VERTICES, CUBE_FACES)
end, seen = time.monotonic() + 2, set()

def repeat(*calls):
    while time.monotonic() < end:
        for call in calls:
            try:
                call()
                seen.add(("done", call.__name__))
            except chasles.InvalidInput as error:
                seen.add(str(error).split(",")[0])
            time.sleep(0.001)

def run(*threads):
    threads = [threading.Thread(target=repeat, args=calls) for calls in threads]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
"""

STORMS = {
    "scene": """
scene = chasles.Scene()
for i in range(40):
    scene.add(f"b{i}", cube, pose(2 * i, 0, 0), pose(2 * i, 1, 0, 1, 0.1 * i, 0, 0))
def add(): scene.add("new", cube, pose(0, 5, 0))
def remove(): scene.remove("new")
def move(): scene.move("b3", pose(6, 0, 0), pose(7, 0, 0))
def ignore(): scene.ignore("b1", "b2")
run([scene.first_contact, scene.clear_until], [scene.all_contacts], [add, remove], [move, ignore], [scene.ignore_touching_at_start])
""",
    "hand": """
scene = chasles.Scene()
scene.add("floor", cube)
scene.add("box", cube, pose(0, 0, 2))
scene.add("other", cube, pose(5, 0, 0), pose(6, 0, 0))
hand = chasles.DraggedBody(scene, "box", margin=1e-3)
def down(): hand.update(pose(0.2, 0, -1))
def up(): hand.follow([pose(0, 0, 2), pose(0, 0.3, 2)])
def move(): scene.move("other", pose(5, 1, 0))
def force(): hand.force(pose(0, 0, 0))
def where(): hand.pose
run([down, up], [down], [scene.first_contact], [move], [force, where])
""",
    "manager": """
manager = chasles.CollisionManager()
for i in range(40):
    manager.add_object(f"b{i}", cube, pose(2 * i, 0, 0))
def add(): manager.add_object("new", cube, pose(0, 5, 0))
def remove(): manager.remove_object("new")
def single(): manager.in_collision_single(cube, return_names=True, return_data=True)
def nearest(): manager.min_distance_single(cube, return_name=True, return_data=True)
def inside(): manager.min_distance_internal(return_names=True, return_data=True)
def other(): manager.in_collision_other(manager)
run([single, nearest], [single, inside], [add, remove], [other], [add])
""",
    "stepper": """
scene = chasles.Scene()
for i in range(40):
    scene.add(f"b{i}", cube, pose(2 * i, 0, 0), pose(2 * i, 1, 0, 1, 0.1 * i, 0, 0))
stepper = chasles.Stepper(scene, margin=1e-3)
def move(): stepper.move("b0", pose(0, 0.1, 0))
def again():
    global stepper
    stepper = chasles.Stepper(scene, margin=1e-3)
def advance(): stepper.advance()
def poses(): stepper.poses()
run([advance], [advance], [move], [poses], [again])
""",
}


@pytest.mark.parametrize("storm", STORMS)
def test_many_threads_crash_nothing(storm, request):
    program = HEAD.format(tests=str(request.path.parent)) + STORMS[storm] + "\nprint(sorted(map(str, seen)))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=100)
    assert (done.returncode, done.stderr) == (0, "")
    assert "still running" in done.stdout and "done" in done.stdout, "the threads have to meet"
