"""Documents as older programs wrote them are read as they meant."""

from __future__ import annotations

import pytest

from translator import from_xml, to_xml
from translator.opening import open_tree
from translator.xml.read import read_document

LEAF = '<BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree>'
CALL = (
    '<root main_tree_to_execute="M"><BehaviorTree ID="M">'
    '<SubTree ID="Go"><remap internal="target" external="goal"/></SubTree>'
    '</BehaviorTree><BehaviorTree ID="Go"><AlwaysSuccess/></BehaviorTree></root>'
)


def codes(found):
    return [item.code for item in found]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "iso-8859-1"])
def test_blanks_before_the_declaration_do_no_harm(encoding: str) -> None:
    text = f'\n  <?xml version="1.0" encoding="{encoding}"?>\n<root BTCPP_format="4">{LEAF}</root>'
    project = from_xml(text.encode(encoding))
    assert list(project.trees) == ["M"]
    assert to_xml(project) == text


def test_a_declaration_elsewhere_is_still_refused() -> None:
    with pytest.raises(Exception, match="BT0701"):
        from_xml(f'<root BTCPP_format="4"><?xml version="1.0"?>{LEAF}</root>')


@pytest.mark.parametrize(
    ("root", "inside", "is_v4", "found"),
    [
        ('BTCPP_format="4"', LEAF, True, []),
        ('BTCPP_format="4.0"', LEAF, True, []),
        ('BTCPP_format=" 4 "', LEAF, True, []),
        ('BTCPP_format="4.6"', LEAF, True, []),
        ('BTCPP_format="3"', LEAF, False, []),
        ('BTCPP_format="four"', LEAF, False, ["BT0724"]),
        ("", LEAF, False, []),
        ("", '<BehaviorTree ID="M"><Script code="a := 1"/></BehaviorTree>', True, ["BT0723"]),
        ("", '<BehaviorTree ID="M"><A _skipIf="a"/></BehaviorTree>', True, ["BT0723"]),
        ("", '<BehaviorTree ID="M"><Control ID="TryCatch"/></BehaviorTree>', True, ["BT0723"]),
        ("", '<BehaviorTree ID="M"><SequenceStar><Sleep msec="1"/></SequenceStar></BehaviorTree>', False, []),
    ],
)
def test_the_version_of_a_document(root: str, inside: str, is_v4: bool, found: list[str]) -> None:
    document = read_document(f"<root {root}>{inside}</root>", file="a.xml")
    assert document.is_v4 is is_v4
    assert [code for code in codes(document.diagnostics) if code in {"BT0723", "BT0724"}] == found


def test_a_remap_of_version_2_is_a_port_of_the_subtree() -> None:
    project = from_xml(CALL)
    (call,) = project.trees["M"].walk()
    assert (call.type, call.tree, dict(call.ports)) == ("SubTree", "Go", {"target": "{goal}"})
    assert "BT0720" in codes(project.diagnostics)
    assert '<SubTree ID="Go" target="{goal}"/>' in to_xml(project)
    assert "remap" not in to_xml(project)


def test_parameters_of_old_models_are_ports() -> None:
    model = (
        '<TreeNodeModel><Action ID="Go"><Parameter label="goal" type="Text" default="0;0"/></Action>'
        "</TreeNodeModel>"
    )
    document = read_document(f"<root>{LEAF}{model}</root>", file="a.xml")
    port = document.models["Go"].ports["goal"]
    assert (port.direction, port.default) == ("input", "0;0")
    assert codes(document.diagnostics) == ["BT0725"]


def test_of_two_trees_with_one_id_the_last_one_runs() -> None:
    text = f'<root BTCPP_format="4">{LEAF}{LEAF.replace("Success", "Failure")}</root>'
    project = from_xml(text)
    assert [node.type for node in project.trees["M"].walk()] == ["AlwaysFailure"]
    assert [node.type for node in project.trees["M_2"].walk()] == ["AlwaysSuccess"]
    assert project.settings.main_tree == "M"
    (found,) = [item for item in project.diagnostics if item.code == "BT0713"]
    assert dict(found.values) == {"id": "M", "name": "M_2"}
    assert to_xml(project) == text


def test_a_tree_without_a_node_is_said_to_be_empty() -> None:
    project = from_xml('<root BTCPP_format="4"><BehaviorTree ID="M"/></root>')
    assert [item.code for item in project.diagnostics if item.code[:4] == "BT07"] == ["BT0722"]


def test_a_capital_root_of_version_3_is_no_document_of_2024() -> None:
    two = LEAF + LEAF.replace('"M"', '"N"')
    project = open_tree(f'<Root main_tree_to_execute="N">{two}</Root>'.encode(), file="a.xml")
    assert set(project.trees) == {"M", "N"}
    assert project.settings.main_tree == "N"
