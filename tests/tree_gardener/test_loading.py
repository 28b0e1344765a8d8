"""Errors in a document have a code, a place and a hint."""

from __future__ import annotations

from typing import ClassVar

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import LEAVES, Failing, document, load, subtree
from tree_gardener import LoadError, Port, Status, Tree, get_input


class Drive(py_trees.behaviour.Behaviour):
    INPUT_PORTS: ClassVar = {"speed": Port(float, default=0.5), "goal": Port(str, required=True)}
    OUTPUT_PORTS: ClassVar = {"seen": Port(int)}

    def update(self) -> PyTreesStatus:
        return PyTreesStatus.SUCCESS


def problems(body: str, *more: str) -> list[tuple[str, int, int]]:
    text = document("\n" + body, *more)
    with pytest.raises(LoadError) as refused:
        Tree.from_xml(text, {**LEAVES, "Drive": Drive})
    for problem in refused.value.diagnostics:
        assert str(problem).startswith(f"tree.xml:{problem.line}:{problem.column}: {problem.code} ")
        assert problem.to_json()["code"] == problem.code
    return [(problem.code, problem.line, problem.column) for problem in refused.value.diagnostics]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('<Drive goal="a" sped="1"/>', [("TG301", 2, 23)]),
        ("<Drive/>", [("TG302", 2, 1)]),
        ('<Drive goal="a" speed="{a"/>', [("TG303", 2, 24)]),
        ('<Drive goal="a" seen="there"/>', [("TG304", 2, 23)]),
        ('<Drive goal="a" speed="fast"/>', [("TG305", 2, 24)]),
        (
            '<Sequence><Drive goal="a" seen="{v}"/><Drive goal="b" speed="{v}"/></Sequence>',
            [("TG306", 2, 62)],
        ),
        ('<Succeeding _skipIf="a &amp;&amp; (b"/>', [("TG401", 2, 37)]),
        ('<Succeeding _onHalted=""/>', [("TG401", 2, 24)]),
        ("<Sequence><Drve/><Nope/></Sequence>", [("TG209", 2, 11), ("TG209", 2, 18)]),
        ('<SubTree ID="Nowhere"/>', [("TG222", 2, 14)]),
        ('<Sequence ID="x"><Succeeding/></Sequence>', [("TG208", 2, 15)]),
        ("<Inverter><Succeeding/><Succeeding/></Inverter>", [("TG211", 2, 1)]),
    ],
)
def test_a_mistake_is_found_at_its_place(body: str, expected: list[tuple[str, int, int]]) -> None:
    assert problems(body) == expected


A = "<AlwaysSuccess/>"
CONSTRUCTED = [
    ("<Script/>", "TG302", "code"),
    ("<ScriptCondition/>", "TG302", "code"),
    (f"<Precondition>{A}</Precondition>", "TG302", "if"),
    *((f"<Loop{kind}>{A}</Loop{kind}>", "TG302", "queue") for kind in ("Int", "Double", "String", "Bool")),
    (f"<SkipUnlessUpdated>{A}</SkipUnlessUpdated>", "TG302", "entry"),
    (f'<WaitValueUpdate entry="">{A}</WaitValueUpdate>', "TG302", "entry"),
    ("<WasEntryUpdated/>", "TG302", "entry"),
    ('<Script code="{x}"/>', "TG307", "code"),
    (f'<Precondition if="{{x}}">{A}</Precondition>', "TG307", "if"),
]


@pytest.mark.parametrize(("body", "code", "port"), CONSTRUCTED)
def test_what_a_constructor_would_miss_is_refused_at_load(body: str, code: str, port: str) -> None:
    with pytest.raises(LoadError) as refused:
        load("\n" + body)
    (problem,) = refused.value.diagnostics
    assert (problem.code, problem.line, problem.port) == (code, 2, port)
    assert (
        problem.node == body[1:].split(" ", maxsplit=1)[0].split("/", maxsplit=1)[0].split(">", maxsplit=1)[0]
    )
    assert problem.hint


def test_a_script_may_be_a_constant_of_its_subtree() -> None:
    inner = '<BehaviorTree ID="B"><Script code="{code}"/></BehaviorTree>'
    tree = load('<SubTree ID="B" name="b" code="x := 1"/>', inner)
    tree.tick_exactly_once()
    assert tree.blackboard.scope("b")["x"] == 1
    with pytest.raises(LoadError, match="TG401 in the script that 'code' holds"):
        load('<SubTree ID="B" code="x :="/>', inner)


@pytest.mark.parametrize("tree_id", ["Sequence", "AlwaysSuccess", "SubTree", "Succeeding"])
def test_a_tree_cannot_be_named_like_a_node(tree_id: str) -> None:
    unused = f'<BehaviorTree ID="{tree_id}">{A}</BehaviorTree>'
    with pytest.raises(LoadError, match=f"TG224 the tree's ID '{tree_id}' is the name of a node"):
        load(A, unused)


@pytest.mark.parametrize("tree_id", ["ROOT", "rOOT"])
def test_other_spellings_of_root_are_allowed(tree_id: str) -> None:
    load(A, f'<BehaviorTree ID="{tree_id}">{A}</BehaviorTree>')


def test_subtrees_are_checked_where_they_are_called() -> None:
    model = '<TreeNodesModel><SubTree ID="Arm"><input_port name="goal"/></SubTree></TreeNodesModel>'
    arm = subtree("Arm", "<Succeeding/>")
    assert problems('<SubTree ID="Arm"/>', arm, model) == [("TG503", 2, 1)]
    assert problems('<SubTree ID="Arm" _autoremap="perhaps"/>', arm) == [("TG502", 2, 31)]
    twice = '<Sequence><SubTree ID="Arm" name="a"/><SubTree ID="Arm" name="a"/></Sequence>'
    assert problems(twice, arm) == [("TG501", 2, 63)]
    assert load('<SubTree ID="Arm" _autoremap="1"/>', arm, model).tick_once() is Status.SUCCESS


def test_mutual_recursion_is_named() -> None:
    with pytest.raises(LoadError, match="A → B → A"):
        load('<SubTree ID="A"/>', subtree("A", '<SubTree ID="B"/>'), subtree("B", '<SubTree ID="A"/>'))


def test_an_integer_constant_does_not_fit_a_string_port() -> None:
    body = subtree("B", '<Drive goal="{k}"/>')
    assert problems('<SubTree ID="B" k="5"/>', body)[0][0] == "TG306"


class Open(py_trees.behaviour.Behaviour):
    def __init__(self, name: str, ports: dict[str, str] | None = None) -> None:
        super().__init__(name)
        self.ports = ports

    def update(self) -> PyTreesStatus:
        return PyTreesStatus.SUCCESS if get_input(self, "any") == "thing" else PyTreesStatus.FAILURE


def test_a_class_without_declarations_takes_any_port() -> None:
    tree = load('<Open any="thing" other="{x}"/>', nodes={"Open": Open})
    assert tree.nodes[0].behaviour.ports == {"any": "thing", "other": "{x}"}
    assert tree.tick_once() is Status.SUCCESS


def test_the_leaves_are_what_they_are_called() -> None:
    assert LEAVES["Failing"] is Failing
