"""The commands: what each reads and writes."""

from collections.abc import Iterator
from dataclasses import dataclass

from inputs import MOTION


@dataclass(frozen=True)
class Output:
    option: str
    files: tuple[str, ...]  # what is written, below what the option names
    has_rows: bool = False  # rows of a run that was cut stay in FILE.part


def file(option: str, has_rows: bool = False) -> Output:
    return Output(option, ("",), has_rows)


def bodies(count: int) -> Output:
    return Output("--bodies", tuple(f"/body-{i}.obj" for i in range(count)))


@dataclass(frozen=True)
class Question:
    name: str
    arguments: tuple[str, ...]  # `MOTION` stands for the motion of the world
    reads: tuple[str, ...]
    outputs: tuple[Output, ...] = ()
    can_resume: bool = False

    def command(self, program: str, world: str, names: dict[str, str]) -> list[str]:
        """`names` gives the outputs their names, by option."""
        words = [program]
        for argument in self.arguments:
            words += MOTION[world] if argument == "MOTION" else [argument]
        return words + [word for pair in names.items() for word in pair]

    def own_names(self) -> dict[str, str]:
        """A name for each output."""
        return {output.option: "out" + output.option.replace("-", "_") for output in self.outputs}

    def written(self, names: dict[str, str]) -> Iterator[tuple[str, Output]]:
        """The files that outputs of these names are."""
        for output in self.outputs:
            for end in output.files:
                yield names[output.option] + end, output


BODIES = ("moving.obj", "fixed.stl")
ROBOT = ("arm.urdf", "--srdf", "arm.srdf", "--packages", "parts=packages/parts")
ROBOT_FILES = ("arm.urdf", "arm.srdf", "in_robot.dae", "packages/parts/meshes/in_package.off")
TWO_ROBOTS = (
    *("left=arm.urdf", "right=arm.urdf", "--srdf", "left=arm.srdf"),
    *("--packages", "parts=packages/parts", "--base", "right=9,0,0"),
)
CELL = ("--path", "path.csv", "--scene", "cell.json")
CELL_FILES = ("path.csv", "cell.json", "fixed.stl", "fixture.urdf", "fixture.3mf")
PART = ("part.gltf", "part.bin")

QUESTIONS = {
    question.name: question
    for question in [
        Question("check", ("check", *BODIES, "MOTION", "--json"), BODIES),
        Question(
            "certificate",
            ("check", *BODIES, "--start", "3,0.2,0.3", "--goal", "0,0.2,3"),
            BODIES,
            (file("--certificate"), bodies(2)),
        ),
        Question("verify", ("verify", *BODIES, "proof.txt"), (*BODIES, "proof.txt")),
        Question("clearance", ("clearance", *BODIES, "MOTION"), BODIES),
        Question("profile", ("profile", *BODIES, "MOTION"), BODIES, (file("--csv"), file("--plot"))),
        Question("view", ("view", *BODIES, "MOTION"), BODIES, (file("--out"),)),
        Question(
            "path",
            ("path", *BODIES, "--poses", "poses.csv", "--motion", "velocity"),
            (*BODIES, "poses.csv"),
            (file("--certificate"), bodies(2)),
        ),
        Question(
            "scene-certificate",
            ("scene", "alike.json"),
            ("alike.json", "moving.obj"),
            (file("--certificate"), bodies(1)),
        ),
        Question(
            "robot-certificate",
            ("robot", "post.urdf", "--scene", "alike.json", "--margin", "0.001"),
            ("post.urdf", "alike.json", "moving.obj"),
            (file("--certificate"), bodies(1)),
        ),
        Question(
            "batch",
            ("batch", *BODIES, "--motions", "motions.csv", "--motion", "velocity"),
            (*BODIES, "motions.csv"),
            (file("--out", has_rows=True),),
            can_resume=True,
        ),
        Question(
            "batch-certificate",
            ("batch", *BODIES, "--motions", "motion.csv", "--motion", "velocity"),
            (*BODIES, "motion.csv"),
            (file("--out", has_rows=True), Output("--certificates", ("/1.cert",))),
            can_resume=True,
        ),
        Question(
            "scene",
            ("scene", "scene.json", "--all"),
            ("scene.json", *BODIES, *PART, "fixture.urdf", "fixture.3mf"),
            (file("--page"),),
        ),
        Question(
            "scene-profile",
            ("scene", "scene.json", "--profile", "--tolerance", "1", "--absolute-tolerance", "0.1"),
            ("scene.json", *BODIES, *PART, "fixture.urdf", "fixture.3mf"),
            (file("--csv"), file("--plot")),
        ),
        Question(
            "scene-matrix",
            ("scene", "scene.json", "--matrix"),
            ("scene.json", *BODIES, *PART, "fixture.urdf", "fixture.3mf"),
            (file("--csv"), file("--plot"), file("--page")),
        ),
        Question(
            "drag",
            ("drag", "rest.json", "--body", "box", "--goals", "goals.csv"),
            ("rest.json", *BODIES, *PART, "goals.csv"),
            (file("--out", has_rows=True), file("--page")),
        ),
        Question(
            "robot",
            ("robot", *ROBOT, *CELL, "--attach", "base,attached.ply,0 9 0"),
            (*ROBOT_FILES, *CELL_FILES, "attached.ply"),
            (file("--page"),),
        ),
        Question(
            "robot-cell",
            ("robot", *TWO_ROBOTS, "--path", "left=path.csv", "--path", "right=path.csv"),
            (*ROBOT_FILES, "path.csv"),
            (file("--page"),),
        ),
        Question("robot-clearance", ("robot", *ROBOT, *CELL, "--clearance"), (*ROBOT_FILES, *CELL_FILES)),
        Question(
            "robot-profile",
            ("robot", *ROBOT, *CELL, "--profile"),
            (*ROBOT_FILES, *CELL_FILES),
            (file("--csv"), file("--plot")),
        ),
        Question(
            "range",
            ("range", *ROBOT, "--joints", "joint0,joint1", "--from", "path.csv", "1", "--scene", "cell.json"),
            (*ROBOT_FILES, *CELL_FILES),
            (file("--plot"),),
        ),
        Question(
            "range-cell",
            ("range", *TWO_ROBOTS, "--joints", "left/joint0=-1:1,right/joint0"),
            ROBOT_FILES,
            (file("--plot"),),
        ),
        Question("acm", ("acm", *ROBOT), ROBOT_FILES, (file("--out"),)),
        Question("acm-cell", ("acm", *TWO_ROBOTS), ROBOT_FILES),
        Question("info", ("info", "moving.obj"), ("moving.obj",)),
        Question("info-robot", ("info", *ROBOT, "--json"), ROBOT_FILES),
        Question("demo", ("demo",), (), (Output("--save", ("/bolt.obj", "/nut.obj")),)),
    ]
}

# Options that name files to read. All other options that name a file or a folder are outputs.
INPUT_OPTIONS = {"--poses", "--motions", "--goals", "--path", "--scene", "--from", "--srdf", "--packages", "--attach"}

WRITERS = [question.name for question in QUESTIONS.values() if question.outputs]
