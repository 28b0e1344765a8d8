"""Runs modules of the product to their end, in a forked process where there is one that forks."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryFile
from typing import TYPE_CHECKING, Any

from tests.backend.preloaded import preloaded

if TYPE_CHECKING:
    from collections.abc import Mapping

    from tests.backend.preloaded import Process

REPOSITORY = Path(__file__).parents[2]


def environment_with(settings: Mapping[str, str], repository: Path = REPOSITORY) -> dict[str, str]:
    """Returns the environment of this process with these settings of ours, and no others."""
    clean = {name: value for name, value in os.environ.items() if not name.startswith("BT_STUDIO_")}
    return {**clean, "PYTHONPATH": str(repository), **settings}


def run_program(module: str, *arguments: str, said: str = "", **settings: str) -> str:
    """Runs `python -m module`, which must succeed, with an input; returns its output."""
    environment, forking = environment_with(settings), preloaded()
    with TemporaryFile("w+") as given, TemporaryFile("w+") as output:
        given.write(said)
        given.seek(0)
        if forking is None:
            command = [sys.executable, "-m", module, *arguments]
            process = subprocess.Popen(command, cwd=REPOSITORY, env=environment, stdin=given, stdout=output)
            status = process.wait()
        else:
            streams = (given.fileno(), output.fileno(), 2)
            status = forking.start(module, *arguments, env=environment, streams=streams).wait()
        output.seek(0)
        assert status == 0, (module, arguments, status)
        return output.read()


def start_program(module: str, env: dict[str, str], errors: Any) -> Process | subprocess.Popen[bytes]:
    """Starts `python -m module`; what it reports goes to an open file."""
    if forking := preloaded():
        return forking.start(module, env=env, streams=(0, 1, errors.fileno()))
    return subprocess.Popen([sys.executable, "-m", module], env=env, cwd=REPOSITORY, stderr=errors)


def sign_in(folder: Path, settings: Mapping[str, str], number: int) -> list[tuple[str, str]]:
    """Makes accounts that are signed in, as `tests.benchmarks.load` does; returns the cookie of each."""
    own = {**settings, "BT_STUDIO_DATA_DIR": str(folder)}
    return [
        ("Cookie", each) for each in json.loads(run_program("tests.benchmarks.people", str(number), **own))
    ]
