"""Which modules exist, and which names they have; none of them is imported."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import pytest

from translator.check.sources.modules import Modules, installed, is_installed

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of Python's path with the package `bts_made`, which must not be imported."""
    folder = tmp_path / "bts_made"
    (folder / "inner").mkdir(parents=True)
    (folder / "__init__.py").write_text("import nothing\nraise SystemExit\n")
    (folder / "leaf.py").write_text(
        "class Here: ...\ndef there(): ...\nX = Y = 1\nfrom os import path as p\n"
    )
    (folder / "moving.py").write_text("def __getattr__(name): ...\n")
    (folder / "starred.py").write_text("from os import *\n")
    (folder / "broken.py").write_text("def\n")
    monkeypatch.syspath_prepend(tmp_path)
    return folder


@pytest.mark.usefixtures("package")
def test_names_are_read_without_an_import() -> None:
    modules = Modules({})
    leaf = modules.find("bts_made.leaf")
    assert leaf is not None
    assert leaf.names is not None
    assert {"Here", "there", "X", "Y", "p"} <= leaf.names.names
    assert "os" not in leaf.names.names
    for name in ("moving", "starred", "broken", "inner"):
        found = modules.find(f"bts_made.{name}")
        assert found is not None
        assert found.names is None
    assert modules.find("bts_made.other") is None
    assert is_installed("bts_made")
    assert "bts_made" not in sys.modules


def test_modules_of_a_project_are_its_own() -> None:
    modules = Modules(
        {"actions/helper.py": b"X = 1", "tools/a.py": b"", "root.py": b"", "actions/sub/b.py": b""}
    )
    assert all(
        modules.is_own(name) for name in ("helper", "tools", "root", "sub", "actions", "tree_gardener")
    )
    assert not modules.is_own("a")
    assert modules.has_action("helper")
    assert modules.has_action("sub")
    assert not modules.has_action("other")
    helper = modules.find("actions.helper")
    assert helper is not None
    assert helper.names is not None
    assert "X" in helper.names.names
    assert modules.find("tools.a") is None


def test_lists_of_the_target() -> None:
    modules = Modules({"requirements.txt": b"My-Package==1\n", "package.xml": b"<depend>my_msgs</depend>"})
    listed = ("my_package", "my_msgs", "numpy", "nav2_msgs.action", "pybullet_data")
    assert all(modules.is_listed(name) for name in listed)
    assert not modules.is_listed("no_such_package")
    assert modules.has_requirements


def test_very_many_modules_are_not_all_looked_up() -> None:
    modules = Modules({})
    for number in range(400):
        assert modules.find(f"py_trees.no_{number}") is None
    assert modules.find("py_trees.common") is None


def test_enumerations_have_members() -> None:
    common = Modules({}).find("py_trees.common")
    assert common is not None
    assert common.names is not None
    assert {"SUCCESS", "FAILURE", "RUNNING", "INVALID"} <= common.names.enums["Status"]


def test_modules_without_a_file() -> None:
    assert is_installed("sys")
    found = installed("sys")
    assert found is not None
    assert (found.names, found.child("x"), found.has_child("x")) == (None, None, False)
    assert installed("no_such_package") is None
    assert not is_installed("no_such_package")
