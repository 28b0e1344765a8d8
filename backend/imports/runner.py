"""Runs the child that reads an upload: nothing of it is unpacked or parsed in the web server.

On localhost the child is `executor.uploads`, known by its command alone; on a server with containers it runs
in the user's tools.
"""

from __future__ import annotations

import contextlib
import json
import logging
import os
import shutil
import signal
import subprocess
import sys
import threading
from functools import partial
from itertools import chain
from typing import IO, TYPE_CHECKING, Any, Final

from backend.config.environment import REPOSITORY, environment
from backend.core.scratch import scratch
from backend.imports.errors import ImportUnavailableError
from backend.language import tools
from backend.language.errors import CheckerUnavailableError

if TYPE_CHECKING:
    from collections.abc import Callable

    from backend.accounts.models import User
    from backend.core.processes.stops import Stop

    Run = Callable[[dict[str, Any], IO[bytes], Stop], bytes]
    """Answers a header about an upload as JSON; b"" if the child gave no answer."""

DEADLINE_S: Final = 90.0
ANSWER_BYTES: Final = 64 << 20
COPY_BYTES: Final = 1 << 20
_EXIT_S: Final = 2.0
CHILD: Final = "executor.uploads"
_SAID_BYTES: Final = 2_000
log = logging.getLogger(__name__)
_PASSED: Final = ("PATH", "LANG", "LC_ALL", "PYTHONPATH")
_OF_ROBOTS: Final = ("AMENT_", "ROS_", "GZ_", "IGN_", "GAZEBO_", "TURTLEBOT", "ROBOT_")
_MISSING: Final = "This server has no containers, and without them it imports no robots and worlds."


def runner(user: User) -> Run:
    """Returns the function that runs the child.

    Raises:
        ImportUnavailableError: this server has none.
    """
    if environment().has_containers:
        return partial(_run_in_tools, user)
    if environment().is_team:
        hint = "Import it with `bt-studio import-robot` or `import-universe`, and upload the project."
        raise ImportUnavailableError(_MISSING, hint=hint)
    return run_beside


def run_beside(header: dict[str, Any], upload: IO[bytes], stop: Stop) -> bytes:
    """Runs the child of this process, which gets nothing of its secrets."""
    passed = {key: value for key, value in os.environ.items() if key in _PASSED or key.startswith(_OF_ROBOTS)}
    with (
        scratch().directory() as made,
        subprocess.Popen(
            [sys.executable, "-m", CHILD, str(made)],
            cwd=REPOSITORY,
            env=passed | {"OPENBLAS_NUM_THREADS": "1"},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        ) as child,
    ):
        end = partial(_end, child)
        said = _Said(child)
        timer = threading.Timer(DEADLINE_S, end)
        timer.start()
        try:
            stop.bind(end)
            answer = _answer(child, header, upload)
            if not answer:
                said.join(_EXIT_S)
        finally:
            timer.cancel()
            timer.join()
            stop.release()
            end()
            said.join()
    if not answer or child.returncode > 0:
        log.warning("the child of an import ended with status %s: %r", child.returncode, said.end)
    return answer


class _Said(threading.Thread):
    """Reads what a child writes to standard error, and keeps the end of it."""

    def __init__(self, child: subprocess.Popen[bytes]) -> None:
        super().__init__(name="import-errors", daemon=True)
        assert child.stderr is not None  # noqa: S101 - for the type checker
        self._number = child.stderr.fileno()
        self.end = b""
        self.start()

    def run(self) -> None:
        while part := os.read(self._number, 1 << 16):
            self.end = (self.end + part)[-_SAID_BYTES:]


def _answer(child: subprocess.Popen[bytes], header: dict[str, Any], upload: IO[bytes]) -> bytes:
    assert child.stdin is not None  # noqa: S101 - for the type checker
    assert child.stdout is not None  # noqa: S101 - for the type checker
    with contextlib.suppress(BrokenPipeError), child.stdin as to:
        to.write(_line(header))
        shutil.copyfileobj(upload, to, COPY_BYTES)
    answer = child.stdout.read(ANSWER_BYTES + 1)
    return answer if len(answer) <= ANSWER_BYTES else b""


def _line(header: dict[str, Any]) -> bytes:
    return json.dumps(header).encode() + b"\n"


def _end(child: subprocess.Popen[bytes]) -> None:
    """Ends the child, and that of its macros."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(child.pid, signal.SIGKILL)


def _run_in_tools(user: User, header: dict[str, Any], upload: IO[bytes], stop: Stop) -> bytes:
    upload.seek(0)
    parts = chain([_line(header)], iter(partial(upload.read, COPY_BYTES), b""))
    try:
        return tools.run_upload(user, parts, stop.bind)
    except CheckerUnavailableError as error:
        raise ImportUnavailableError(error.detail) from error
