"""Limits of a project: one table, used by all code, and enforced by all readers."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import translator
from backend.config.environment import Environment
from executor.manager import archive as manager_archive
from translator import limits, project, reference
from translator.tree_text import read_tree_text, write_tree_text
from tree_gardener import document as engine

ROOT = Path(__file__).parents[2]


def files_of(*sizes):
    """A project with trees of so many nodes."""
    files = {"project.json": json.dumps({"main_tree": "T0"}).encode()}
    for number, size in enumerate(sizes):
        leaves = {f"n{n}": {"type": "AlwaysSuccess"} for n in range(size - 1)}
        nodes = {"r": {"type": "Sequence", "children": list(leaves)}, **leaves}
        files[f"trees/T{number}.json"] = json.dumps(
            {"format": "bt-studio/diagram", "version": 1, "id": f"T{number}", "root": "r", "nodes": nodes}
        ).encode()
    return files


def codes(files):
    return [found.code for found in translator.check(translator.load(files)) if found.is_error]


@pytest.fixture
def small(monkeypatch):
    monkeypatch.setattr(limits, "NODES_PER_TREE", 5)
    monkeypatch.setattr(limits, "NODES_PER_PROJECT", 12)
    monkeypatch.setattr(limits, "TREES_PER_PROJECT", 4)


@pytest.mark.parametrize(
    ("sizes", "found"),
    [((5, 5), []), ((6,), ["BT0017"]), ((5, 5, 5), ["BT0018"]), ((2, 2, 2, 2, 2), ["BT0019"])],
)
def test_what_is_too_large_is_said_with_its_place_and_keeps_it_from_being_translated(small, sizes, found):
    files = files_of(*sizes)
    assert codes(files) == found
    loaded = translator.load(files)
    for item in translator.check(loaded):
        if item.code in limits.OVERSIZE:
            assert item.place.file
            assert item.hint
    if found:
        with pytest.raises(translator.TranslatorError):
            translator.to_xml(loaded)
        with pytest.raises(translator.TranslatorError):
            translator.to_app_zip(loaded)


def test_diagrams_that_are_too_many_bytes_are_not_even_read(monkeypatch):
    monkeypatch.setattr(project, "DIAGRAM_BYTES_PER_PROJECT", 100)
    monkeypatch.setattr(project, "_load_trees", lambda *_: pytest.fail("they were read"))
    assert codes(files_of(3)) == ["BT0019"]
    monkeypatch.setattr(project, "DIAGRAM_BYTES_PER_PROJECT", 10_000)
    monkeypatch.setattr(project, "TREES_PER_PROJECT", 1)
    assert codes(files_of(3, 3)) == ["BT0019"]


def test_xml_is_not_made_a_project_that_is_too_large(small):
    leaves = "<AlwaysSuccess/>" * 5
    xml = f'<root BTCPP_format="4"><BehaviorTree ID="A"><Sequence>{leaves}</Sequence></BehaviorTree></root>'
    with pytest.raises(translator.TranslatorError) as caught:
        translator.from_xml(xml)
    assert [found.code for found in caught.value.diagnostics] == ["BT0017"]


def test_a_text_beside_the_canvas_has_no_more_nodes_either(small):
    tree = translator.load(files_of(5)).trees["T0"]
    text = write_tree_text(tree)
    more = text.xml.replace("<AlwaysSuccess", "<AlwaysFailure/><AlwaysSuccess", 1)
    with pytest.raises(translator.TranslatorError) as caught:
        read_tree_text(more, tree)
    assert caught.value.diagnostics[0].code == "BT0017"
    with pytest.raises(translator.TranslatorError):
        write_tree_text(translator.load(files_of(6)).trees["T0"])


def test_the_largest_project_is_within_all_limits_of_those_that_take_it_on():
    """The engine, the manager and the server's settings do not refuse a project within the limits."""
    assert limits.NODES_PER_PROJECT < engine.MAX_ELEMENTS
    assert limits.XML_BYTES <= engine.MAX_BYTES
    assert limits.NODES_PER_PROJECT <= limits.XML_ELEMENTS
    assert limits.FILES_PER_PROJECT <= manager_archive.MAX_FILES
    assert limits.FILE_BYTES <= manager_archive.MAX_FILE_BYTES
    assert limits.PROJECT_BYTES <= manager_archive.MAX_TOTAL_BYTES
    assert limits.DIAGRAM_BYTES_PER_PROJECT <= limits.PROJECT_BYTES
    defaults = {name: field.default for name, field in Environment.model_fields.items()}
    assert defaults["max_file_bytes"] == limits.FILE_BYTES
    assert defaults["max_project_bytes"] == limits.PROJECT_BYTES
    assert defaults["max_project_files"] == limits.FILES_PER_PROJECT


def test_no_module_of_the_translator_has_a_bound_of_its_own():
    own = re.compile(r"^(MAX_\w+)\s*(?::\s*Final)?\s*=\s*\d", re.MULTILINE)
    found = {
        (path.name, name)
        for path in (ROOT / "translator").rglob("*.py")
        for name in own.findall(path.read_text(encoding="utf-8"))
    }
    # Of ROS package names, of BehaviorTree.CPP's integers and of files of this machine, not of what is taken
    # from strangers.
    assert found == {
        ("naming.py", "MAX_LENGTH"),
        ("python_help.py", "MAX_BYTES"),
        ("script_names.py", "MAX_INTEGER"),
    }


def test_the_front_end_has_the_same_numbers():
    assert reference.SOURCE.read_text(encoding="utf-8") == reference.limits_source()
