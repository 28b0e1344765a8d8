"""The import of a Python file with a tree of py_trees: a higher layer lets it run elsewhere."""

from __future__ import annotations

from typing import IO, TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Future

    from backend.accounts.models import User
    from backend.core.processes.stops import Stop
    from backend.projects.storage.spools import Spool, Spooled

    Read = Callable[[User, "Python", Stop], "Future[Made]"]

SUFFIX: Final = ".py"


class Python(NamedTuple):
    """An uploaded file.

    Attributes:
        data: its content.
        name: its name.
        main: the variable or the function with the tree; "" if it is to be found.
    """

    data: IO[bytes]
    name: str
    main: str


class Made(NamedTuple):
    """A project for the tree.

    Attributes:
        files: the contents by path, until `spool` is closed.
        one_block: why the tree is one block; "" if it is a tree of blocks.
        spool: the file with the contents.
    """

    files: dict[str, Spooled]
    one_block: str
    spool: Spool


_readers: Final[list[Read]] = []


def read_by(read: Read) -> None:
    """Takes the function that reads such files; it is of a higher layer."""
    _readers[:] = [read]


def read(user: User, python: Python, stop: Stop) -> Future[Made]:
    """Returns the project for a tree, once it is made.

    Raises:
        ImportUnavailableError: no process may run the file here.
        BusyError: too many wait.
    """
    return _readers[0](user, python, stop)
