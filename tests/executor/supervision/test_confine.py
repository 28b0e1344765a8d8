"""A child does not outlive its parent."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from executor.supervision.confine import PARENT_VARIABLE

ROOT = Path(__file__).resolve().parents[3]
CHILD = "from executor.supervision.confine import die_with_parent; die_with_parent(); print('lives')"


def run(parent: int) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, PARENT_VARIABLE: str(parent)}
    command = [sys.executable, "-c", CHILD]
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)


def test_a_child_of_its_parent_lives_and_one_of_a_parent_that_is_gone_does_not() -> None:
    assert (run(os.getpid()).stdout, run(1 << 22).returncode) == ("lives\n", 1)
