"""A program whose descendants end with it; behaviour tests show it, too (`testing/test_apart.py`)."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tree_gardener.descendants import descendants, guarded

if TYPE_CHECKING:
    from collections.abc import Iterator

HEAD = f"""import os, subprocess, sys, time
from {guarded.__module__} import guarded

def main():
    child = subprocess.Popen(["sleep", "600"], start_new_session=True)
    print(os.getpid(), child.pid, flush=True)
"""


@contextlib.contextmanager
def started(then: str) -> Iterator[tuple[subprocess.Popen[str], list[int]]]:
    source = f"{HEAD}    {then}\nsys.exit(guarded(main, {os.getpid()}))\n"
    with subprocess.Popen([sys.executable, "-c", source], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        yield process, [int(word) for word in process.stdout.readline().split()]


@pytest.mark.parametrize(("then", "status"), [("return 3", 3), ("os._exit(4)", 4), ("os.abort()", -6)])
def test_the_status_is_that_of_the_program_and_its_children_end_first(then: str, status: int) -> None:
    with started(then) as (process, pids):
        process.wait()
        assert process.returncode == status % 256
        assert not any(Path(f"/proc/{pid}").exists() for pid in pids)


def test_a_program_that_does_not_end_is_ended_with_its_children() -> None:
    with started("time.sleep(600)") as (process, pids):
        assert set(pids) <= set(descendants(os.getpid()))
        process.send_signal(signal.SIGTERM)
        process.wait()
        assert not any(Path(f"/proc/{pid}").exists() for pid in pids)


def test_a_program_whose_parent_ended_before_it_could_ask_is_not_run() -> None:
    with subprocess.Popen(["true"]) as ended:
        pass
    source = f"{HEAD}\nsys.exit(guarded(main, {ended.pid}))\n"
    found = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True, check=False)
    assert (found.stdout, found.stderr, found.returncode) == ("", "", 128 + signal.SIGTERM)
