"""The world of an exact run, and the state with which it begins."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from executor.exact.world import ExactWorld

ROOT = Path(__file__).parents[3]


def test_a_world_takes_commands_gives_sensors_and_begins_where_another_ended() -> None:
    assert ExactWorld.__doc__
    command = [sys.executable, "-m", "tests.executor.exact.exact_world"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr.decode()
    found = json.loads(done.stdout)
    assert found["ticks"] == 20
    assert found["x"] > 0.1
    assert len(found["heard"]) > 20
    assert found["heard"][-1] > 0.1
    assert found["again"] == [found["time_s"], found["x"], round(found["time_s"] * 240)]
