"""Packages that only some functions need: an error says how to install them."""

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def extra(name: str, user: str) -> Iterator[None]:
    """Around the import of packages that the extra `name` of this package installs, and `user` needs."""
    try:
        yield
    except ModuleNotFoundError as error:
        what = f'{user} needs {error.name}, which is not installed: pip install "chasles[{name}]"'
        raise ModuleNotFoundError(what, name=error.name) from error
