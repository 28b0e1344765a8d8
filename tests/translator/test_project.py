"""Loading projects, their settings, opening what users name, stubs, and the tree's edits."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from tests.fakes.react_diagrams import chain
from tests.translator.conftest import EXAMPLES, ROOT, codes, example_files
from translator import Node, Settings, TranslatorError, Tree, check, inspect_action, load, open_path, to_xml
from translator.package.zip import write_zip
from translator.project import in_worlds_of
from translator.settings import read_settings
from translator.stub import stub_source

XML = '<root BTCPP_format="4"><BehaviorTree ID="T"><Foo speed="1"/></BehaviorTree></root>'


def test_importing_the_translator_brings_neither_ros_nor_django_nor_py_trees():
    code = "import sys, translator; print([m for m in ('py_trees', 'rclpy', 'django') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_public_names_are_there():
    import translator

    assert sorted(translator.__all__) == translator.__all__ or sorted(translator.__all__, key=str.swapcase)
    for name in translator.__all__:
        assert hasattr(translator, name)


def test_the_worlds_and_judges_are_those_of_the_other_version_alone():
    files = {"universes/gone.yaml": b"x", "actions/A.py": b"1", "evaluations/room.yaml": b"old"}
    judge = {"assets/a.png": b"p", "evaluations/room.yaml": b"new", "actions/A.py": b"2"}
    worlds = {"assets/a.png": b"p", "evaluations/room.yaml": b"new"}
    assert in_worlds_of(judge, files) == {"actions/A.py": b"1"} | worlds


def test_nothing_to_load_is_refused():
    with pytest.raises(TranslatorError):
        load({})


def test_broken_files_are_reported_and_the_rest_is_loaded():
    files = example_files(EXAMPLES[0])
    files |= {
        "trees/Bad.json": b"{",
        "trees/Copy.json": files["trees/MainTree.json"],
        "actions/Bad.py": b"\xff",
    }
    project = load(files)
    assert codes(project.diagnostics) == ["BT0001", "BT0015", "BT0002"]
    assert set(project.trees) == {"MainTree"}


def test_tree_in_a_file_of_another_name_is_reported():
    files = {"trees/Other.json": example_files(EXAMPLES[0])["trees/MainTree.json"]}
    assert codes(load(files).diagnostics) == ["BT0016"]
    assert load(files).settings.main_tree == "MainTree"


def test_shared_modules_among_the_actions_are_no_actions():
    files = example_files(EXAMPLES[0]) | {"actions/helpers.py": b"def f(): pass\n"}
    assert check(load(files)) == ()
    assert codes(check(load(files | {"actions/Helpers.py": b"def f(): pass\n"}))) == ["BT0602"]


@pytest.mark.parametrize(
    ("document", "left_out"),
    [
        ({"tick_hz": -1}, ["tick_hz"]),
        ({"tick_hz": "fast", "on_finish": "maybe", "name": 5}, ["tick_hz", "on_finish", "name"]),
        ({"version": 2}, ["version"]),
        ({"maintainer": "me"}, ["maintainer"]),
        ({"future": [1, 2]}, []),
    ],
)
def test_invalid_settings_are_reported_and_get_their_default(document, left_out):
    settings, found = read_settings(json.dumps(document))
    assert codes(found) == ["BT0030"] * len(left_out)
    assert settings == Settings()
    assert all(any(name in item.message for item in found) for name in left_out)


def test_open_path_takes_whatever_a_user_names(tmp_path):
    example = ROOT / "examples" / EXAMPLES[0]
    expected = to_xml(load(example_files(EXAMPLES[0])))
    (tmp_path / "p.zip").write_bytes(
        write_zip({f"top/{k}": v for k, v in example_files(EXAMPLES[0]).items()})
    )
    for path in (example, example / "trees" / "MainTree.json", tmp_path / "p.zip"):
        assert to_xml(open_path(path)) == expected
    (tmp_path / "only").mkdir()
    (tmp_path / "only" / "t.xml").write_text(XML)
    assert to_xml(open_path(tmp_path / "only")) == XML
    (tmp_path / "only" / "main.json").write_bytes(chain("Sequence", "A").to_bytes())
    assert open_path(tmp_path / "only" / "main.json").settings.on_finish == "repeat"
    lonely = tmp_path / "lonely.json"
    lonely.write_bytes(example_files(EXAMPLES[0])["trees/MainTree.json"])
    assert to_xml(open_path(lonely, actions=example / "actions")) == expected


def test_open_path_refuses_the_rest(tmp_path):
    (tmp_path / "a.xml").write_text(XML)
    (tmp_path / "b.xml").write_text(XML)
    (tmp_path / "empty").mkdir()
    refused = ((tmp_path, ["BT0924"] * 2), (tmp_path / "empty", ["BT0923"]), (tmp_path / "no", ["BT0925"]))
    for path, expected in refused:
        with pytest.raises(TranslatorError) as error:
            open_path(path)
        assert codes(error.value.diagnostics) == expected


def test_missing_actions_are_errors_where_no_stubs_are_wanted(tmp_path):
    (tmp_path / "a.xml").write_text(XML)
    assert "BT0102" in codes(check(open_path(tmp_path / "a.xml", stubs=False)))
    assert codes(check(open_path(tmp_path / "a.xml"))) == ["BT0613"]


def test_stub_is_a_sound_action_that_the_checks_point_at():
    source = stub_source("Foo", None, {"b", "a"}, kind="condition")
    model = inspect_action(source, "actions/Foo.py")
    assert (model.diagnostics, model.open, model.kind) == ((), True, "condition")
    assert "a, b" in model.doc


@pytest.fixture
def tree():
    nodes = {
        "r": Node("r", "Sequence", children=("a", "b")),
        "a": Node("a", "Inverter", children=("c",)),
        "b": Node("b", "SubTree", tree="T"),
        "c": Node("c", "Foo"),
    }
    return Tree("T", "r", nodes)


def test_edits_leave_the_tree_as_it_was(tree):
    before = dict(tree.nodes)
    assert [node.id for node in tree.moved("c", parent="r", index=0).walk()] == ["r", "c", "a", "b"]
    assert [node.id for node in tree.removed("a").walk()] == ["r", "b"]
    assert tree.removed("r").root is None
    assert tree.inserted(Node("d", "Bar"), parent="r", index=1).nodes["r"].children == ("a", "d", "b")
    assert tree.parents() == {"a": "r", "b": "r", "c": "a"}
    assert tree.depth() == 3
    assert dict(tree.nodes) == before
    with pytest.raises(ValueError, match="itself"):
        tree.moved("a", parent="c")
