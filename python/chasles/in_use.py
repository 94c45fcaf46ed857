"""Objects that are written in Python and can change: a change is refused while a question about the object is running.

The compiled types do the same (python/src/use.h).
"""

import functools
from collections.abc import Callable
from typing import Any, TypeVar

Method = TypeVar("Method", bound=Callable[..., Any])


def question(what: str) -> Callable[[Method], Method]:
    """For methods of an object with a `_use` that read it: many of them may run at the same time."""

    def of(method: Method) -> Method:
        @functools.wraps(method)
        def ask(self: Any, *arguments: Any, **options: Any) -> Any:
            self._use.begin_question(what)
            try:
                return method(self, *arguments, **options)
            finally:
                self._use.end_question()

        return ask  # type: ignore[return-value]

    return of


def change(what: str) -> Callable[[Method], Method]:
    """For methods that change the object: no question and no other change may run at the same time."""

    def of(method: Method) -> Method:
        @functools.wraps(method)
        def make(self: Any, *arguments: Any, **options: Any) -> Any:
            self._use.begin_change(what)
            try:
                return method(self, *arguments, **options)
            finally:
                self._use.end_change()

        return make  # type: ignore[return-value]

    return of
