"""`bt-studio debug` with a real project in its simulated world; the commands come by a pipe."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from executor.headless.debug.run import WELCOME

ROOT = Path(__file__).parents[4]
EXAMPLE = ROOT / "examples" / "laser_bump_and_go"

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(240)]


def start(*arguments: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "backend.cli.main", "debug", str(EXAMPLE), *arguments]
    return subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONHASHSEED": "0"},
    )


def test_world_and_tick_are_held_and_continue_together() -> None:
    process = start("--duration", "1")
    out, errors = process.communicate("tree\ntick\ntick\ncontinue\n", timeout=200)
    assert process.returncode == 0, errors
    lines = out.splitlines()
    assert lines[0] == WELCOME
    stops = [line for line in lines if " s, tick " in line]
    assert [stop.split(":")[0] for stop in stops] == ["0.00 s, tick 1", "0.05 s, tick 2", "0.10 s, tick 3"]
    assert "20 ticks, 1.0 s simulated" in lines[-1]


def test_ctrl_c_holds_at_the_next_node_and_quit_ends_the_run() -> None:
    process = start()
    assert process.stdin is not None
    assert process.stdout is not None
    process.stdin.write("continue\n")
    process.stdin.flush()
    while "driving ahead" not in process.stdout.readline():  # an action of the example prints it
        assert process.poll() is None
    process.send_signal(signal.SIGINT)
    assert "(a hold was requested)" in process.stdout.readline()
    out, errors = process.communicate("quit\n", timeout=100)
    assert out.splitlines() == ["the run was ended"]
    assert (process.returncode, "Traceback" in errors) == (0, False)


def test_what_cannot_be_debugged_is_refused_in_one_sentence() -> None:
    process = start("--universe", "nowhere_at_all")
    _, errors = process.communicate("", timeout=100)
    assert process.returncode == 1
    assert "nowhere_at_all" in errors
    assert "Traceback" not in errors
