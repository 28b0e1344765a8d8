"""The folder that language servers read."""

from __future__ import annotations

import tomllib
from uuid import uuid4

import pytest

from backend.language.folder import Folder, Sync, library


@pytest.fixture
def folder(settings_of, tmp_path):
    settings_of(data_dir=tmp_path)
    made = Folder(uuid4())
    made.prepare()
    return made


def test_it_holds_the_python_of_the_project_and_nothing_that_configures(folder):
    files = {
        "actions/Go.py": b"x = 1\n",
        "ty.toml": b'[environment]\npython = "/tmp/evil"\n',
        "actions/pyproject.toml": b"[tool.ty]\n",
        "trees/MainTree.json": b"{}",
    }
    assert folder.sync(files) == Sync(created=("actions/Go.py",), changed=(), deleted=())
    assert [p.name for p in folder.files.rglob("*") if p.is_file()] == ["Go.py"]
    ours = tomllib.loads((folder.home / "ty.toml").read_text())
    assert str(library()) in ours["environment"]["extra-paths"]


def test_it_follows_changes_and_says_which(folder):
    folder.sync({"actions/Go.py": b"1", "actions/Old.py": b"1", "lib/same.py": b"1"})
    assert folder.sync({"actions/Go.py": b"2", "actions/New.py": b"1", "lib/same.py": b"1"}) == Sync(
        created=("actions/New.py",), changed=("actions/Go.py",), deleted=("actions/Old.py",)
    )
    assert (folder.files / "actions/Go.py").read_bytes() == b"2"


def test_the_library_is_made_once_and_holds_engine_and_messages(folder):
    assert library() == library()
    assert (library() / "tree_gardener" / "ports.py").is_file()
    assert (library() / "geometry_msgs" / "msg" / "__init__.pyi").is_file()
    assert [p.name for p in library().parent.iterdir() if p.name.startswith("library-")] == [library().name]


def test_a_deleted_project_leaves_nothing(folder):
    folder.sync({"a.py": b"1"})
    folder.remove()
    assert not folder.home.exists()
