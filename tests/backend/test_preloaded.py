"""Programs that are forked behave as those that `python -m` starts."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from tempfile import TemporaryFile
from typing import IO, TYPE_CHECKING

import pytest

from tests.backend.preloaded import Preloaded, preloaded

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

PROGRAM = """
import os, signal, sys
print(sys.argv[1:], os.environ["WHO"], "SHELL" in os.environ, sys.stdin.read(), __name__, flush=True)
{}
"""


@pytest.fixture
def forking() -> Preloaded:
    found = preloaded()
    assert found is not None
    return found


@pytest.fixture
def files() -> Iterator[tuple[IO[str], IO[str], IO[str]]]:
    with TemporaryFile("w+") as given, TemporaryFile("w+") as output, TemporaryFile("w+") as errors:
        given.write("said")
        given.seek(0)
        yield given, output, errors


@pytest.mark.parametrize(
    ("end", "status", "error"),
    [
        ("", 0, ""),
        ("sys.exit(3)", 3, ""),
        ("sys.exit('not so')", 1, "not so\n"),
        ("raise ValueError('not so')", 1, "ValueError: not so\n"),
        ("os.kill(os.getpid(), signal.SIGTERM)", -signal.SIGTERM, ""),
        ("signal.raise_signal(signal.SIGINT)", -signal.SIGINT, "KeyboardInterrupt\n"),
    ],
)
def test_a_program_ends_as_if_it_was_started(  # noqa: PLR0917 - the parts of a case
    forking: Preloaded,
    files: tuple[IO[str], IO[str], IO[str]],
    tmp_path: Path,
    end: str,
    status: int,
    error: str,
) -> None:
    (tmp_path / "own_program.py").write_text(PROGRAM.format(end))
    environment = {"PATH": os.environ["PATH"], "WHO": "a test", "PYTHONPATH": str(tmp_path)}
    given, output, errors = files
    streams = (given.fileno(), output.fileno(), errors.fileno())
    with forking.start("own_program", "a", "b", env=environment, streams=streams) as process:
        assert process.wait(60) == process.poll() == process.returncode == status
    output.seek(0)
    errors.seek(0)
    assert output.read() == "['a', 'b'] a test False said __main__\n"
    said = errors.read()
    assert said.endswith(error)
    assert bool(said) == bool(error)
    given.seek(0)
    command = [sys.executable, "-m", "own_program", "a", "b"]
    started = subprocess.run(
        command, env=environment, stdin=given, capture_output=True, text=True, check=False
    )
    output.seek(0)
    assert (started.returncode, started.stdout) == (status, output.read())
    assert started.stderr.endswith(error)


def test_a_program_that_runs_is_waited_for_and_killed(
    forking: Preloaded, files: tuple[IO[str], IO[str], IO[str]], tmp_path: Path
) -> None:
    (tmp_path / "sleeper.py").write_text("import signal\nsignal.pause()\n")
    streams = tuple(each.fileno() for each in files)
    environment = {"PYTHONPATH": str(tmp_path)}
    process = forking.start("sleeper", env=environment, streams=streams)  # type: ignore[arg-type]
    assert process.poll() is None
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(0.01)
    process.kill()
    assert process.wait(60) == -signal.SIGKILL
    process.kill()  # there is none any more
