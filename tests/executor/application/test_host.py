"""The process that runs users' code finds their modules."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from executor.application import host

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = """
import os, sys
from pathlib import Path
from executor.application.host import enter
leave = enter(Path(sys.argv[1]))
import helper
assert os.getcwd() == sys.argv[1] and helper.VALUE == 5
leave()
assert sys.argv[1] not in sys.path
print("well")
"""


def test_modules_of_the_project_are_found_in_its_folder(tmp_path: Path) -> None:
    (tmp_path / "actions").mkdir()
    (tmp_path / "actions" / "helper.py").write_text("VALUE = 5\n")
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(tmp_path)], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert (done.stdout, done.returncode) == ("well\n", 0), done.stderr
    assert host.enter.__doc__
