"""Files of `actions/` that actions import go along, and those that are missing are reported."""

import pytest

from translator import load
from translator.check import check
from translator.diagnostic import TranslatorError
from translator.export import self_contained
from translator.importer import from_xml
from translator.jderobot.self_contained import write_old_form
from translator.shared_modules import imports_of, shared_modules, sources_of
from tree_gardener.status import SUCCESS
from tree_gardener.tree import Tree

ACTION = """{imports}
import py_trees


class Go(py_trees.behaviour.Behaviour):
    def update(self):
        return py_trees.common.Status.SUCCESS if {value} == 4 else py_trees.common.Status.FAILURE
"""
TREE = b"""<root BTCPP_format="4"><BehaviorTree ID="MainTree"><Action ID="Go"/></BehaviorTree></root>"""


def project(imports: str, value: str = "twice(2)", **modules: str):
    go = ACTION.format(imports=imports, value=value).encode()
    files = dict(from_xml(TREE, actions={"Go.py": go}).files)
    files.update({f"actions/{name}.py": text.encode() for name, text in modules.items()})
    return load(files)


HELPER = "def twice(number):\n    return 2 * number\n"


@pytest.mark.parametrize(
    ("imports", "value"),
    [
        ("from actions.helper import twice", "twice(2)"),
        ("from helper import twice", "twice(2)"),
        ("from actions import helper", "helper.twice(2)"),
        ("from . import helper", "helper.twice(2)"),
        ("from .helper import twice", "twice(2)"),
        ("import actions.helper", "actions.helper.twice(2)"),
    ],
)
def test_a_module_that_no_block_uses_runs_where_an_action_imports_it(imports, value):
    found = project(imports, value, helper=HELPER, unused="raise RuntimeError")
    assert [each for each in check(found) if each.severity == "error"] == []
    text = self_contained(found)
    assert '<Module name="helper"' in text
    assert "unused" not in text
    tree = Tree.from_xml(text)
    assert tree.tick_exactly_once() is SUCCESS


def test_modules_import_modules_and_other_actions():
    chain = {"helper": "from actions._base import twice\nfrom actions.Other import OTHER\n", "_base": HELPER}
    other = (
        "OTHER = 1\nimport py_trees\nclass Other(py_trees.behaviour.Behaviour):\n    def update(self): ...\n"
    )
    found = project("from actions.helper import twice", **chain, Other=other)
    assert [module.name for module in shared_modules(found, ["Go"])] == ["Other", "_base", "helper"]
    assert Tree.from_xml(self_contained(found)).tick_exactly_once() is SUCCESS
    assert set(sources_of(found)) == {"Go", "helper", "_base", "Other"}


def test_a_ring_of_imports_ends():
    found = project("import actions.a", "4", a="import actions.b", b="import actions.a")
    assert [module.name for module in shared_modules(found, ["Go"])] == ["a", "b"]


def test_an_import_that_finds_no_file_is_an_error_with_its_line():
    found = project("\nfrom actions.helper import twice", helper="import actions.base")
    assert [
        (each.code, each.place.file, each.place.line) for each in check(found) if each.code == "BT0621"
    ] == [("BT0621", "actions/helper.py", 1)]
    lost = project("\nfrom actions.helper import twice")
    assert [(each.place.file, each.place.line) for each in check(lost) if each.code == "BT0621"] == [
        ("actions/Go.py", 2)
    ]


def test_an_import_that_may_fail_or_be_a_library_is_no_error():
    tried = "try:\n    from actions.helper import twice\nexcept ImportError:\n    twice = lambda number: 4"
    found = project(f"import math\nimport numpy\n{tried}")
    assert [each.code for each in check(found) if each.is_error] == []
    assert Tree.from_xml(self_contained(found)).tick_exactly_once() is SUCCESS


def test_what_cannot_be_read_imports_nothing():
    assert imports_of("def") == ()
    assert [found.name for found in imports_of("import os.path, actions.x.y")] == ["os", "x"]


def test_the_form_of_2024_refuses_modules():
    with pytest.raises(TranslatorError, match="modules that actions share"):
        write_old_form(project("from actions.helper import twice", helper=HELPER))
