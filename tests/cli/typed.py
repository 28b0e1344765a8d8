"""Runs `bt-studio` as it is typed, in a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.evaluation.pool.environment import SINGLE

if TYPE_CHECKING:
    from collections.abc import Mapping

ROOT: Final = Path(__file__).parents[2]
STUDIO: Final = (sys.executable, "-c", "from backend.cli.main import main; main()")
ENVIRONMENT: Final = {**os.environ, "PYTHONPATH": str(ROOT)}
EVALUATING: Final = {**ENVIRONMENT, **SINGLE, "PYTHONHASHSEED": "0"}
"""The environment that `evaluate` wants: without it, it starts itself a second time."""
LONGEST_S: Final = 380


def studio(*arguments: object, env: Mapping[str, str] = ENVIRONMENT) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [*STUDIO, *map(str, arguments)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=LONGEST_S,
        env=env,
        check=False,
    )


evaluating = partial(studio, env=EVALUATING)
