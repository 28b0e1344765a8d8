"""The verbs that take a project by its name find it where the IDE keeps it."""

from __future__ import annotations

import io
import os
import subprocess
import sys
import zipfile
from typing import TYPE_CHECKING

import pytest

from tests.backend.migrated import add_sqlite

if TYPE_CHECKING:
    from pathlib import Path

NAME = "Patrol at noon"


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data")
    add_sqlite(folder)
    made = studio(folder, "new", NAME, "--template", "laser_bump_and_go")
    assert made.returncode == 0, made.stderr.decode()
    return folder


def studio(data: Path, *arguments: str) -> subprocess.CompletedProcess[bytes]:
    environment = {**os.environ, "BT_STUDIO_DATA_DIR": str(data)}
    command = [sys.executable, "-m", "backend.cli.main", *arguments]
    return subprocess.run(command, env=environment, capture_output=True, check=False, timeout=110)


def test_a_stored_project_is_checked_by_its_name(data: Path) -> None:
    checked = studio(data, "check", NAME)
    assert (checked.returncode, checked.stderr) == (0, b"")
    assert b"no errors" in checked.stdout


def test_a_stored_project_is_translated_by_its_name(data: Path, tmp_path: Path) -> None:
    target = tmp_path / "tree.xml"
    assert studio(data, "translate", NAME, "-o", str(target)).returncode == 0
    assert "<CheckObstacle" in target.read_text("utf-8")


def test_a_stored_project_becomes_a_package_by_its_name(data: Path, tmp_path: Path) -> None:
    target = tmp_path / "package.zip"
    packaged = studio(data, "package", NAME, "-o", str(target))
    assert packaged.returncode == 0, packaged.stderr.decode()
    names = zipfile.ZipFile(io.BytesIO(target.read_bytes())).namelist()
    assert "patrol_at_noon/package.xml" in names


def test_an_unknown_name_is_reported_with_the_known_ones(data: Path) -> None:
    missing = studio(data, "check", "Patrol at midnight")
    assert missing.returncode != 0
    assert b"Traceback" not in missing.stderr
    assert b"Patrol at midnight" in missing.stderr
