"""Documents with `<Root>`: imports read them, write `<root>`, and say so; the engine refuses them."""

from __future__ import annotations

import codecs

import pytest

from translator import TranslatorError, from_xml, to_xml
from translator.jderobot.self_contained import is_old_form
from translator.opening import open_tree
from translator.xml.capital import capital_root
from tree_gardener import LoadError, Tree

BODY = '<BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree>'
CAPITAL = f'<Root BTCPP_format="4" main_tree_to_execute="M">{BODY}</Root>'
COMMENT = f'<!-- once <Root> --><root BTCPP_format="4" main_tree_to_execute="M">{BODY}</root>'
GROOT = (
    '<root main_tree_to_execute="M"><BehaviorTree ID="M">'
    "<Root><Sequence><AlwaysSuccess/></Sequence></Root></BehaviorTree></root>"
)
NAMED = (
    '<root BTCPP_format="4"><BehaviorTree ID="M"><Sequence><RootCheck depth="3"/></Sequence>'
    "</BehaviorTree></root>"
)
JDEROBOT = (
    '<?xml version="1.0"?>\n<!-- a --><Root name="Tree Root"><BehaviorTree><Forward name="Forward"/>'
    "</BehaviorTree><Code><Forward>import py_trees</Forward></Code></Root>"
)


@pytest.mark.parametrize(
    ("text", "code", "types"),
    [
        (CAPITAL, "BT0709", ["AlwaysSuccess"]),
        (GROOT, "BT0721", ["Sequence", "AlwaysSuccess"]),
        (COMMENT, "", ["AlwaysSuccess"]),
        (NAMED, "", ["Sequence", "RootCheck"]),
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_it_is_imported_and_said(text: str, code: str, types: list[str], encoding: str) -> None:
    project = open_tree(text.encode(encoding), file="tree.xml")
    codes = {item.code for item in project.diagnostics}
    assert {code} <= codes if code else not codes & {"BT0709", "BT0721"}
    assert [node.type for node in project.trees["M"].walk()] == types
    written = to_xml(project)
    assert "<root " in written
    assert "<Root" not in written.replace("<RootCheck", "").replace("<!-- once <Root> -->", "")


def test_actions_are_those_of_the_tree() -> None:
    assert set(open_tree(NAMED.encode(), file="tree.xml").actions) == {"RootCheck"}
    assert set(open_tree(COMMENT.encode(), file="tree.xml").actions) == set()


def test_the_form_of_2024_is_still_another_one() -> None:
    assert is_old_form(JDEROBOT)
    assert not any(map(is_old_form, (CAPITAL, COMMENT, GROOT, NAMED)))
    assert set(open_tree(JDEROBOT.encode(), file="tree.xml").actions) == {"Forward"}


def test_only_the_first_element_decides() -> None:
    assert capital_root("<Root/>") is not None
    assert capital_root("<RootCheck/>") is None
    assert capital_root(codecs.BOM_UTF8 + b"<Root a='1'>") == " a='1'"


def test_a_root_within_a_root_without_a_tree_is_no_tree() -> None:
    with pytest.raises(TranslatorError):
        from_xml("<Root BTCPP_format='4'/>")


def test_the_engine_refuses_it_as_behaviortree_cpp_does() -> None:
    with pytest.raises(LoadError) as refused:
        Tree.from_xml(CAPITAL)
    assert refused.value.diagnostics[0].code == "TG201"
    assert "rename it to <root>" in refused.value.diagnostics[0].hint
