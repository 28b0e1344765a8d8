"""A child does not outlive its parent."""

from __future__ import annotations

import os
import resource
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


LIMITS = """import resource, executor.supervision.confine as confine
confine.confine_reader(512 << 20, 10, 1 << 20)
print(*(resource.getrlimit(which) for which in (resource.RLIMIT_FSIZE, resource.RLIMIT_CPU)))"""


def test_a_lower_limit_of_the_user_stays() -> None:
    """Only root may raise a hard limit again."""
    done = subprocess.run(
        [sys.executable, "-c", LIMITS],
        cwd=ROOT,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 10, 1 << 10)),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == "(1024, 1024) (10, 10)\n", done.stderr
