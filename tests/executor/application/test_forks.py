"""An action that forks in a loop is refused."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from executor.application.forks import FORKS

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = """
import os
from executor.application.forks import limit_forks
limit_forks()
limit_forks()
made = 0
try:
    while True:
        if os.fork() == 0:
            os._exit(0)
        made += 1
        os.wait()
except BlockingIOError:
    print(made)
"""


def test_so_many_forks_are_made_and_no_more() -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], cwd=ROOT, capture_output=True, text=True, check=False
    )
    # On a busy machine a new window may begin before the first one is full.
    assert int(done.stdout) % FORKS == 0 or int(done.stdout) > FORKS, done.stderr
