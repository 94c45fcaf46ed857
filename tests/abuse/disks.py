"""Full disks, limits of file sizes and places where no file can be: one error line that names the file, and no loss."""

import random
import resource
from collections.abc import Iterable
from pathlib import Path

from cases import Case, Counts, Kind, Outcome
from kills import PRECIOUS
from questions import QUESTIONS, WRITERS, Question
from runs import Ended, changes, contents, limited, run
from setting import Setting, make_folders

PAGE = 4096  # bytes that a file system of memory gives at a time

# Makes a small file system in the folder `disk`, runs the command there, and copies what is left.
ON_DISK = """mount -t tmpfs -o "$1" none disk || exit 99
cp -r former/. disk || exit 98
shift
"$@"
status=$?
mkdir after && cp -r disk/. after
exit $status"""


def cases(counts: Counts) -> Iterable[Case]:
    for name in WRITERS:
        yield from (Case("disks", name, number) for number in range(max(counts.disks, len(WAYS))))


def run_case(setting: Setting, case: Case, folder: Path) -> Outcome:
    way = list(WAYS)[case.number % len(WAYS)]
    outcome = Outcome()
    question = QUESTIONS[case.name]
    setting.copy_world("small", folder)
    WAYS[way](setting, question, case.random(setting.seed), folder, outcome)
    return outcome


def on_full_disk(setting: Setting, question: Question, rng: random.Random, folder: Path, outcome: Outcome) -> None:
    """A disk on which the former outputs fit, and not all of the new ones."""
    if not setting.can_mount:
        outcome.notes["no disk could be made"] += 1
        return
    whole = setting.whole("small", question.name)
    names = {option: "disk/" + name for option, name in question.own_names().items()}
    former = {name.replace("disk", "former", 1): PRECIOUS for name, _ in question.written(names)}
    (folder / "disk").mkdir()
    for name, content in former.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    pages = max(-(-len(content) // PAGE) for content in whole.files.values())
    size = f"size={(len(former) + rng.randrange(pages)) * PAGE}"
    command = question.command(setting.program, "small", names)
    outcome.command = f"({size}) " + " ".join(command)
    ended = run(["unshare", "-rm", "sh", "-c", ON_DISK, "sh", size, *command], folder)
    outcome.notes["full disk"] += 1
    check_failure(outcome, ended, list(names.values()))
    written = {name.replace("disk/", "", 1): output for name, output in question.written(names)}
    after = contents(folder / "after") if (folder / "after").exists() else {}
    for name, output in written.items():
        check_kept(outcome, name, after, whole.files[name], output.has_rows)


def with_small_files(setting: Setting, question: Question, rng: random.Random, folder: Path, outcome: Outcome) -> None:
    """A limit of file sizes below the size of the largest output."""
    whole = setting.whole("small", question.name)
    names = question.own_names()
    make_folders(question, names, folder)
    for name, _ in question.written(names):
        (folder / name).write_bytes(PRECIOUS)
    before = contents(folder)
    most = rng.randrange(max(map(len, whole.files.values())))
    command = question.command(setting.program, "small", names)
    outcome.command = f"(RLIMIT_FSIZE {most}) " + " ".join(command)
    with limited(resource.RLIMIT_FSIZE, most):
        ended = run(command, folder)
    outcome.notes["limit of file sizes"] += 1
    is_about_answer = "standard output" in ended.err.decode("utf-8", "replace")  # a limit of a few bytes
    check_failure(outcome, ended, [] if is_about_answer else list(names.values()))
    after = contents(folder)
    allowed = set()
    for name, output in question.written(names):
        check_kept(outcome, name, after, whole.files[name], output.has_rows)
        allowed |= {name, name + ".part"}
    outcome.expect(set(changes(before, after)) <= allowed, f"changed {changes(before, after)}")


def at_no_place(setting: Setting, question: Question, rng: random.Random, folder: Path, outcome: Outcome) -> None:
    """A name that is no place for a file."""
    (folder / "folder").mkdir()
    (folder / "loop").symlink_to("loop")
    make_folders(question, question.own_names(), folder)
    before = contents(folder)
    for place in ["/dev/full", "folder", "missing/out", "x" * 300, "loop", "moving.obj/out", ""]:
        option = rng.choice(question.outputs).option
        if place == "folder" and option in ("--save", "--bodies", "--certificates"):
            continue  # that is one
        names = {**question.own_names(), option: place}
        command = question.command(setting.program, "small", names)
        outcome.command = " ".join(command)
        ended = run(command, folder)
        check_failure(outcome, ended, [place[:40]] if place else [])
        outcome.notes["no place"] += 1
        others = [name for name in changes(before, contents(folder)) if not name.startswith("out_")]
        outcome.expect(not others, f"changed {others}")


def check_failure(outcome: Outcome, ended: Ended, names: list[str]) -> None:
    """Status 2 and one error line. It names one of the files, if there are any."""
    outcome.expect(not ended.crash, ended.crash)
    outcome.expect(ended.status == 2, f"{outcome.command}: status {ended.status} instead of 2: {ended.lines}")
    outcome.expect(len(ended.errors) == 1, f"{outcome.command}: {len(ended.errors)} error lines: {ended.errors}")
    is_named = not names or any(name in line for name in names for line in ended.errors)
    outcome.expect(is_named, f"{outcome.command}: the error names no file: {ended.errors}")


def check_kept(outcome: Outcome, name: str, after: dict[str, bytes], new: bytes, has_rows: bool) -> None:
    outcome.expect(after.get(name) in (PRECIOUS, new), f"{name} has neither its former content nor its new one")
    part = after.get(name + ".part")
    if has_rows:
        outcome.expect(part is None or new.startswith(part), f"the rows in {name}.part are others")
    else:
        outcome.expect(part is None, f"{name}.part stays")


WAYS = {"full-disk": on_full_disk, "small-files": with_small_files, "no-place": at_no_place}

NEEDS = ("limit of file sizes", "no place")
KIND = Kind("disks", cases, run_case, ("small",), lambda case: [("small", case.name)], needs=NEEDS)
