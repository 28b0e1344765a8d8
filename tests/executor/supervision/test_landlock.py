"""Landlock: a process gives up the files outside of some folders."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

from executor.supervision.landlock import READ, every_right, landlock_version

if TYPE_CHECKING:
    from pathlib import Path

RESTRICTED = """
import sys, pathlib
from executor.supervision.landlock import LIST, READ, restrict
restrict([(pathlib.Path(sys.argv[1]), READ | LIST), (pathlib.Path("/no/such/folder"), READ)])
for path in (sys.argv[1] + "/a", sys.argv[2]):
    try:
        print(open(path).read())
    except PermissionError:
        print("refused")
"""


def test_files_outside_cannot_be_opened_where_the_kernel_has_it(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "a").write_text("inside")
    (tmp_path / "b").write_text("outside")
    done = subprocess.run(
        [sys.executable, "-c", RESTRICTED, str(tmp_path / "in"), str(tmp_path / "b")],
        capture_output=True,
        text=True,
        check=False,
    )
    has_landlock = landlock_version() > 0
    assert done.stdout.splitlines() == (["inside", "refused"] if has_landlock else [])
    assert ("LandlockError" in done.stderr) is not has_landlock
    assert every_right() & READ
