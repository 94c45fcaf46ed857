"""Damaged files of each format: an answer or one error line, in bounded time and memory, and never a crash."""

from collections.abc import Iterable
from functools import cache
from pathlib import Path

from cases import Case, Counts, Kind, Outcome
from formats import NAMES, Format, all_formats
from runs import Ended, run
from setting import Setting

LONGEST = 10.0  # seconds, also where other programs take their share
MOST_MEMORY = 1024  # MiB
OUT_OF_TIME = 3  # status of a run with `--seconds`


def cases(counts: Counts) -> Iterable[Case]:
    return (Case("damage", name, number) for name in NAMES for number in range(counts.damaged))


@cache
def formats_of(rows: bytes) -> dict[str, Format]:
    return all_formats(rows)


def run_case(setting: Setting, case: Case, folder: Path) -> Outcome:
    rows = setting.whole("small", "batch").files["out__out"]
    form = formats_of(rows)[case.name]
    rng = case.random(setting.seed)
    question, whole, other = rng.choice(form.questions), rng.choice(form.wholes), rng.choice(form.wholes)
    # The first cases are whole files: all of them are answered.
    is_whole = case.number < len(form.wholes)
    content = form.wholes[case.number] if is_whole else form.damage(rng, whole, other)
    write_files(setting, form, content, folder)
    arguments = [{"FILE": form.file, "NEW": "new"}.get(word, word) for word in question]
    outcome = Outcome(command=" ".join([setting.program, *arguments]))
    ended = run([setting.program, *arguments], folder)
    outcome.slowest = min(ended.seconds, ended.cpu_seconds)
    check_end(outcome, ended, form.file, form.of_options)
    if is_whole:
        outcome.expect(ended.status in (0, 1, 2), f"a whole file: status {ended.status}, {ended.lines}")
    outcome.notes["refused" if ended.status == 2 else "answered"] += 1
    # a goal that is refused leaves the rows before it
    has_rows = question[0] == "drag" and ended.status == 2
    left = [path.name for path in folder.glob("*.part") if path.name != form.file and not has_rows]
    outcome.expect(not left, f"{left} stays")
    if form.name != "rows":
        outcome.expect((folder / form.file).read_bytes() == content, "the damaged file has changed")
    return outcome


def write_files(setting: Setting, form: Format, content: bytes, folder: Path) -> None:
    for name in form.inputs:
        (folder / name).symlink_to(setting.worlds / "small" / name)
    for name, text in {**form.companions, form.file: content}.items():
        (folder / name).write_bytes(text)


def check_end(outcome: Outcome, ended: Ended, name: str, of_options: tuple[str, ...]) -> None:
    outcome.expect(not ended.crash, ended.crash)
    outcome.expect(outcome.slowest <= LONGEST, f"took {outcome.slowest:.1f} seconds")
    outcome.expect(ended.memory <= MOST_MEMORY, f"took {ended.memory} MiB of memory")
    if ended.crash:
        return
    if ended.status == 2:
        error = ended.errors[0] if len(ended.errors) == 1 else ""
        is_named = error.startswith("chasles: ") and any(part in error for part in (name, *of_options))
        outcome.expect(is_named, f"no single error line that names {name}: {ended.errors}")
    else:
        expected = (0, 1, OUT_OF_TIME) if "--seconds" in outcome.command else (0, 1)
        outcome.expect(ended.status in expected, f"status {ended.status}")
        outcome.expect(not ended.errors, f"an answer with error lines: {ended.errors}")


KIND = Kind("damage", cases, run_case, ("small",), lambda case: [("small", "batch")], needs=("refused", "answered"))
