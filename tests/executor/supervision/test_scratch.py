"""Temporary folders of sessions."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from executor.supervision.scratch import LOCK, PREFIX, Scratch

ROOT = Path(__file__).parents[3]
HOLD = """
from executor.supervision.scratch import Scratch
made = Scratch()
(made.path / "app").write_text("…")
print(made.path, flush=True)
input()
"""


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("TMPDIR", str(tmp_path))


def age(folder):
    os.utime(folder / LOCK, (0, 0))


def test_files_of_a_killed_process_are_removed_at_the_next_start():
    with subprocess.Popen(
        [sys.executable, "-c", HOLD], cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as owner:
        folder = Path(owner.stdout.readline().strip())
        age(folder)
        Scratch().remove()
        assert (folder / "app").exists()
        owner.kill()
    assert (folder / "app").exists()
    Scratch().remove()
    assert not folder.exists()


def test_files_of_others_are_kept(tmp_path):
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / LOCK).touch()
    age(tmp_path / "other")
    strange = tmp_path / f"{PREFIX}strange"
    strange.mkdir()
    target = tmp_path / "target"
    target.touch()
    (strange / LOCK).symlink_to(target)
    young = tmp_path / f"{PREFIX}young"
    young.mkdir()
    (young / LOCK).touch()
    made = Scratch()
    made.remove()
    made.remove()
    assert {path.name for path in tmp_path.iterdir()} == {"other", strange.name, "target", young.name}
