"""Versions of projects, diagrams and XML files."""

from __future__ import annotations

from tests.shared.make_differences import OLDER, changed
from tests.translator.conftest import EXAMPLES, ROOT
from translator import from_xml, load
from translator.archive import read_folder
from translator.difference.projects import (
    Version,
    compare_versions,
    own_ids,
    shapes,
    version_of,
    version_of_tree,
)

XML = (
    '<root BTCPP_format="4"><BehaviorTree ID="T">'
    '<Sequence>{}<Foo speed="1"/><Bar/></Sequence></BehaviorTree></root>'
)


def version(*trees, name="v", **files):
    return Version(
        name, {each["id"]: each for each in trees}, {path: raw.encode() for path, raw in files.items()}
    )


def test_trees_are_paired_by_name_and_files_by_path():
    other = {**OLDER, "id": "Other"}
    third = {**OLDER, "id": "Third"}
    older = version(OLDER, other, same="1", gone="2", edited="3")
    newer = version(changed(a={"name": "x"}), third, same="1", edited="4", fresh="5")
    found = compare_versions(older, newer)
    assert [(each.tree, each.change) for each in found.trees] == [
        ("MainTree", "changed"), ("Other", "removed"), ("Third", "added"),
    ]  # fmt: skip
    assert found.files == {"edited": "changed", "fresh": "added", "gone": "removed"}
    assert {each["op"] for each in found.trees[1].operations} == {"delete"}
    assert [len(each.rows) for each in shapes(found.trees[2])] == [0, len(third["nodes"])]


def test_a_project_and_itself_do_not_differ():
    project = load(read_folder(ROOT / "examples" / EXAMPLES[0]))
    found = compare_versions(version_of(project, "a"), version_of(project, "b"))
    assert found.to_json() == {"format": "bt-studio/difference", "version": 1, "trees": [], "files": []}


def test_two_single_trees_are_compared_under_different_names():
    found = compare_versions(version(OLDER), version({**OLDER, "id": "Copy"}))
    assert [each.operations for each in found.trees] == [
        ({"op": "change", "node": "", "field": "id", "before": "MainTree", "after": "Copy"},)
    ]


def test_numbers_that_the_reader_gave_are_not_trusted():
    one = version_of(from_xml(XML.format("")), "a", is_xml=True)
    other = version_of(from_xml(XML.format("<Baz/>")), "b", is_xml=True)
    (tree,) = compare_versions(one, other).trees
    assert [(each["op"], each["type"]) for each in tree.operations] == [("insert", "Baz")]


def test_ids_of_a_file_are():
    assert own_ids(b"<A _bts_id=\"n7\"/><B _bts_id = 'q'/>") == {"n7", "q"}


def test_a_single_diagram(make_project):
    project = make_project({"n1": {"type": "AlwaysSuccess"}})
    assert version_of_tree(project.trees["MainTree"], "t").trees["MainTree"]["root"] == "n1"
