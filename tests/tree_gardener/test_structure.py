"""The shape of documents."""

from __future__ import annotations

from tree_gardener.document import parse_document
from tree_gardener.registry import build_registry
from tree_gardener.structure import StructureCheck, name_problem, type_of


def codes(body: str) -> list[str]:
    document = parse_document(f'<root BTCPP_format="4"><BehaviorTree ID="A">{body}</BehaviorTree></root>')
    check = StructureCheck(document, build_registry({}))
    check.run()
    return [problem.code for problem in check.problems]


def test_a_sound_tree_has_no_problem() -> None:
    assert codes("<Sequence><AlwaysSuccess/></Sequence>") == []


def test_unknown_nodes_and_counts_of_children_are_reported() -> None:
    assert len(codes("<Sequenze><AlwaysSuccess/></Sequenze>")) == 1
    assert len(codes("<Inverter><AlwaysSuccess/><AlwaysSuccess/></Inverter>")) == 1
    assert len(codes("<AlwaysSuccess/><AlwaysSuccess/>")) == 1


def test_the_type_of_an_explicit_node_is_its_id() -> None:
    root = parse_document('<root><Action ID="Go"/><Go/></root>').root
    assert [type_of(child) for child in root.children] == ["Go", "Go"]
    assert name_problem("Go") == ""
    assert name_problem("a/b")
