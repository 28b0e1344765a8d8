"""The nodes that are written into one function."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.trees import load, recording, subtree
from tree_gardener.blackboard import Blackboard
from tree_gardener.debugging import Debugger
from tree_gardener.debugging.watches import Watch
from tree_gardener.debugging.wiring import Wanted
from tree_gardener.decorators.result import Inverter
from tree_gardener.generated.parts import (
    BUNDLE,
    CALL,
    COMPOSITES,
    MAX_DEPTH,
    MAX_NODES,
    RULES,
    Part,
    Planner,
    Region,
    Variant,
    rule_of,
)
from tree_gardener.node import Control, Node
from tree_gardener.script import Environment
from tree_gardener.status import Status

if TYPE_CHECKING:
    from tree_gardener import Tree

BARE = Variant(is_observed=False, marks=False, times=False, counts=False)


def regions(tree: Tree, uid: int = 1, variant: Variant = BARE, *hooked: int) -> list[Region]:
    planner = Planner(variant, None, lambda node: node.uid in hooked)
    return planner.regions(tree.nodes[uid - 1])


def kinds(part: Part) -> list[str]:
    return [part.kind, *(kind for child in part.children for kind in kinds(child))]


def size(part: Part) -> int:
    return 1 + sum(size(child) for child in part.children)


def test_composites_decorators_and_subtrees_with_their_leaves_are_one_region() -> None:
    tree = load(
        '<Sequence><Fallback><Succeeding/><ScriptCondition code="true"/></Fallback><Inverter><AlwaysFailure/>'
        '</Inverter><SubTree ID="T"/></Sequence>',
        subtree("T", '<ReactiveSequence><Script code="a := 1"/></ReactiveSequence>'),
    )
    (region,) = regions(tree)
    assert CALL not in kinds(region.root)
    assert size(region.root) == len(tree.nodes)
    assert region.values[0] is tree.nodes[0]


def test_what_has_no_rule_is_called() -> None:
    repeat = '<Repeat num_cycles="2"><Succeeding/></Repeat>'
    tree = load(f'<Sequence>{repeat}<Sleep msec="1"/><Succeeding/></Sequence>')
    planner = Planner(BARE, None, lambda node: False)
    (region,) = planner.regions(tree.nodes[0])
    assert [part.kind for part in region.root.children] == [CALL, CALL, "stateful"]
    assert [node.type for node in planner.called] == ["Repeat", "Sleep"]


def test_a_composite_that_calls_all_its_children_has_no_region() -> None:
    tree = load('<Sequence><Sleep msec="1"/><Sleep msec="1"/></Sequence>')
    assert regions(tree) == []
    assert regions(tree, 2) == []


def test_a_node_with_a_hook_is_called() -> None:
    tree = load("<Sequence><Succeeding/><Succeeding/></Sequence>")
    (region,) = regions(tree, 1, BARE, 3)
    assert [part.kind for part in region.root.children] == ["stateful", CALL]


@pytest.mark.parametrize("method", ["execute", "go_on"])
def test_a_class_whose_method_was_replaced_is_left_alone(
    method: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    tree = load("<Sequence><Inverter><Succeeding/></Inverter><Succeeding/></Sequence>")
    assert CALL not in kinds(regions(tree)[0].root)
    monkeypatch.setattr(Inverter, method, lambda self, *_: Status.SUCCESS)
    assert rule_of(tree.nodes[1]) is None
    assert [part.kind for part in regions(tree)[0].root.children] == [CALL, "stateful"]


@pytest.mark.parametrize("children", [MAX_NODES, MAX_NODES + 1, 5 * MAX_NODES + 3])
def test_size_is_bounded(children: int) -> None:
    found = regions(load(f"<Sequence>{'<Succeeding/>' * children}</Sequence>"))
    assert sum(len(region.root.children) for region in found) == children
    assert max(size(region.root) for region in found) <= MAX_NODES + 1
    assert [region.base for region in found] == list(range(0, children, MAX_NODES))
    # Equal slices have equal shapes, so that they share their code.
    assert len({region.root for region in found}) <= 2


def test_size_counts_nodes_at_all_levels() -> None:
    inner = f"<Sequence>{'<Succeeding/>' * 9}</Sequence>"
    found = regions(load(f"<Sequence>{inner * 10}</Sequence>"))
    # Whole children share a function, as many as there is room for.
    assert [len(region.root.children) for region in found] == [3, 3, 3, 1]
    assert [region.base for region in found] == [0, 3, 6, 9]
    assert max(size(region.root) for region in found) <= MAX_NODES + 1
    assert not any(CALL in kinds(region.root) for region in found)


def test_a_child_that_is_too_large_is_called() -> None:
    tree = load(f"<Sequence><Fallback>{'<Failing/>' * MAX_NODES}</Fallback><Succeeding/></Sequence>")
    (region,) = regions(tree)
    assert [part.kind for part in region.root.children] == [CALL, "stateful"]
    (below,) = regions(tree, 2)
    assert size(below.root) == MAX_NODES + 1


def test_depth_is_bounded() -> None:
    tree = load("<Sequence>" * 40 + "<Succeeding/>" + "</Sequence>" * 40)
    found = regions(tree, 41 - MAX_DEPTH)
    assert kinds(found[0].root) == ["ordered"] * MAX_DEPTH + ["stateful"]
    assert kinds(regions(tree)[0].root) == ["ordered"] * MAX_DEPTH + [CALL]


def test_a_shape_has_nothing_of_the_document() -> None:
    def shape(name: str, text: str) -> object:
        tree = load(
            f'<Sequence name="{name}"><A name="{name}"/><ScriptCondition code="{text} == 1"/></Sequence>',
            nodes={"A": recording()},
        )
        return regions(tree)[0].root

    assert shape("a", "x") == shape("__import__('os')", "secret")


def observed(body: str) -> Region:
    tree = load(body)
    tree.observe(lambda changes: None)
    (region,) = regions(tree, 1, BARE._replace(is_observed=True))
    return region


def reports(region: Region) -> list[tuple[int, list[int]]]:
    """The node of each bundle, and the nodes whose results are in it."""
    marks = [value for value in region.values if isinstance(value, tuple) and isinstance(value[0], Node)]
    return [(node.uid, [uid for uid, _ in flashes]) for node, flashes in marks]


def test_marks_of_leaves_are_bundled_between_calls() -> None:
    region = observed(
        '<Sequence><Succeeding/><Succeeding/><Sleep msec="0"/><Succeeding/><Succeeding _post="a := 1"/>'
        "</Sequence>"
    )
    assert [part.kind for part in region.root.children] == [
        *("stateful", "stateful", BUNDLE, CALL, "stateful", BUNDLE, "stateful"),
    ]
    bundle = region.values[region.root.children[2].first]
    assert bundle == (region.node, ((2, Status.SUCCESS), (3, Status.SUCCESS)))


def test_the_last_bundle_is_reported_with_the_result_of_the_root() -> None:
    region = observed("<Fallback><Failing/><Failing/></Fallback>")
    assert BUNDLE not in kinds(region.root)
    flashes = tuple((uid, Status.FAILURE) for uid in (2, 3, 1))
    assert region.values[region.root.place("e")] == (region.node, flashes)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        # The result that lets the node above continue shows that all below went the usual way.
        ("<Sequence><A/><Sequence><A/><A/></Sequence><A/></Sequence>", [[2, 4, 5, 3, 6, 1]]),
        ("<Fallback><A/><Inverter><A/></Inverter><A/></Fallback>", [[2, 4, 3, 5, 1]]),
        # A Fallback succeeds at any of its children, and ForceSuccess after any result.
        ("<Sequence><A/><Fallback><A/><A/></Fallback><A/></Sequence>", [[2], [4, 5], [6, 1]]),
        ("<Sequence><A/><ForceSuccess><A/></ForceSuccess><A/></Sequence>", [[2], [4], [5, 1]]),
        ("<ForceSuccess><Sequence><A/></Sequence></ForceSuccess>", [[3, 2]]),
        ("<Sequence><A/><Sequence _post='a := 1'><A/></Sequence></Sequence>", [[2], [4], [1]]),
    ],
)
def test_marks_of_composites_are_bundled_where_the_result_tells_the_course(
    body: str, expected: list[list[int]]
) -> None:
    assert sorted(reports(observed(body.replace("<A/>", "<Succeeding/>")))) == sorted(
        (1, uids) for uids in expected
    )


def asking(where: int, wanted: Wanted) -> Region:
    """The region of an observed Sequence at one of whose leaves a debugger is asked."""
    tree = load("<Sequence><Succeeding/><Succeeding/><Succeeding/></Sequence>")
    tree.observe(lambda changes: None)
    tree.debug(Debugger(lambda stop: None))
    wiring = tree._hooks.wiring
    assert wiring is not None
    wiring.choose({where: wanted})
    variant = BARE._replace(is_observed=True, asks=True)
    (region,) = Planner(variant, None, lambda node: False, wiring).regions(tree.nodes[0])
    return region


NEVER = (Watch("1 > 2", Environment(Blackboard(), {})),)
SUCCEEDED, FAILED = frozenset({Status.SUCCESS}), frozenset({Status.FAILURE})


@pytest.mark.parametrize(
    ("wanted", "letters", "expected"),
    [
        # Where the tree cannot be held, all results are reported together.
        (Wanted(results=FAILED), "y", [[2, 3, 4, 1]]),
        (Wanted(before=True, tests=NEVER), "g", [[2, 3, 4, 1]]),
        (Wanted(results=SUCCEEDED | FAILED, tests=NEVER), "hj", [[2, 3, 4, 1]]),
        # What went before is reported before it is asked.
        (Wanted(before=True), "a", [[2], [4, 1]]),
        (Wanted(results=SUCCEEDED), "x", [[2], [4, 1]]),
    ],
)
def test_marks_are_bundled_round_a_breakpoint_that_does_not_stop(
    wanted: Wanted, letters: str, expected: list[list[int]]
) -> None:
    region = asking(3, wanted)
    assert sorted(uids for _, uids in reports(region)) == expected
    leaf = next(part for part in region.root.children if region.values[part.first] is region.node.children[1])
    assert leaf.has == f"nub{letters}"


def test_letters_stand_for_the_values_at_their_places() -> None:
    tree = load('<Sequence><A _skipIf="false" _onSuccess="x := 1"/></Sequence>', nodes={"A": recording()})
    (region,) = regions(tree)
    leaf, node = region.root.children[0], tree.nodes[1]
    assert isinstance(node, Node)
    guard = node.guard
    assert guard is not None
    assert guard.on_success is not None
    assert leaf.is_guarded
    assert not region.root.is_guarded
    assert region.values[leaf.place("n")] is node
    assert region.values[leaf.place("u")] == node.behaviour.update
    assert region.values[leaf.place("0")] is guard.deciding[0][0].call
    assert region.values[leaf.place("s")] is guard.on_success.call


def test_every_rule_names_its_kind() -> None:
    own = {rule.kind for cls, rule in RULES.items() if issubclass(cls, Control)}
    assert own == COMPOSITES
