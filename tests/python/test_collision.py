"""CollisionManager: closed forms, the answers of trimesh with python-fcl where they are installed, and wrong arguments."""

import math
import pickle
import time

import numpy as np
import pytest
from cubes import CUBE_FACES, CUBE_VERTICES, matrix, pose

import chasles


def cube_of(size, centre=(0, 0, 0)):
    return chasles.Polyhedron((CUBE_VERTICES - 0.5) * size + centre, CUBE_FACES)


@pytest.fixture
def manager(cube):
    """Unit cubes: a and b share a corner region, c is 2 away from b along x, d is far."""
    manager = chasles.CollisionManager()
    manager.add_object("a", cube)
    manager.add_object("b", cube, matrix(0.5, 0.5, 0.5))
    manager.add_object("c", cube, pose(3.5, 0.5, 0.5))
    manager.add_object("d", cube, matrix(0, 0, 40))
    return manager


def test_pairs_that_touch_are_named(manager, cube):
    assert manager.in_collision_internal() is True
    assert manager.in_collision_internal(return_names=True) == (True, {("a", "b")})
    touches, names, data = manager.in_collision_internal(return_names=True, return_data=True)
    assert touches and names == {("a", "b")} and data[0].names == {"a", "b"}
    manager.remove_object("b")
    assert manager.in_collision_internal(True, True) == (False, set(), [])
    assert manager.in_collision_single(cube, matrix(0.5, 0, 0), return_names=True) == (True, {"a"})
    assert manager.in_collision_single(cube, matrix(9, 0, 0), return_names=True, return_data=True) == (False, set(), [])
    assert manager.in_collision_single(cube) is True and manager.in_collision_single(cube, matrix(9, 0, 0)) is False
    assert manager.in_collision_internal() is False  # the given objects have left no trace


def test_contacts_have_points_normals_and_faces(manager, cube):
    manager.set_transform("b", matrix(1, 0.25, 0.25))  # on the face x = 1 of a
    contacts = manager.in_collision_internal(return_data=True)[1]
    assert contacts
    for contact in contacts:
        assert contact.point[0] == pytest.approx(1) and abs(contact.normal[0]) == pytest.approx(1)
        for name in "ab":  # the face has the point, as seen in its own frame
            outline = cube.vertices[list(cube.faces[contact.index(name)])]
            own = contact.point - (0 if name == "a" else np.array([1, 0.25, 0.25]))
            sides = outline - outline[0]
            assert np.linalg.det([sides[1], sides[2], own - outline[0]]) == pytest.approx(0, abs=1e-12)
        with pytest.raises(chasles.InvalidInput, match="c: is none of the two objects a and b"):
            contact.index("c")
        assert not hasattr(contact, "depth")
        with pytest.raises(AttributeError, match="measures no penetration"):
            _ = contact.depth


def test_surfaces_that_cross_have_a_point_of_both(manager, cube):
    (contact,) = manager.in_collision_internal(return_data=True)[1]
    for corner in (np.zeros(3), np.full(3, 0.5)):
        own = contact.point - corner
        assert (own >= -1e-12).all() and (own <= 1 + 1e-12).all()  # on the cube
        assert np.abs(own - np.round(own)).min() < 1e-12  # and on its surface
    assert np.abs(contact.normal).max() == 1 and {contact.index("a"), contact.index("b")} <= set(range(6))


def test_distances_between_cubes(manager, cube):
    manager.remove_object("a")
    distance, names, data = manager.min_distance_internal(return_names=True, return_data=True)
    assert distance == pytest.approx(2, abs=1e-12) and names == ("b", "c") and data.names == {"b", "c"}
    assert data.lower <= 2 <= data.distance + 1e-12 and data.distance - data.lower < 1e-9
    assert data.point("b")[0] == pytest.approx(1.5) and data.point("c")[0] == pytest.approx(3.5)
    assert cube.faces[data.index("b")] and cube.faces[data.index("c")]
    assert manager.min_distance_internal("d", return_names=True)[1] == ("b", "d")
    assert manager.min_distance_internal("d") == pytest.approx(38.5)
    distance, name, data = manager.min_distance_single(cube, matrix(0.5, 0.5, -3), True, True)
    assert distance == pytest.approx(2.5) and name == "b" and data.point("__external")[2] == pytest.approx(-2)
    manager.set_transform("c", matrix(1, 1, 1))
    distance, data = manager.min_distance_internal(return_data=True)
    assert distance == data.distance == data.lower == 0
    np.testing.assert_allclose(data.point("b"), data.point("c"), atol=1e-12)


def test_closed_objects_are_solid():
    manager = chasles.CollisionManager()
    manager.add_object("block", cube_of(10))
    assert manager.in_collision_single(cube_of(1)) is True
    assert manager.min_distance_single(cube_of(1), pose(1, 0, 0)) == 0
    room = cube_of(10)
    manager = chasles.CollisionManager()
    manager.add_object("room", chasles.Polyhedron(room.vertices, room.faces, solid="no"))
    assert manager.in_collision_single(cube_of(1)) is False
    assert manager.min_distance_single(cube_of(1), pose(1, 0, 0)) == pytest.approx(3.5)


def test_two_managers(manager, cube):
    other = chasles.CollisionManager()
    other.add_object("a", cube, matrix(0.9, 0, 0))  # a name of both
    other.add_object("e", cube, matrix(3, 3, 3))
    touches, names, data = manager.in_collision_other(other, return_names=True, return_data=True)
    assert touches and names == {("a", "a"), ("b", "a")}
    assert {frozenset(contact.names) for contact in data} == {frozenset("a"), frozenset("ab")}
    assert other.in_collision_other(manager, return_names=True)[1] == {("a", "a"), ("a", "b")}
    other.remove_object("a")
    assert manager.in_collision_other(other) is False
    distance, names, data = manager.min_distance_other(other, return_names=True, return_data=True)
    assert distance == pytest.approx(math.hypot(1.5, 1.5)) and names == ("c", "e")
    assert data.point("e")[1:] == pytest.approx([3, 3]) and data.point("c")[1:] == pytest.approx([1.5, 1.5])
    assert other.min_distance_other(manager, return_names=True)[1] == ("e", "c")


def test_an_empty_manager_and_one_object(cube):
    empty, one = chasles.CollisionManager(), chasles.CollisionManager()
    one.add_object("a", cube)
    for manager in (empty, one):
        assert manager.in_collision_internal(True, True) == (False, set(), [])
        assert manager.min_distance_internal(return_names=True, return_data=True) == (math.inf, None, None)
    assert one.min_distance_internal("a") == math.inf
    assert empty.in_collision_single(cube, return_names=True) == (False, set())
    assert empty.min_distance_single(cube, return_name=True, return_data=True) == (math.inf, None, None)
    assert empty.in_collision_other(one) is False and one.min_distance_other(empty) == math.inf
    assert one.in_collision_other(one, return_names=True) == (True, {("a", "a")})
    assert one.min_distance_other(one) == 0
    assert empty.first_contact({}).verdict == "clear"


def test_the_first_contact_on_the_way(manager):
    manager.remove_object("b")
    found = manager.first_contact({"c": matrix(-1.5, 0.5, 0.5)})
    assert found.pair == ("c", "a") and found.time == pytest.approx(0.5, abs=1e-12) and found.certain
    near = manager.first_contact({"c": matrix(-1.5, 0.5, 0.5)}, margin=0.5)
    assert near.time == pytest.approx(0.4, abs=1e-12)
    assert manager.first_contact({"c": matrix(-1.5, 0.5, 0.5), "a": matrix(-5, 0, 0)}).verdict == "clear"
    assert manager.first_contact({"c": matrix(-1.5, 0.5, 0.5)}, motion="twist").pair == ("c", "a")
    assert manager.in_collision_internal() is False  # nothing has moved


def test_an_object_with_a_name_that_is_taken_is_replaced(manager, cube):
    manager.add_object("d", cube_of(0.1), matrix(0, 0, 0.5))
    assert manager.in_collision_internal(return_names=True)[1] == {("a", "b"), ("a", "d")}
    assert "4 objects" in repr(manager)
    with pytest.raises(chasles.InvalidInput):
        manager.add_object("d", cube, np.zeros((4, 4)))
    assert manager.in_collision_internal(return_names=True)[1] == {("a", "b"), ("a", "d")}


def test_objects_beyond_the_largest_distance_are_refused(cube):
    manager = chasles.CollisionManager()
    manager.add_object("a", cube, pose(1e30, 1e30, 0))
    manager.add_object("b", cube, pose(-1e30, 0, 0))
    assert manager.in_collision_internal() is False
    with pytest.raises(chasles.InvalidInput, match="distance: all objects are farther apart than 1e.30"):
        manager.min_distance_internal()


def test_managers_are_copied_and_pickled(manager, cube):
    again = pickle.loads(pickle.dumps(manager))
    again.remove_object("b")
    assert again.in_collision_internal() is False and manager.in_collision_internal() is True


def test_transforms_are_copied(manager, cube):
    place = matrix(9, 9, 9)
    manager.add_object("e", cube, place)
    place[:3, 3] = 0
    assert manager.in_collision_internal(return_names=True)[1] == {("a", "b")}
    assert manager.min_distance_internal("e") == pytest.approx(math.hypot(4.5, 7.5, 7.5))


def test_wrong_arguments_are_refused(manager, cube):
    for call, error, message in [
        (lambda: manager.add_object("", cube), chasles.InvalidInput, "name: '': must be a printable text"),
        (lambda: manager.add_object("\udcff", cube), chasles.InvalidInput, "name: '\\udcff': must be a printable text"),
        (lambda: manager.add_object(3, cube), chasles.InvalidInput, "name: 3: must be a printable text"),
        (lambda: manager.add_object("__external", cube), chasles.InvalidInput, "name: '__external'"),
        (lambda: manager.add_object("e", None), chasles.InvalidInput, "mesh: a NoneType has no vertices"),
        (lambda: manager.add_object("e", cube, np.eye(3)), chasles.InvalidInput, "transform: "),
        (lambda: manager.add_object("e", cube, "here"), chasles.InvalidInput, "transform: "),
        (lambda: manager.add_object("e", cube, matrix(math.nan, 0, 0)), chasles.InvalidInput, "transform: "),
        (lambda: manager.remove_object("e"), chasles.InvalidInput, "e not in collision manager"),
        (lambda: manager.remove_object(None), chasles.InvalidInput, "None not in collision manager"),
        (lambda: manager.set_transform("e", np.eye(4)), chasles.InvalidInput, "e not in collision manager"),
        (lambda: manager.set_transform("a", None), chasles.InvalidInput, "transform: "),
        (lambda: manager.min_distance_internal("e"), chasles.InvalidInput, "e not in collision manager"),
        (lambda: manager.in_collision_other(None), TypeError, "other_manager: a NoneType is not"),
        (lambda: manager.min_distance_other(manager._scene), TypeError, "other_manager: a Scene is not"),
        (lambda: manager.first_contact({"e": np.eye(4)}), chasles.InvalidInput, "e not in collision manager"),
        (lambda: manager.first_contact({"a": np.ones((4, 4))}), chasles.InvalidInput, "goals['a']: "),
        (lambda: manager.first_contact(["a"]), chasles.InvalidInput, "goals: a list is not a dict"),
        (lambda: manager.first_contact({}, motion="screw"), chasles.InvalidInput, "motion: "),
        (lambda: manager.first_contact({}, margin=-1), chasles.InvalidInput, "query: margin"),
    ]:
        with pytest.raises(error) as caught:
            call()
        assert str(caught.value).startswith(message), caught.value
    assert manager.in_collision_internal(return_names=True) == (True, {("a", "b")})


def random_rotation(random):
    axes = np.linalg.qr(random.normal(size=(3, 3)))[0]
    return axes * np.sign(np.linalg.det(axes))


def random_placements(random, count, size):
    placed = np.tile(np.eye(4), (count, 1, 1))
    for place in placed:
        place[:3, :3] = random_rotation(random)
        place[:3, 3] = np.float32(random.uniform(-size, size, 3))
    return placed


@pytest.mark.parametrize("seed", range(4))
def test_the_answers_are_those_of_trimesh(seed):
    trimesh = pytest.importorskip("trimesh")
    pytest.importorskip("fcl")

    class OfTriangles(trimesh.collision.CollisionManager):
        """Compares triangles, as we do: trimesh takes closed convex meshes as solids."""

        def _get_fcl_obj(self, mesh):
            return trimesh.collision.mesh_to_BVH(mesh)

    random = np.random.default_rng(seed)
    meshes = [trimesh.creation.annulus(0.3, 0.6, 0.3), bracket(trimesh), trimesh.creation.icosphere(1, 0.4)]
    ours = [chasles.CollisionManager() for _ in range(2)]
    theirs = [OfTriangles() for _ in range(2)]
    for manager, other, count in zip(ours, theirs, (60, 20)):
        for i, place in enumerate(random_placements(random, count, 3)):
            manager.add_object(f"o{i}", meshes[i % 3], place)
            other.add_object(f"o{i}", meshes[i % 3], place)
    found, expected = (m.in_collision_internal(return_names=True) for m in (ours[0], theirs[0]))
    assert found == expected and 5 < len(found[1]) < 200
    found, expected = (a.in_collision_other(b, return_names=True) for a, b in (ours, theirs))
    assert found == expected and 5 < len(found[1]) < 200
    touching = 0
    for i, place in enumerate(random_placements(random, 60, 4)):
        arguments = meshes[i % 3], place
        names = ours[0].in_collision_single(*arguments, return_names=True)
        assert names == theirs[0].in_collision_single(*arguments, return_names=True)
        distance, name = ours[0].min_distance_single(*arguments, return_name=True)
        expected, nearest = theirs[0].min_distance_single(*arguments, return_name=True)
        touching += names[0]
        if names[0]:
            assert distance == 0 and expected <= 0
        else:
            assert distance == pytest.approx(expected, abs=1e-5) and name == nearest
    assert 5 < touching < 50, touching


def bracket(trimesh):
    """Two boxes as one mesh."""
    upright = trimesh.creation.box((0.2, 0.3, 1))
    foot = trimesh.creation.box((0.8, 0.3, 0.2))
    foot.apply_translation((0.5, 0, -0.4))
    return trimesh.util.concatenate([upright, foot])


def test_the_nearest_of_many_is_that_of_all_pairs(cube):
    """The pairs that a Scene finds within a bound hold the nearest one: all pairs are asked one by one."""
    for seed in range(5):
        random = np.random.default_rng(seed)
        placed = random_placements(random, 14, 4)
        manager, other = chasles.CollisionManager(), chasles.CollisionManager()
        for i, place in enumerate(placed):
            (manager if i < 9 else other).add_object(f"o{i}", cube, place)

        def distance(i, k):
            motion = chasles.relative(chasles.Motion.at_rest(placed[i]), chasles.Motion.at_rest(placed[k]))
            return chasles.least_distance(cube, cube, motion=motion).distance_upper

        within = min(distance(i, k) for i in range(9) for k in range(i))
        between = min(distance(i, k) for i in range(9) for k in range(9, 14))
        assert manager.min_distance_internal() == pytest.approx(within, abs=1e-9)
        assert manager.min_distance_other(other) == pytest.approx(between, abs=1e-9)


def test_two_hundred_objects_take_no_time_for_all_pairs(cube):
    """Four times as many objects at the same density take far less than sixteen times as long."""

    def seconds(count):
        random = np.random.default_rng(5)
        manager = chasles.CollisionManager()
        for i, place in enumerate(random_placements(random, count, 2.2 * count ** (1 / 3))):
            manager.add_object(str(i), cube, place)
        times = []
        for _ in range(3):
            begin = time.perf_counter()
            names = manager.in_collision_internal(return_names=True)[1]
            manager.min_distance_internal()
            times.append(time.perf_counter() - begin)
        assert 0 < len(names) < count
        return min(times)

    assert seconds(800) < 10 * seconds(200)
