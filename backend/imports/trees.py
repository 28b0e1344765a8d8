"""Makes projects of Python files with trees of py_trees: in the child of imports, never in the web server."""

from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Final

import msgspec
from msgspec import Meta

from backend.core.limits import LIMITS
from backend.imports import answers
from backend.imports.errors import ImportRefusedError
from backend.imports.runner import runner
from backend.projects.documents.python_trees import Made, Python
from backend.projects.errors import CheckFailedError, QuotaExceededError
from backend.projects.storage.spools import Spool
from backend.workers.aside import importing
from translator.diagnostic import Place, diagnostic

if TYPE_CHECKING:
    from concurrent.futures import Future

    from backend.accounts.models import User
    from backend.core.processes.stops import Stop
    from backend.imports.runner import Run

_Text = Annotated[str, Meta(max_length=20_000)]
_MOST_FILE: Final = 4 << 20
"""Bytes of a Python file; larger ones hold data, not a tree."""


class _NoTree(msgspec.Struct):
    file: _Text
    line: int
    message: _Text
    choices: Annotated[list[Annotated[str, Meta(max_length=200)]], Meta(max_length=500)]


class _Answer(msgspec.Struct):
    no_tree: _NoTree | None = None
    files: Annotated[list[answers.File], Meta(max_length=20_000)] = []
    one_block: _Text = ""


def read(user: User, python: Python, stop: Stop) -> Future[Made]:
    """Returns the project for the tree that a file builds, once it is made.

    Args:
        user: in whose tools the file runs.
        python: the file.
        stop: ends the work.

    Raises:
        QuotaExceededError: the file is too large.
        ImportUnavailableError: no process may run it here.
        BusyError: too many wait.
    """
    size = python.data.seek(0, os.SEEK_END)
    python.data.seek(0)
    most = min(_MOST_FILE, LIMITS["import_upload_bytes"])
    if size > most:
        raise QuotaExceededError(f"A Python file with a tree has at most {most:,} bytes.", field="file")
    return importing.ask(f"user {user.pk}", partial(make, python, stop, runner(user)))


def make(python: Python, stop: Stop, run: Run) -> Made:
    """Returns the project that the child makes; the caller closes its spool.

    Raises:
        CheckFailedError: the file makes no tree, or several.
        StudioError: the child cannot say.
    """
    header: dict[str, Any] = {"filename": python.name, "kind": "tree", "main": python.main}
    answer = run(header, python.data, stop)
    answers.read(answer)  # it may say that nothing could be read
    try:
        found = msgspec.json.decode(answer, type=_Answer)
    except (msgspec.DecodeError, UnicodeError) as error:
        raise ImportRefusedError(
            "What the file says about its tree cannot be read.", diagnostics=[]
        ) from error
    if found.no_tree is not None:
        _refuse(found.no_tree)
    spool = Spool()
    try:
        contents = answers.contents(found.files, python.data, ("",), spool)
    except BaseException:
        spool.close()
        raise
    return Made(contents, found.one_block, spool)


def _refuse(found: _NoTree) -> None:
    place = Place(found.file, line=found.line)
    if found.choices:
        problems = [diagnostic("BT0927", place, choice=choice) for choice in found.choices]
    else:
        problems = [diagnostic("BT0928", place, problem=found.message)]
    first = problems[0]
    raise CheckFailedError(
        f"{found.file}:{found.line}: {found.message}",
        hint=first.hint,
        diagnostics=[problem.to_json() for problem in problems],
    )
