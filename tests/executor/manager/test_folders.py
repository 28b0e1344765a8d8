"""The folders of unpacked applications, also after an earlier run has filled the disk."""

from __future__ import annotations

import errno
import os
import shutil
import tempfile
from pathlib import Path
from typing import Any

import pytest

from executor.manager import folders
from executor.manager.archive import ArchiveError
from executor.manager.folders import Folders
from executor.session.events import Unpack
from executor.supervision.scratch import LOCK, PREFIX, Scratch
from tests.executor.session_client import app_zip


@pytest.fixture
def disk(tmp_path, monkeypatch):
    """Yields a folder for temporary files whose disk is full while `hoard` exists."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    (tmp_path / "hoard").mkdir()
    (tmp_path / "hoard" / "big").write_text("…")
    (tmp_path / "more").symlink_to(tmp_path / "hoard")
    real: Any = vars(folders)["unpack"]

    def unpack(archive, folder):
        if (tmp_path / "hoard").exists():
            try:
                raise OSError(errno.ENOSPC, "No space left on device")
            except OSError as error:
                raise ArchiveError("it cannot be unpacked: No space left on device") from error
        real(archive, folder)

    monkeypatch.setattr(folders, "unpack", unpack)
    return tmp_path


def test_in_a_container_files_of_earlier_runs_are_removed_for_space(disk):
    made = Folders(is_alone=True)
    done = made.unpack(Unpack(1, app_zip()))
    assert not done.error
    assert [path.name for path in disk.iterdir()] == [made._scratch.path.name]
    made.remove()
    assert list(disk.iterdir()) == []


def test_folders_in_use_survive_the_making_of_room(disk):
    world = Scratch()
    forged = disk / f"{PREFIX}forged"
    forged.mkdir()
    (forged / LOCK).touch()
    (forged / "hoard").write_text("…")
    for path in (forged, forged / LOCK):
        os.utime(path, (2**33, 2**33))
    made = Folders(is_alone=True)
    assert not made.unpack(Unpack(1, app_zip())).error
    assert {path.name for path in disk.iterdir()} == {made._scratch.path.name, world.path.name}


def test_a_disk_that_is_nearly_full_is_swept_before_the_world_lacks_room(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    (tmp_path / "hoard").write_text("…")
    nearly = shutil.disk_usage(tmp_path)._replace(free=folders.SPARE_BYTES - 1)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: nearly)
    for is_alone in (False, True):
        assert (tmp_path / "hoard").exists()
        assert not Folders(is_alone=is_alone).unpack(Unpack(1, app_zip())).error
    assert not (tmp_path / "hoard").exists()


def test_elsewhere_nothing_is_removed_and_the_reason_is_reported(disk):
    done = Folders(is_alone=False).unpack(Unpack(1, app_zip()))
    assert "No space left" in done.error
    assert (disk / "hoard" / "big").exists()


def test_a_folder_that_cannot_be_created_is_reported(disk):
    made = Folders(is_alone=False)
    made.remove()
    assert "cannot be unpacked" in made.unpack(Unpack(1, app_zip())).error


def test_only_the_newest_are_kept(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    made = Folders(is_alone=False)
    for token in range(1, 6):
        assert not made.unpack(Unpack(token, app_zip())).error
    assert sorted(path.name for path in made._scratch.path.glob("?")) == ["3", "4", "5"]


def test_the_folder_of_the_running_application_stays(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    made = Folders(is_alone=False)
    running = made.unpack(Unpack(1, app_zip())).folder
    later = [made.unpack(Unpack(token, app_zip(), frozenset({running}))).folder for token in range(2, 8)]
    assert Path(running).is_dir()
    assert [folder for folder in later if Path(folder).is_dir()] == later[-2:]
    made.remove()
