"""Sources outside of a project: on localhost, and in a container, by the same rules."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from backend.language import sources
from executor.tools import sources as contained

BOTH = pytest.mark.parametrize("module", [sources, contained], ids=["localhost", "container"])


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


@BOTH
def test_each_folder_has_a_label(module, tmp_path, library):
    roots = module.source_roots(tmp_path / "home", library)
    assert Path(json.__file__).is_relative_to(roots["python"])
    assert Path(pytest.__file__).is_relative_to(roots["packages"])
    assert roots["modules"] == str(library)
    assert roots["modules/engine"] == str(tmp_path / "engine")
    assert roots["typeshed"].startswith(f"{tmp_path}/home/")


@BOTH
def test_python_below_the_folders_is_read(module, tmp_path, library):
    roots = module.source_roots(tmp_path / "home", library).values()
    assert module.read_source(f"{library}/stub.pyi", roots) == "x: int\n"
    assert module.read_source(f"{library}/engine/node.py", roots) == "class Node: pass\n"
    assert "def join" in module.read_source(os.path.__file__, roots)


@BOTH
def test_nothing_else_is_read(module, tmp_path, library):
    (library / "out.py").symlink_to(tmp_path / "secret.py")
    (library / "round.py").symlink_to(library / "round.py")
    (library / "data.txt").write_text("x")
    (library / "folder.py").mkdir()
    (library / "huge.py").write_bytes(b"#" * (module.MAX_BYTES + 1))
    roots = (str(library), str(tmp_path / "none"))
    names = ("out.py", "round.py", "data.txt", "folder.py", "huge.py", "none.py", "../secret.py", "a\0.py")
    assert [module.read_source(f"{library}/{name}", roots) for name in names] == [None] * len(names)
    assert module.read_source("/etc/passwd", roots) is None
