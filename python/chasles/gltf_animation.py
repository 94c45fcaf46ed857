"""The bodies of an animation of glTF and the questions about it, for `chasles.gltf`."""

from __future__ import annotations

import os
import pathlib
from collections.abc import Iterable
from itertools import combinations
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import InvalidInput, Motion, Polyhedron, Scene, SceneContact, rest_of
from .enums import Find, Verdict
from .gltf_answer import AnimationContact, Untested, outward, timed_contacts, work_of
from .gltf_page import write_page
from .gltf_tracks import KINDS, Tracks
from .gltf_tree import STATIC, Carrier, Tree

Array = npt.NDArray[np.float64]
Pair = tuple[str, str]

OVERLAP = 2.0**-50  # part of the duration by which intervals between jumps are longer: more than their roundings


class Animation:
    """The bodies of a file and their motions. Made by `read`.

    Each node with faces is a body, named as `chasles.load_parts` names it. It moves with the nearest node above it that moves, or
    stands still. Bodies that move with one node stand still against each other, and are not tested against each other.
    """

    def __init__(
        self,
        path: pathlib.Path,
        files: set[pathlib.Path],
        chosen: dict[int, str],
        tracks: Tracks,
        tree: Tree,
        carriers: list[Carrier],
        bodies: dict[str, Polyhedron],
    ):
        self._tracks, self._tree, self._carriers, self._chosen = tracks, tree, carriers, chosen
        self.path, self.files = path, files  #: `files` are all that were read
        self.bodies = {carrier.name: bodies[carrier.name] for carrier in carriers}  #: in the frames of `poses`
        self.duration = tracks.duration  #: seconds, to the last key
        self.animations = list(chosen.values())  #: names
        movers = sorted({carrier.mover for carrier in carriers} - {STATIC})
        self._movers, self._mover = movers, {carrier.name: carrier.mover for carrier in carriers}
        self._jumps_of = {mover: tree.jumps(mover) for mover in movers}
        jumps = set().union(*self._jumps_of.values())
        #: times at which keys of STEP move a body at once, in seconds
        self.jumps = np.array(sorted(jumps), np.float64)
        self._motions: dict[tuple[int, int], Motion] = {}
        for mover in movers:
            self._motion(mover, 0)  # refuses what cannot be followed
        self.warnings = tracks.warnings  #: what is left out, and what is not exact
        corners = [self.bodies[name].vertices @ pose[:3, :3].T + pose[:3, 3] for name, pose in self.poses(0).items()]
        self._size = float(np.linalg.norm(np.ptp(np.vstack(corners), axis=0))) or 1.0

    def __repr__(self) -> str:
        moving = sum(carrier.mover != STATIC for carrier in self._carriers)
        return f"<chasles.gltf.Animation: {', '.join(self.animations)}, {self.duration:g} s, {len(self.bodies)} bodies, {moving} of them move>"

    def __getstate__(self) -> dict[str, Any]:
        # Cubic splines have functions that pickle cannot find, so all motions are made again.
        return self.__dict__ | {"_motions": {}}

    @property
    def kinds(self) -> str:
        """The kinds of interpolation that move bodies, as in "linear and step"."""
        nodes = {node for mover in self._movers for node in self._tree.chain(mover)}
        found = {
            track.interpolation
            for (node, path), track in self._tracks.of_node.items()
            if path in KINDS and node in nodes and not track.is_constant
        }
        texts = {"LINEAR": "linear", "STEP": "step", "CUBICSPLINE": "cubic spline"}
        return " and ".join(text for kind, text in texts.items() if kind in found) or "at rest"

    def frames(self, angle: float) -> Array:
        """Times in seconds between which no node turns by much more than this angle against the one above it."""
        turns = [track for (_, path), track in self._tracks.of_node.items() if path == "rotation"]
        return np.unique(np.concatenate([[0.0, self.duration], *(track.frames(angle) for track in turns)]))

    def poses(self, time: float) -> dict[str, Array]:
        """The pose (4, 4) of each body in the coordinates of the scene at a time in seconds. At a jump, that after it."""
        if not 0 <= time <= self.duration:
            raise InvalidInput(f"time: must be from 0 to {self.duration:g} seconds, but is {time:g}")
        piece = int(np.searchsorted(self.jumps, time, side="right"))
        at = {mover: self._motion(mover, piece).pose_at(time / self.duration) for mover in self._movers}
        return {carrier.name: at.get(carrier.mover, np.eye(4)) for carrier in self._carriers}

    def scene(self, piece: int = 0) -> Scene:
        """The scene of one interval between two jumps, for questions of all kinds; without jumps it is the whole animation.

        Its time from 0 to 1 is that from the begin of the interval to the end of the animation. After the end of the interval it
        is not the animation: what jumps then stays here.
        """
        if not 0 <= piece <= len(self.jumps):
            raise InvalidInput(f"piece: must be from 0 to {len(self.jumps)}, the number of jumps, but is {piece}")
        scene = Scene()
        part = self._span(piece)[0] / self.duration
        for carrier in self._carriers:
            body = self.bodies[carrier.name]
            if carrier.mover == STATIC:
                scene.add(carrier.name, body, group="static")
                continue
            motion = self._motion(carrier.mover, piece)
            scene.add(
                carrier.name, body, motion=rest_of(motion, part) if piece else motion, group=f"node {carrier.mover}"
            )
        for mover in self._movers:
            scene.ignore_groups(f"node {mover}", f"node {mover}")
        if len(self.jumps):
            scene.ignore_groups("static", "static")
        return scene

    def first_contact(
        self,
        *,
        margin: float = 0.0,
        find: Find | str = "first",
        ignore: Iterable[Pair] = (),
        ignore_touching_at_start: bool = False,
        time_tolerance: float = 1e-12,
        threads: int = 0,
    ) -> AnimationContact:
        """The earliest contact of all pairs.

        Parameters
        ----------
        margin : float
            Distance that counts as contact, in the unit of the scene.
        find : Find or str
            "first", "first_with_all_contacts", or "any" for a question of yes or no.
        ignore : pairs of names
            They are not tested.
        ignore_touching_at_start : bool
            Whether pairs that touch, overlap or are within the margin at the start are left out, as the parts of a mounted assembly.
        time_tolerance : float
            Width of the bracket to aim for, as a part of the rest of the animation.
        threads : int
            At most so many; 0 for all cores.

        Returns
        -------
        AnimationContact
        """
        options: dict[str, Any] = {"margin": margin, "find": find, "time_tolerance": time_tolerance, "threads": threads}
        ignored = self._ignored(ignore, margin if ignore_touching_at_start else None)
        asked: list[SceneContact] = []
        for piece, scene, until in self._questions(ignored):
            found = scene.first_contact(until=until, **options)
            asked.append(found)
            if found.verdict != Verdict.clear:
                answer = self._answer(found, piece, asked, margin)
                answer.untested = self._untested(ignored)
                return answer
        answer = self._blank(asked, margin)
        answer.clear_until, answer.untested = self.duration, self._untested(ignored)
        return answer

    def all_contacts(
        self,
        *,
        margin: float = 0.0,
        find: Find | str = "first",
        ignore: Iterable[Pair] = (),
        ignore_touching_at_start: bool = False,
        time_tolerance: float = 1e-12,
        threads: int = 0,
    ) -> list[AnimationContact]:
        """The first contact of each pair that touches, in order of time. The arguments are those of `first_contact`."""
        options: dict[str, Any] = {"margin": margin, "find": find, "time_tolerance": time_tolerance, "threads": threads}
        ignored = self._ignored(ignore, margin if ignore_touching_at_start else None)
        answers: dict[frozenset[str], AnimationContact] = {}
        for piece, scene, until in self._questions(ignored):
            for found in scene.all_contacts(until=until, **options):
                answers.setdefault(frozenset(found.pair or ()), self._answer(found, piece, [found], margin))
        return sorted(answers.values(), key=lambda answer: answer.time)

    def untested(
        self, *, ignore: Iterable[Pair] = (), ignore_touching_at_start: bool = False, margin: float = 0.0
    ) -> Untested:
        """What a question with these arguments leaves out."""
        return self._untested(self._ignored(ignore, margin if ignore_touching_at_start else None))

    def view(
        self,
        found: AnimationContact | Iterable[AnimationContact],
        out: str | os.PathLike[str] = "animation.html",
        *,
        title: str | None = None,
    ) -> pathlib.Path:
        """Write a page of HTML with all bodies on their way, a slider for the time and a list of the contacts, and return its path.

        The page is one file and needs no network. Between its times the page moves bodies evenly, so curves are drawn as chords.
        """
        answers = [found] if isinstance(found, AnimationContact) else list(found)
        return write_page(self, answers, pathlib.Path(out), title or self.path.name)

    # Questions

    def _questions(self, ignored: dict[str, list[Pair]]) -> Iterable[tuple[int, Scene, float]]:
        """Scenes and the times until which to ask. After a jump all pairs are tested as they are then."""
        for piece in range(len(self.jumps) + 1):
            scene = self.scene(piece)
            for pair in [*ignored["ignored"], *ignored["touching_at_start"]]:
                scene.ignore(*pair)
            start, end = self._span(piece)
            if len(self.jumps):
                yield piece, scene, 0.0
            rest = self.duration - start
            if rest > 0:
                yield piece, scene, min(1.0, (end - start) / rest * (1 + OVERLAP))

    def _span(self, piece: int) -> tuple[float, float]:
        """The interval of a piece, longer at both ends by more than the roundings of its times."""
        bounds = [0.0, *self.jumps.tolist(), self.duration]
        start = bounds[piece] - OVERLAP * self.duration if piece else 0.0
        return min(max(start, 0.0), self.duration * (1 - 2 * OVERLAP)), bounds[piece + 1]

    def _motion(self, mover: int, piece: int) -> Motion:
        if (mover, piece) not in self._motions:
            if piece and not self._jumps_of[mover]:
                return self._motion(mover, 0)
            since = float(self.jumps[piece - 1]) if piece else 0.0
            self._motions[mover, piece] = self._tree.motion(mover, since)
        return self._motions[mover, piece]

    def _ignored(self, ignore: Iterable[Pair], margin: float | None) -> dict[str, list[Pair]]:
        named = {frozenset((str(a), str(b))): (str(a), str(b)) for a, b in ignore}.values()
        result: dict[str, list[Pair]] = {"ignored": [], "touching_at_start": []}
        scene = self.scene()
        for pair in named:
            scene.ignore(*pair)  # refuses names that do not exist
            if not self._stand_still(*pair):
                result["ignored"].append(pair)
        if margin is not None:
            touching = scene.ignore_touching_at_start(margin=margin)
            result["touching_at_start"] = [pair for pair in touching if not self._stand_still(*pair)]
        return result

    def _stand_still(self, a: str, b: str) -> bool:
        return len(self._movers_of(a, b)) == 1

    def _movers_of(self, a: str, b: str) -> set[int]:
        return {self._mover[a], self._mover[b]}

    def _untested(self, ignored: dict[str, list[Pair]]) -> Untested:
        count = len(self._carriers)
        groups: dict[int, list[str]] = {}
        for carrier in self._carriers:
            groups.setdefault(carrier.mover, []).append(carrier.name)
        rests = sum(len(names) * (len(names) - 1) // 2 for names in groups.values())
        named = (pair for names in groups.values() for pair in combinations(names, 2))
        pairs = {"at_rest": [pair for pair, _ in zip(named, range(100))]} | {
            key: found[:100] for key, found in ignored.items()
        }
        counts = {"at_rest": rests} | {key: len(found) for key, found in ignored.items()}
        counts = {reason: number for reason, number in counts.items() if number}
        return Untested(
            count * (count - 1) // 2 - sum(counts.values()), {reason: pairs[reason] for reason in counts}, counts
        )

    # Answers

    def _blank(self, asked: list[SceneContact], margin: float) -> AnimationContact:
        return AnimationContact(
            Verdict.clear, duration=self.duration, margin=margin, warnings=self.warnings, animations=self._chosen,
            kinds=self.kinds, scene_size=self._size, work=work_of(asked),
        )  # fmt: skip

    def _answer(self, found: SceneContact, piece: int, asked: list[SceneContact], margin: float) -> AnimationContact:
        start = self._span(piece)[0]
        rest = self.duration - start
        answer = self._blank(asked, margin)
        answer.verdict = Verdict.unknown if found.verdict == Verdict.unknown else Verdict.contact
        answer.clear_until = outward(start, found.clear_until, rest, up=False)
        if found.pair is None:
            return answer
        at_start = found.verdict == Verdict.contact_at_start
        if at_start and piece == 0:
            answer.verdict = Verdict.contact_at_start
        at = float(self.jumps[piece - 1]) if piece else 0.0
        answer.pair, answer.certain = found.pair, found.certain
        answer.at_jump = at_start and any(
            at in self._jumps_of[mover] for mover in self._movers_of(*found.pair) - {STATIC}
        )
        answer.time = at if at_start else outward(start, found.time, rest, up=False)
        answer.time_upper = at if at_start else outward(start, found.time_upper, rest, up=True)
        if at_start:
            answer.clear_until = at
        answer.contacts = timed_contacts(found, rest)
        answer.simultaneous = [(pair[0], pair[1]) for pair in found.simultaneous]
        answer.inside = found.inside
        answer.inside_point = found.inside_point if found.inside else None
        answer.overlap_point = found.overlap.point if found.overlap is not None else None
        answer.pose = np.asarray(found.pose)
        return answer
