"""Projects of JdeRobot's BT Studio, in the layouts of all three eras."""

from __future__ import annotations

import json

import pytest

from tests.fakes.jderobot_projects import write_wanderer
from tests.fakes.react_diagrams import chain
from translator import TranslatorError, check, open_files
from translator.archive import read_folder
from translator.jderobot.project import import_jderobot, is_jderobot_project

ACTION = b"import py_trees\n\nclass Forward(py_trees.behaviour.Behaviour):\n    def update(self): pass\n"
MAIN = chain("Sequence", "Patrol").to_bytes()
SUBTREE = chain("Forward").to_bytes()

ERAS = {
    "first": {"graph.json": chain("Sequence", "Forward").to_bytes(), "actions/Forward.py": ACTION},
    "second": {
        "code/trees/main.json": MAIN,
        "code/trees/subtrees/json/Patrol.json": SUBTREE,
        "code/actions/Forward.py": ACTION,
    },
    "third": {
        "code/trees/main.json": MAIN,
        "code/trees/subtrees/Patrol.json": SUBTREE,
        "code/actions/Forward.py": ACTION,
        "config.json": b'{"name": "My robot", "config": {"btOrder": "top-to-bottom"}}',
    },
}


@pytest.mark.parametrize("era", ERAS)
@pytest.mark.parametrize("folder", ["", "my_project/"])
def test_every_era_is_read(era, folder):
    files = {f"{folder}{path}": raw for path, raw in ERAS[era].items()}
    project = open_files(files, name="given")
    assert not [item for item in check(project) if item.is_error]
    assert set(project.trees) == ({"MainTree"} if era == "first" else {"MainTree", "Patrol"})
    assert project.files["actions/Forward.py"] == ACTION
    assert project.settings.on_finish == "repeat"
    assert project.settings.name == ("My robot" if era == "third" else "my_project" if folder else "given")


def test_actions_that_are_missing_get_stubs():
    project = import_jderobot({"graph.json": chain("Sequence", "Nothing").to_bytes()})
    assert [item.code for item in check(project)] == ["BT0613"]


def test_names_that_cannot_be_ids_are_changed():
    files = {
        "code/trees/main.json": chain("My patrol").to_bytes(),
        "code/trees/subtrees/My patrol.json": SUBTREE,
    }
    project = import_jderobot(files)
    assert set(project.trees) == {"MainTree", "My_patrol"}
    assert [item.code for item in project.diagnostics] == ["BT0809"]
    assert not [item for item in check(project) if item.is_error]


def test_unknown_order_is_reported():
    files = {**ERAS["first"], "config.json": json.dumps({"config": {"btOrder": "sideways"}}).encode()}
    assert [item.code for item in import_jderobot(files).diagnostics] == ["BT0808"]


def test_other_files_become_assets():
    files = {**ERAS["first"], "models/net.onnx": b"net", "actions/helper.txt": b"x"}
    project = import_jderobot(files)
    assert project.files["assets/models/net.onnx"] == b"net"
    assert project.files["actions/helper.txt"] == b"x"


def test_what_is_no_project_is_refused():
    assert not is_jderobot_project({"graph.json": b"{}"})
    with pytest.raises(TranslatorError) as error:
        import_jderobot({"readme.md": b""})
    assert error.value.diagnostics[0].code == "BT0800"
    with pytest.raises(TranslatorError):
        import_jderobot({"graph.json": b'{"layers": []}'})


def test_an_order_that_leaves_a_branch_out_is_said_with_the_one_that_does_not(tmp_path):
    wrong, right = (
        read_folder(write_wanderer(tmp_path / order, order)) for order in ("top-to-bottom", "bottom-to-top")
    )
    [found] = [item for item in import_jderobot(wrong).diagnostics if item.code == "BT0811"]
    assert (found.values["child"], found.values["elder"]) == ("ReactiveFallback", "Advance")
    assert "--order bottom-to-top" in found.hint
    for project in (open_files(wrong, order="bottom-to-top"), import_jderobot(right)):
        assert not {"BT0114", "BT0118", "BT0811"} & {item.code for item in check(project)}
