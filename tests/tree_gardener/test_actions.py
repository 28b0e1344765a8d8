"""Actions from sources: embedded, in a folder, importing one another, and broken."""

from __future__ import annotations

import importlib
import linecache
import sys
from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.trees import subtree
from tree_gardener import LoadError, Status, TickError, Tree
from tree_gardener.actions import load_actions

if TYPE_CHECKING:
    from pathlib import Path

HEAD = "import py_trees\nfrom py_trees.common import Status\n\n"
GO = f"""{HEAD}class Go(py_trees.behaviour.Behaviour):
    def update(self):
        return Status.SUCCESS
"""
CRASH = f"""{HEAD}class Crash(py_trees.behaviour.Behaviour):
    def update(self):
        return self.missing
"""


def test_a_self_contained_document_needs_nothing_else() -> None:
    code = f'<Code><Action name="Go" sha256=""><![CDATA[{GO}]]></Action></Code>'
    text = f"<root>{subtree('M', '<Go/>')}{code}</root>"
    assert Tree.from_xml(text).tick_once() is Status.SUCCESS


def test_the_older_form_is_indented_and_the_name_of_its_root_is_refused() -> None:
    source = "".join(f"      {line}\n" for line in GO.splitlines()).replace("<", "&lt;")
    text = f'<root name="Tree Root"><BehaviorTree><Go/></BehaviorTree><Code><Go>\n{source}</Go></Code></root>'
    assert Tree.from_xml(text).tick_once() is Status.SUCCESS
    with pytest.raises(LoadError) as refused:
        Tree.from_xml(text.replace("<root", "<Root").replace("</root", "</Root"))
    assert [problem.code for problem in refused.value.diagnostics] == ["TG201"]


def test_classes_that_are_given_go_before_the_documents() -> None:
    text = f"<root>{subtree('M', '<Go/>')}<Code><Action name='Go'>this is no Python</Action></Code></root>"
    assert Tree.from_xml(text, load_actions({"Go": GO})).tick_once() is Status.SUCCESS


def test_tracebacks_name_the_file_that_the_user_knows() -> None:
    tree = Tree.from_xml(f"<root>{subtree('M', '<Crash/>')}</root>", load_actions({"Crash": CRASH}))
    with pytest.raises(TickError) as raised:
        tree.tick_once()
    assert (raised.value.file, raised.value.line) == ("actions/Crash.py", 6)
    assert "return self.missing" in raised.value.traceback_text
    assert linecache.getline("actions/Crash.py", 4).startswith("class Crash")


def test_a_folder_of_actions_that_import_one_another(tmp_path: Path) -> None:
    (tmp_path / "__init__.py").write_text("raise SystemExit")
    (tmp_path / "Go.py").write_text(GO)
    (tmp_path / "Again.py").write_text("from actions.Go import Go\n\nclass Again(Go):\n    pass\n")
    (tmp_path / "Alias.py").write_text("import tree_tools\nfrom Go import Go\n\nclass Alias(Go):\n    pass\n")
    classes = load_actions(tmp_path)
    assert sorted(classes) == ["Again", "Alias", "Go"]
    assert issubclass(classes["Again"], classes["Go"])
    assert issubclass(classes["Alias"], classes["Go"])


def test_an_action_whose_folder_is_in_pythons_path_is_run_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "actions"
    folder.mkdir()
    (folder / "Go.py").write_text(GO)
    (folder / "Alias.py").write_text("from Go import Go\n\nclass Alias(Go):\n    pass\n")
    (folder / "shelve.py").write_text("raise SystemExit")
    monkeypatch.syspath_prepend(tmp_path)
    sys.path.append(str(folder))
    for _ in range(2):  # another set of actions has modules of its own
        classes = load_actions(folder, only=("Alias", "Go"))
        assert issubclass(classes["Alias"], classes["Go"])
        assert sys.modules["Go"] is sys.modules["actions.Go"]
    assert importlib.import_module("shelve").__name__ == "shelve"  # Python's own module goes first
    load_actions({})
    assert {"Go", "actions.Go"}.isdisjoint(sys.modules)


@pytest.mark.parametrize(
    ("source", "code", "line"),
    [
        ("class X(\n", "TG612", 1),
        ("\0", "TG612", 0),
        (f"{HEAD}\nimport no_such_module\n", "TG613", 5),
        (f"{HEAD}def helper():\n    raise ValueError('no')\n\nhelper()\n", "TG613", 5),
        ("Y = 1\n", "TG611", 1),
    ],
)
def test_a_broken_source_is_located(source: str, code: str, line: int) -> None:
    with pytest.raises(LoadError) as refused:
        load_actions({"X": source, "Go": GO})
    (problem,) = refused.value.diagnostics
    assert (problem.code, problem.file, problem.node) == (code, "actions/X.py", "X")
    assert problem.line == line or code == "TG612"
