"""The end of the process while other threads ask questions: it is silent, and keeps its exit status."""

import atexit
import os
import sys

from . import _core


def _end_questions_of_other_threads() -> None:
    if len(sys._current_frames()) > 1:
        _core._end_questions()


def prepare() -> None:
    """Ends the questions of daemon threads before the interpreter finalizes, which ends threads wherever they are."""
    atexit.register(_end_questions_of_other_threads)
    if hasattr(os, "register_at_fork"):
        os.register_at_fork(after_in_child=_core._forget_other_threads)
