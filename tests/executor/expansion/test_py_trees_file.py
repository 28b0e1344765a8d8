"""A behaviour is described by its class and the arguments that Python can write."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType

import py_trees
import pytest

from executor.expansion.py_trees_file import describe, loaded_beside


def test_a_tree_is_described_with_its_children() -> None:
    child = py_trees.behaviours.Success("a")
    found = describe(py_trees.decorators.Inverter("not", child))
    assert (found["module"], found["class"], found["kind"]) == (
        "py_trees.decorators",
        "Inverter",
        "decorator",
    )
    assert [(each["class"], each["kind"], each["name"]) for each in found["children"]] == [
        ("Success", "leaf", "a")
    ]


def test_a_class_that_no_module_holds_has_no_module() -> None:
    class Local(py_trees.behaviours.Success):
        """Can be imported from nowhere."""

    assert describe(Local("l"))["module"] == ""


@pytest.mark.parametrize("composite", [py_trees.composites.Sequence, py_trees.composites.Selector])
def test_composites_are_no_leaves(composite: type) -> None:
    assert describe(composite("c", True))["kind"] == "composite"


def test_an_environment_beside_the_file_is_not_of_its_modules(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for path in ("tree_of_test.py", "speeds_of_test.py", ".venv/lib/fast_of_test.py"):
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text("")
        module = ModuleType(Path(path).stem)
        module.__file__ = str(tmp_path / path)
        monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.setattr(sys, "prefix", str(tmp_path / ".venv"))
    found = {path.name for path in loaded_beside(tmp_path / "tree_of_test.py")}
    assert found == {"tree_of_test.py", "speeds_of_test.py"}
