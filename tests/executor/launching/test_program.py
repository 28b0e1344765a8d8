"""A program of a launch file replaces the process that starts it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from executor.launching import program

ROOT = Path(__file__).resolve().parents[3]


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", program.__name__, *arguments]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


def test_it_runs_in_its_folder(tmp_path: Path) -> None:
    done = run(str(tmp_path), sys.executable, "-c", "import os; print(os.getcwd())")
    assert (done.stdout, done.returncode) == (f"{tmp_path}\n", 0)


def test_a_program_that_is_not_there_ends_as_in_a_shell(tmp_path: Path) -> None:
    done = run(str(tmp_path), "/no/such/program")
    assert done.returncode == 127
    assert done.stderr == "/no/such/program: No such file or directory\n"
