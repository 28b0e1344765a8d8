"""The environment of processes whose forks are runs."""

import os
import subprocess
import sys
from pathlib import Path

from executor.supervision.single_threaded import SINGLE_THREADED

ROOT = Path(__file__).resolve().parents[3]
COUNTS = """import numpy, os
numpy.ones((400, 400)) @ numpy.ones((400, 400))
print(len(os.listdir("/proc/self/task")), sorted({str(n) for n in range(9)}, key=hash)[0])"""


def test_libraries_start_no_threads_and_hashes_are_equal():
    said = {
        subprocess.run(
            [sys.executable, "-c", COUNTS],
            env={**os.environ, **SINGLE_THREADED},
            cwd=ROOT,
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for _ in range(2)
    }
    assert len(said) == 1
    assert said.pop().startswith("1 ")
