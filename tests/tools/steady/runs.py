"""Runs one test file in its own process, on an idle or a busy machine."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import time
from typing import IO, TYPE_CHECKING, Final

from lxml import etree

from tests.tools.steady.files import PAGE, WrongInputError, is_of_page
from tests.tools.steady.results import Repeat

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

BUSY: Final = 8
END_S: Final = 120
_NO_TESTS: Final = 5  # pytest's status if a file has none
_WHOLE: Final = "the run itself"
# Becomes another program, to which the kernel sends a signal when this one ends in any way.
_TIED: Final = """
import ctypes, os, sys
how, parent, *command = sys.argv[1:]
ctypes.CDLL(None).prctl(1, int(how))  # PR_SET_PDEATHSIG
if os.getppid() == int(parent):
    os.execvp(command[0], command)
"""


def run(root: Path, file: str, tree: str, *, is_loaded: bool) -> Repeat:
    """Runs a test file to its end.

    Raises:
        WrongInputError: the test program is missing.
        KeyboardInterrupt: the user interrupts it; the run has ended then.
    """
    began_s = time.monotonic()
    with busy(BUSY if is_loaded else 0), _empty(root / "var" / "steady") as folder:
        junit, log = folder / "junit.xml", folder / "output"
        with log.open("wb") as output:
            where = root / PAGE if is_of_page(file) else root
            with tied(signal.SIGINT, *_command(root, file, junit), cwd=where, output=output) as process:
                status = process.wait()
        passed, failed = _read(junit)
        if status not in (0, _NO_TESTS) and not failed:
            last = log.read_text(errors="replace").strip().splitlines()[-1:]
            failed[_WHOLE] = f"status {status}: {''.join(last)}"[:300]
    return Repeat(file, is_loaded, passed, failed, round(time.monotonic() - began_s, 2), tree)


@contextlib.contextmanager
def _empty(folder: Path) -> Iterator[Path]:
    """Makes a folder, in place of one that a killed run left, and removes it at the end."""
    shutil.rmtree(folder, ignore_errors=True)
    try:
        folder.mkdir(parents=True)
        yield folder
    except OSError as error:
        raise WrongInputError(f"{folder} cannot be written: {error.strerror}.") from None
    finally:
        shutil.rmtree(folder, ignore_errors=True)


@contextlib.contextmanager
def busy(count: int) -> Iterator[None]:
    """Keeps processors busy; the processes end with this one, however it ends."""
    with contextlib.ExitStack() as stack:
        for _ in range(count):
            stack.enter_context(tied(signal.SIGKILL, "sh", "-c", "while :; do :; done"))
        yield


@contextlib.contextmanager
def tied(
    how: signal.Signals, *command: str, cwd: Path | None = None, output: IO[bytes] | None = None
) -> Iterator[subprocess.Popen[bytes]]:
    """Starts a program that gets a signal when it is not wanted, or when this process ends."""
    process = subprocess.Popen(
        [sys.executable, "-I", "-S", "-c", _TIED, str(int(how)), str(os.getpid()), *command],
        cwd=cwd,
        stdin=subprocess.DEVNULL,
        stdout=output,
        stderr=subprocess.STDOUT if output else None,
        start_new_session=True,  # Ctrl+C reaches this program alone, which passes it on
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            process.send_signal(how)
        try:
            process.wait(END_S)
        except (subprocess.TimeoutExpired, KeyboardInterrupt):
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def _command(root: Path, file: str, junit: Path) -> list[str]:
    if not is_of_page(file):
        return [sys.executable, "-m", "pytest", "-q", "--tb=line", f"--junitxml={junit}", file]
    vitest = root / PAGE / "node_modules" / ".bin" / "vitest"
    if not vitest.exists():
        raise WrongInputError(f"{vitest} is missing: run `make setup-test`.")
    return [str(vitest), "run", "--reporter=junit", f"--outputFile={junit}", file.removeprefix(f"{PAGE}/")]


def _read(junit: Path) -> tuple[int, dict[str, str]]:
    """Returns how many tests passed, and the errors of those that failed."""
    passed, failed = set(), dict[str, str]()
    try:
        cases = list(etree.parse(junit).iter("testcase")) if junit.exists() else []
    except etree.XMLSyntaxError:
        raise WrongInputError(f"{junit} is half a report: is the disk full?") from None
    for case in cases:
        name = case.get("name", "")
        wrong = [each for each in case if each.tag in ("failure", "error")]
        if wrong:
            failed.setdefault(name, (wrong[0].get("message") or "").strip().partition("\n")[0][:300])
        elif case.find("skipped") is None:
            passed.add((case.get("classname"), name))
    return len(passed), failed
