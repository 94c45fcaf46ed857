"""Robots of the wheel `example-robot-data`, read by Pinocchio: links, pairs, and coal's collision at random configurations."""

import os

import numpy as np
import pytest
from test_robot_oracles import files_of

import chasles

pin = pytest.importorskip("pinocchio", minversion="4")
import chasles.pinocchio  # noqa: E402

DEVIATION = 0.002
FILES = [file for file in files_of("example-robot-data", ".urdf") if file.is_file()]
FEW = ["panda.urdf", "ur5_robot.urdf", "laikago.urdf", "icub.urdf"]
CHOSEN = [file for file in FILES if "CHASLES_LONG" in os.environ or file.name in FEW]


def models_of(file):
    """None for what Pinocchio does not read, what has one shape, and more than 60."""
    share = next(folder for folder in file.parents if folder.name == "share")
    try:
        model = pin.buildModelFromUrdf(str(file))
        geometry = pin.buildGeomFromUrdf(model, str(file), pin.COLLISION, package_dirs=[str(share), str(file.parents[2])])
    except (ValueError, RuntimeError):
        return None
    geometry.addAllCollisionPairs()
    return (model, geometry) if 2 <= geometry.ngeoms <= 60 and len(geometry.collisionPairs) else None


@pytest.mark.skipif(not FILES, reason="no example-robot-data")
@pytest.mark.parametrize("file", CHOSEN, ids=lambda file: file.name)
def test_a_robot(file):
    models = models_of(file)
    if models is None:
        pytest.skip("not read by Pinocchio, or too few or too many shapes")
    model, geometry = models
    robot = chasles.pinocchio.robot(model, geometry, deviation=DEVIATION)
    checker, data, places = chasles.RobotChecker(robot), model.createData(), geometry.createData()
    items = list(geometry.geometryObjects)
    names = [f"{item.name} (geometry)" if item.name in set(model.names) else item.name for item in items]
    assert len(robot.tested_pairs()) == len(geometry.collisionPairs)
    pin.seed(1)
    lower, upper = np.clip(model.lowerPositionLimit, -2, 2), np.clip(model.upperPositionLimit, -2, 2)
    for _ in range(20):
        q = pin.randomConfiguration(model, lower, upper)
        values = chasles.pinocchio.configurations(model, q)
        pin.updateGeometryPlacements(model, data, geometry, places, q)
        links, ours = robot.link_poses(values), {frozenset(pair) for pair in checker.pairs_in_contact(values)}
        for name, place in [*zip(model.names, data.oMi, strict=True), *zip(names, places.oMg, strict=True)]:
            assert np.abs(links[name] - place.homogeneous).max() < 1e-12, name
        pin.computeCollisions(geometry, places, False)
        for number, pair in enumerate(geometry.collisionPairs):
            is_hit, is_ours = places.collisionResults[number].isCollision(), {names[pair.first], names[pair.second]} in ours
            if is_hit == is_ours:
                continue
            distance = pin.computeDistance(geometry, places, number).min_distance
            if is_hit:  # coal calls meshes within 1e-7 a collision; fingers of Baxter overlap by 1e-12
                assert -1e-9 < distance < 1e-6, (names[pair.first], names[pair.second])
            else:
                off = DEVIATION * sum(items[i].geometry.aabb_radius for i in (pair.first, pair.second))
                assert distance < off or is_inside(robot, names[pair.first], names[pair.second], links)


def is_inside(robot, first, second, links):
    """A closed mesh is solid, and for coal its surface alone."""
    ((one, _, _),), ((other, _, _),) = robot.collisions(first), robot.collisions(second)
    places = {"fixed_start": links[second], "fixed_goal": links[second]}
    return chasles.first_contact(one, other, links[first], links[first], **places).inside is not None
