import pytest

from tests.tree_gardener.debugging.trees import named, tree_of
from tree_gardener import ControlNode, Status
from tree_gardener.debugging.ahead import ahead
from tree_gardener.debugging.stepper import Event, Shape

ABC = '<Leaf name="a.S"/><Leaf name="b.R"/><Leaf name="c.S"/>'


class Own(ControlNode):
    def update(self) -> Status:
        return Status.SUCCESS


def names(parent: str, children: str, at: str, *, event: Event = Event.AFTER) -> str:
    """The names of the nodes ahead, in order."""
    tree = tree_of(f"<{parent}>{children}</{parent.partition(' ')[0]}>", Own=Own)
    uids = ahead(tree.nodes, Shape.of(tree.nodes), named(tree, at).uid, event)
    return "".join(tree.nodes[uid - 1].name.partition(".")[0] for uid in uids)


@pytest.mark.parametrize(
    ("parent", "at", "expected"),
    [
        *(
            (parent, "a", "bc")
            for parent in ("Sequence", "Fallback", "ReactiveSequence", "AsyncFallback", "Parallel")
        ),
        *(
            (parent, "c", "")
            for parent in ("Sequence", "ReactiveFallback", "SequenceWithMemory", "ParallelAll")
        ),
        *((parent, "a", "bc") for parent in ("IfThenElse", "WhileDoElse", "TryCatch")),
        *((parent, "b", "") for parent in ("IfThenElse", "WhileDoElse")),
        ("TryCatch", "b", "c"),
        ("Switch2 case_1='1' case_2='2' variable='1'", "a", ""),
        ("Own", "b", "abc"),
    ],
)
def test_what_a_rule_may_tick_after_a_child(parent: str, at: str, expected: str) -> None:
    assert names(parent, ABC, at) == expected


def test_before_its_tick_the_node_and_those_below_it_are_ahead() -> None:
    children = '<Leaf name="a.S"/><Inverter name="i"><Leaf name="b.S"/></Inverter><Leaf name="c.S"/>'
    assert names("Sequence", children, "i", event=Event.BEFORE) == "ibc"
    assert names("Sequence", children, "i") == "c"
    assert names("Sequence", children, "b") == "c"


def test_a_node_that_repeats_its_child_may_tick_it_again() -> None:
    assert names("Repeat num_cycles='3'", '<Leaf name="a.S"/>', "a") == "a"
    assert names("Inverter", '<Leaf name="a.S"/>', "a") == ""


def test_children_of_a_parallel_that_are_done_are_not_ahead() -> None:
    tree = tree_of(f"<ParallelAll>{ABC}</ParallelAll>")
    tree.tick_exactly_once()
    assert ahead(tree.nodes, Shape.of(tree.nodes), 1, Event.AFTER) == ()
    assert ahead(tree.nodes, Shape.of(tree.nodes), named(tree, "a").uid, Event.AFTER) == (
        named(tree, "b").uid,
    )


def test_a_halt_may_tick_the_last_child_of_try_catch() -> None:
    tree = tree_of(
        '<Parallel><TryCatch catch_on_halt="true"><Leaf name="a.R"/><Leaf name="b.S"/></TryCatch>'
        '<Leaf name="c.S"/></Parallel>'
    )
    tree.tick_exactly_once()
    assert ahead(tree.nodes, Shape.of(tree.nodes), named(tree, "c").uid, Event.AFTER) == (
        named(tree, "b").uid,
    )


def test_a_node_that_halts_a_child_may_tick_another_one() -> None:
    assert names("WhileDoElse", ABC, "c", event=Event.HALTED) == "abc"
    assert names("Sequence", ABC, "c", event=Event.HALTED) == ""
