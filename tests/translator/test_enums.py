"""`enums.json`: reading, errors at their lines, and what the rest of the house makes of it."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest
from pydantic import ValidationError

from translator import check, from_xml, load, self_contained, to_app_zip, to_ros2_package, to_xml
from translator.archive import read_zip
from translator.enums import EnumsDocument, constants, enum_lines, enums_text, read_enums, with_enums
from tree_gardener import Tree

if TYPE_CHECKING:
    from translator.project import Project

COLOR = {"Color": {"RED": 0, "GREEN": 7}}
ACTION = """
import py_trees

from tree_gardener import Port, get_input


class Paint(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"color": Port("Color", default="RED")}

    def update(self):
        self.seen = get_input(self, "color")
        return py_trees.common.Status.SUCCESS
"""


def project(ports: dict[str, str], enums: str | None = None, code: str = "c := GREEN") -> Project:
    nodes = {
        "r": {"type": "Sequence", "children": ["s", "p"]},
        "s": {"type": "Script", "ports": {"code": code}},
        "p": {"type": "Paint", "ports": ports},
    }
    tree = {"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "r", "nodes": nodes}
    files = {"project.json": b"{}", "trees/MainTree.json": json.dumps(tree).encode()}
    files |= {"actions/Paint.py": ACTION.encode()}
    files["enums.json"] = (enums_text(COLOR) if enums is None else enums).encode()
    return load(files)


def written(enums: Any) -> str:
    return json.dumps({"format": "bt-studio/enums", "version": 1, "enums": enums}, indent=2)


@pytest.mark.parametrize(
    ("text", "code", "line"),
    [
        ("[", "BT0001", 1),
        ("[]", "BT0004", 1),
        ("{}", "BT0005", 1),
        ('{"format": "bt-studio/enums",\n"version": 2}', "BT0006", 2),
        ('{"format": "bt-studio/enums", "version": 1,\n"enums": []}', "BT0032", 2),
        (written({"Color": 3}), "BT0032", 5),
        (written({"a b": {}}), "BT0033", 5),
        (written({"int": {}}), "BT0033", 5),
        (written({"Color": {"RED": 0, "true": 1}}), "BT0033", 7),
        (written({"Color": {"RED": 1.5}}), "BT0034", 6),
        (written({"Color": {"RED": True}}), "BT0034", 6),
        (written({"Color": {"RED": 2**31}}), "BT0034", 6),
        (written({"A": {"RED": 1}, "B": {"RED": 2}}), "BT0035", 9),
        (
            '{"format": "bt-studio/enums", "version": 1, "enums": {"A": {"R": 1,\n"G": 2,\n"R": 1}}}',
            "BT0036",
            3,
        ),
        (
            '{"format": "bt-studio/enums", "version": 1, "enums": {"A": {},\n"\\u0041": {"R": 1}}}',
            "BT0036",
            2,
        ),
        ('{"format": "bt-studio/enums",\n"format": "bt-studio/enums", "version": 1}', "BT0036", 2),
    ],
)
def test_what_is_wrong_is_reported_at_its_line(text: str, code: str, line: int) -> None:
    [found] = read_enums(text)[1]
    assert (found.code, found.place.file, found.place.line) == (code, "enums.json", line)
    assert found.is_error
    assert [item.code for item in check(project({}, text, "")) if item.place.file == "enums.json"] == [code]


def test_what_is_right_is_kept_beside_what_is_wrong() -> None:
    enums, [found] = read_enums(written({"Color": {"RED": 0, "no name": 1}, "Gear": {"BACK": -1}}))
    assert enums == {"Color": {"RED": 0}, "Gear": {"BACK": -1}}
    assert constants(enums) == {"RED": 0, "BACK": -1}
    assert found.values["name"] == "no name"


def test_a_name_may_be_in_two_enumerations_with_the_same_number() -> None:
    assert read_enums(written({"A": {"RED": 1}, "B": {"RED": 1}})) == ({"A": {"RED": 1}, "B": {"RED": 1}}, ())


def test_the_schema_accepts_what_is_read() -> None:
    EnumsDocument.model_validate_json(enums_text(COLOR))
    with pytest.raises(ValidationError):
        EnumsDocument.model_validate_json(written({"Color": {"a b": 1}}))


def test_a_port_of_an_enumeration_has_its_names() -> None:
    made = project({"color": "GREEN"})
    assert made.actions["Paint"].ports[0].type == "Color[RED;GREEN]"
    assert check(made) == ()
    assert with_enums(made.actions["Paint"], {}) is made.actions["Paint"]
    assert 'type="Color"' in to_xml(made)
    [found] = check(project({"color": "BLUE"}))
    assert (found.code, found.values["wanted"]) == ("BT0204", "one of RED, GREEN")


def test_scripts_know_the_names() -> None:
    assert check(project({"color": "{c}"}, code="c := GREEN == 7 ? RED : GREEN")) == ()
    unknown, found = check(project({"color": "{c}"}, written({}), "c := GREEN"))
    assert unknown.code == "BT0616"
    assert (found.code, found.values["key"]) == ("BT0401", "GREEN")


def test_a_program_brings_them_along() -> None:
    made = project({"color": "{c}"})
    text = self_contained(made)
    tree = Tree.from_xml(text)
    tree.tick_once()
    assert tree.nodes[2].behaviour.seen == 7
    assert "\n".join(enum_lines(COLOR)) in text
    assert list(enum_lines({})) == []
    package = to_ros2_package(made, name="painter").files["painter/trees/painter.xml"].decode()
    app = read_zip(to_app_zip(made))["self_contained_tree.xml"].decode()
    assert "<Enums>" in package
    assert "<Enums>" in app


def test_a_self_contained_document_makes_the_file_again() -> None:
    again = from_xml(self_contained(project({})), file="tree.xml")
    assert again.files["enums.json"].decode() == enums_text(COLOR)
    assert again.enums == COLOR


def test_a_bad_number_of_a_document_is_reported() -> None:
    text = self_contained(project({})).replace('value="7"', 'value="seven"')
    assert "BT0034" in [found.code for found in from_xml(text, file="tree.xml").diagnostics]
