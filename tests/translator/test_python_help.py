"""The environment of a language server, and the sources outside of a project that a page may read."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from translator.python_help import MAX_BYTES, environment_of, read_source, source_roots


@pytest.fixture
def library(tmp_path):
    """A folder of modules with a link to a package, beside a file that is nobody's business."""
    engine = tmp_path / "engine"
    engine.mkdir()
    (engine / "node.py").write_text("class Node: pass\n")
    (tmp_path / "secret.py").write_text("secret\n")
    folder = tmp_path / "library"
    folder.mkdir()
    (folder / "engine").symlink_to(engine, target_is_directory=True)
    (folder / "stub.pyi").write_text("x: int\n")
    return folder


def test_each_folder_has_a_label(tmp_path, library):
    roots = source_roots(tmp_path / "home", library)
    assert Path(json.__file__).is_relative_to(roots["python"])
    assert Path(pytest.__file__).is_relative_to(roots["packages"])
    assert roots["modules"] == str(library)
    assert roots["modules/engine"] == str(tmp_path / "engine")
    assert roots["typeshed"].startswith(f"{tmp_path}/home/")


def test_python_below_the_folders_is_read(tmp_path, library):
    roots = source_roots(tmp_path / "home", library).values()
    assert read_source(f"{library}/stub.pyi", roots) == "x: int\n"
    assert read_source(f"{library}/engine/node.py", roots) == "class Node: pass\n"
    assert "def join" in read_source(os.path.__file__, roots)


def test_nothing_else_is_read(tmp_path, library):
    (library / "out.py").symlink_to(tmp_path / "secret.py")
    (library / "round.py").symlink_to(library / "round.py")
    (library / "data.txt").write_text("x")
    (library / "folder.py").mkdir()
    (library / "huge.py").write_bytes(b"#" * (MAX_BYTES + 1))
    roots = (str(library), str(tmp_path / "none"))
    names = ("out.py", "round.py", "data.txt", "folder.py", "huge.py", "none.py", "../secret.py", "a\0.py")
    assert [read_source(f"{library}/{name}", roots) for name in names] == [None] * len(names)
    assert read_source("/etc/passwd", roots) is None


def test_without_a_library_there_are_the_other_folders(tmp_path):
    roots = source_roots(tmp_path, tmp_path / "none")
    assert set(roots) == {"python", "packages", "typeshed", "modules"}


def test_a_language_server_sees_no_variable_of_its_starter(tmp_path, monkeypatch):
    monkeypatch.setenv("BT_STUDIO_SECRET_KEY", "secret")
    environment = environment_of(tmp_path)
    assert environment["HOME"] == str(tmp_path)
    assert not any(name.startswith("BT_STUDIO") for name in environment)
