"""Trees in several files: registered one by one, included, and in packages."""

from __future__ import annotations

import pytest

from translator import TranslatorError
from translator.export import export_files
from translator.opening import open_files
from translator.xml.includes import tree_files


def tree(tree_id: str, inside: str = "<AlwaysSuccess/>", root: str = "", before: str = "") -> bytes:
    return (
        f'<root BTCPP_format="4" {root}>{before}<BehaviorTree ID="{tree_id}">{inside}</BehaviorTree></root>'
    ).encode()


def call(tree_id: str) -> str:
    return f'<SubTree ID="{tree_id}"/>'


def manifest(name: str) -> bytes:
    return f'<?xml version="1.0"?><package format="3"><name> {name} </name></package>'.encode()


REGISTERED = {
    "trees_of_a/arm.xml": tree("Arm"),
    "trees_of_a/base.xml": tree("Base", call("Arm")),
    "whole.xml": tree("Whole", f"<Sequence>{call('Base')}{call('Arm')}</Sequence>"),
}


def codes(found):
    return [item.code for item in found]


def refused(files, main=""):
    with pytest.raises(TranslatorError) as caught:
        open_files(files, main=main)
    return caught.value.diagnostics


def test_files_that_a_program_registers_are_one_project() -> None:
    project = open_files(REGISTERED, name="robot")
    assert set(project.trees) == {"Arm", "Base", "Whole"}
    assert (project.settings.main_tree, project.settings.name) == ("Whole", "robot")
    assert project.diagnostics == ()
    assert export_files(project) == REGISTERED


def test_the_main_tree_is_chosen_where_several_could_be() -> None:
    files = {**REGISTERED, "other.xml": tree("Other")}
    found = refused(files)
    assert codes(found) == ["BT0924", "BT0924"]
    assert {item.values["choice"]: item.place.file for item in found} == {
        "Other": "other.xml",
        "Whole": "whole.xml",
    }
    assert open_files(files, main="Other").settings.main_tree == "Other"
    assert set(open_files(files, main="other.xml").trees) == {"Other"}
    (unknown,) = refused(files, main="Nobody")
    assert (unknown.code, unknown.values["choices"]) == ("BT0727", "Other, Whole")


def test_a_file_that_names_its_main_tree_decides() -> None:
    files = {
        **REGISTERED,
        "spare.xml": tree("Spare"),
        "whole.xml": tree("Whole", root='main_tree_to_execute="Whole"'),
    }
    assert open_files(files).settings.main_tree == "Whole"


def test_main_trees_of_one_id_are_chosen_by_their_file() -> None:
    files = {"a.xml": tree("MainTree"), "b.xml": tree("MainTree", "<AlwaysFailure/>")}
    assert [item.values["choice"] for item in refused(files)] == ["a.xml", "b.xml"]
    chosen = open_files(files, main="a.xml")
    assert [node.type for node in chosen.trees["MainTree"].walk()] == ["AlwaysSuccess"]


def test_of_trees_with_one_id_the_last_one_is_used_and_said() -> None:
    files = {**REGISTERED, "trees_of_b/arm.xml": tree("Arm", "<AlwaysFailure/>")}
    project = open_files(files)
    assert [node.type for node in project.trees["Arm"].walk()] == ["AlwaysFailure"]
    (found,) = project.diagnostics
    assert (found.code, found.place.file) == ("BT0726", "imports/trees_of_a/arm.xml")
    assert dict(found.values) == {"id": "Arm", "other": "trees_of_b/arm.xml"}
    assert export_files(project) == files


def test_a_document_replaces_the_trees_that_it_includes() -> None:
    files = {
        "main.xml": tree(
            "Main", call("Arm"), before='<include path="lib/one.xml"/><include path="lib/two.xml"/>'
        )
        .replace(b"</root>", b'<BehaviorTree ID="Own"><AlwaysSuccess/></BehaviorTree></root>')
        .replace(call("Arm").encode(), f"<Sequence>{call('Arm')}{call('Own')}</Sequence>".encode()),
        "lib/one.xml": tree("Arm", "<AlwaysFailure/>"),
        "lib/two.xml": tree("Arm").replace(
            b"</root>", b'<BehaviorTree ID="Own"><AlwaysFailure/></BehaviorTree></root>'
        ),
    }
    project = open_files(files)
    assert [node.type for node in project.trees["Arm"].walk()] == ["AlwaysSuccess"]
    assert [node.type for node in project.trees["Own"].walk()] == ["AlwaysSuccess"]
    assert export_files(project) == files


def test_includes_reach_other_folders_of_what_was_imported() -> None:
    files = {
        "robot/main.xml": tree("Main", call("Lib"), before='<include path="../lib/lib.xml"/>'),
        "lib/lib.xml": tree("Lib"),
    }
    assert set(open_files(files, name="x").trees) == {"Main", "Lib"}
    out = {"robot/main.xml": tree("Main", before='<include path="../../lib.xml"/>')}
    assert codes(open_files(out).diagnostics) == ["BT0732"]


def test_includes_of_packages_are_found_by_their_manifest() -> None:
    include = '<include ros_pkg="libs" path="trees/lib.xml"/>'
    files = {
        "src/robot/package.xml": manifest("robot"),
        "src/robot/trees/main.xml": tree("Main", call("Lib"), before=include),
        "src/folder_of_another_name/package.xml": manifest("libs"),
        "src/folder_of_another_name/trees/lib.xml": tree("Lib"),
    }
    assert tree_files(files) == ["src/folder_of_another_name/trees/lib.xml", "src/robot/trees/main.xml"]
    project = open_files(files)
    assert (set(project.trees), project.diagnostics) == ({"Main", "Lib"}, ())
    del files["src/folder_of_another_name/package.xml"]
    assert "BT0731" in codes(open_files(files).diagnostics)


def test_only_trees_and_models_are_taken_for_trees() -> None:
    files = {
        "package.xml": manifest("a"),
        "robot.urdf.xml": b"<robot/>",
        "models.xml": b'<root BTCPP_format="4"><TreeNodesModel><Action ID="Go"/></TreeNodesModel></root>',
        "tree.xml": tree("T", "<Go/>"),
        "notes.xml": b"no XML",
        "broken.xml": b'<root><BehaviorTree ID="T">',
    }
    assert tree_files(files) == ["broken.xml", "models.xml", "tree.xml"]
    assert codes(refused(files)) == ["BT0701"]
    del files["broken.xml"]
    assert set(open_files(files).actions) == {"Go"}


def test_trees_that_call_each_other_in_a_ring_are_chosen_from() -> None:
    files = {"a.xml": tree("A", call("B")), "b.xml": tree("B", call("A"), root='main_tree_to_execute="B"')}
    assert open_files(files).settings.main_tree == "B"
    files["b.xml"] = tree("B", call("A"))
    assert [item.values["choice"] for item in refused(files)] == ["A", "B"]
