"""Writes the pages of the Python reference, and the package that they are read from.

The compiled module is not imported. Its type stubs, which the build of the package writes, have every signature and every
docstring. They are valid Python, so a copy of the package with the stubs in the place of the compiled module can be imported.
A public name that belongs to no topic is an error.
"""

import ast
import pathlib
import re
import shutil

TOPICS: dict[str, tuple[str, list[str]]] = {
    "bodies": ("Bodies", ["Polyhedron", "MeshReport", "load", "load_parts", "sphere", "capsule", "points", "load_points", "from_trimesh", "parts_from_trimesh", "InvalidInput"]),
    "motions": (
        "Motions",
        ["ScrewMotion", "SweepMotion", "ConstantVelocity", "ConstantTwist", "Motion", "Spline", "TimedPoses", "Trajectory",
         "relative", "rest_of"],
    ),
    "first-contact": (
        "The first contact",
        ["first_contact", "first_contact_on_path", "verify", "FirstContact", "PathContact", "Verdict", "Find", "Contact", "ContactKind",
         "Overlap", "Work", "PairMemory", "constraint_rows"],
    ),
    "batches": (
        "Batches, tables and limits",
        ["first_contact_batch", "certificate_batch", "least_distance_batch", "path_is_clear_batch", "BatchInterrupted", "empty_table",
         "motion_dtype", "path_dtype", "least_dtype", "Limit", "Cancelled"],
    ),
    "least-distance": (
        "The least distance, and the distance over time",
        ["least_distance", "LeastDistance", "profile", "DistanceProfile"],
    ),
    "scenes": ("Scenes", ["Scene", "SceneContact", "DistanceMatrix", "UntestedPairs", "Stepper", "StepEvent", "CollisionManager"]),
    "dragged-bodies": ("Dragged bodies", ["DraggedBody", "DragStep", "DragContact", "DragEvent", "DragLock", "MassProperties"]),
    "robots": (
        "Robots",
        ["Robot", "JointPath", "RobotContact", "RobotClearance", "RobotChecker", "PairProof", "RobotRange", "ClearBox", "first_contacts_on_edges",
         "edge_dtype"],
    ),
    "pages": ("Pages", ["view", "recording_page", "write_robot_page"]),
}  # fmt: skip

# Modules that are imported by their names, because they need further packages.
MODULES = {
    "distributed": ("Dask and Parquet", "chasles.distributed"),
    "drake": ("Plants and trajectories of Drake", "chasles.drake"),
    "pinocchio": ("Models of Pinocchio", "chasles.pinocchio"),
    "ros": ("Trajectories of ROS", "chasles.ros"),
    "gltf": ("Animations of glTF", "chasles.gltf"),
    "cad": ("Assemblies of CAD", "chasles.cad"),
    "mujoco": ("Models and recordings of MuJoCo", "chasles.mujoco"),
    "ompl": ("Planners of OMPL", "chasles.ompl"),
    "policy": ("A gate for policies", "chasles.policy"),
    "lerobot": ("Steps for LeRobot", "chasles.lerobot"),
}


def make_package(root: pathlib.Path, stubs: pathlib.Path, out: pathlib.Path) -> None:
    """A copy of the package that can be imported without the compiled module."""
    package = out / "chasles"
    shutil.rmtree(package, ignore_errors=True)
    shutil.copytree(root / "python" / "chasles", package, ignore=shutil.ignore_patterns("__pycache__", "*.so"))
    core = stubs.read_text(encoding="utf-8").replace("numpy.typing.NDArray", "NDArray")
    (package / "_core.py").write_text(core + "\n__version__ = ''\n", encoding="utf-8")
    for module in package.glob("*.py"):
        module.write_text(with_texts_for_annotations(module.read_text(encoding="utf-8")), encoding="utf-8")


def with_texts_for_annotations(module: str) -> str:
    """Annotations are not evaluated, since what they name may be missing here, and an ArrayLike is shown as one word."""
    docstring = ast.parse(module).body[0]
    lines = module.splitlines(keepends=True)
    is_docstring = isinstance(docstring, ast.Expr) and isinstance(docstring.value, ast.Constant)
    lines.insert((docstring.end_lineno or 0) if is_docstring else 0, "from __future__ import annotations\n")
    return re.sub(r"\b(?:numpy\.typing|npt)\.ArrayLike\b", "ArrayLike", "".join(lines))


def public_names(root: pathlib.Path) -> list[str]:
    tree = ast.parse((root / "python" / "chasles" / "__init__.py").read_text(encoding="utf-8"))
    for node in tree.body:
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__":
            return [name for name in ast.literal_eval(node.value) if name != "__version__"]
    raise SystemExit("site/reference_python.py: python/chasles/__init__.py has no __all__")


def directive(name: str) -> str:
    if name.endswith("_dtype"):
        return f".. autodata:: chasles.{name}"
    if not name[0].isupper():
        return f".. autofunction:: chasles.{name}"
    return f".. autoclass:: chasles.{name}\n   :members:\n   :undoc-members:\n   :member-order: bysource"


def section(name: str) -> str:
    return f"## {name}\n\n```{{eval-rst}}\n{directive(name)}\n```\n"


def write(root: pathlib.Path, out: pathlib.Path) -> None:
    known = [name for _, names in TOPICS.values() for name in names]
    missing = sorted(set(public_names(root)) - set(known))
    if missing:
        raise SystemExit(f"site/reference_python.py: no topic has {', '.join(missing)}")
    out.mkdir(parents=True, exist_ok=True)
    for file, (title, names) in TOPICS.items():
        text = f"# {title}\n\n" + "\n".join(map(section, names))
        (out / f"{file}.md").write_text(text, encoding="utf-8")
    for file, (title, module) in MODULES.items():
        text = f"# {title}\n\n```{{eval-rst}}\n.. automodule:: {module}\n   :members:\n   :member-order: bysource\n```\n"
        (out / f"{file}.md").write_text(text, encoding="utf-8")
