"""Every slot of every node is a part of its memory, or one of those that are made again."""

from __future__ import annotations

import inspect

import pytest

from tree_gardener import ManualClock, Status, Tree
from tree_gardener.controls.parallel import Parallel
from tree_gardener.controls.sequence import Sequence
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.node import Control, Decorator, Node
from tree_gardener.registry import build_registry
from tree_gardener.swap import adopt, capture
from tree_gardener.swap.memory import MEMORY, count_done, parts_of

MADE_AGAIN = {
    *(
        name
        for cls in (Node, Control, Decorator, BehaviourLeaf)
        for base in cls.__mro__
        for name in getattr(base, "__slots__", ())
    ),
    *("script", "config", "environment", "key"),  # made from the document
    *("ticked", "successes", "failures"),  # of one tick, and counted again from the children
}
OF_ONE_TICK = {("ParallelAll", "skips")}


def test_no_node_remembers_what_a_swap_forgets():
    classes = {kind.node_class for kind in build_registry({}, {}).values()}
    forgotten = [
        (cls.__name__, name)
        for cls in classes
        for base in inspect.getmro(cls)
        for name in getattr(base, "__slots__", ())
        if name not in MADE_AGAIN and name not in _parts(cls) and (cls.__name__, name) not in OF_ONE_TICK
    ]
    assert forgotten == []
    assert all(issubclass(cls, Node) for cls in MEMORY)


def _parts(cls: type[Node]) -> set[str]:
    return {name for base in cls.__mro__ for name in MEMORY.get(base, {})}


def ticked(body: str, ticks: int = 1) -> Tree:
    tree = Tree.from_xml(document(body), clock=ManualClock())
    for _ in range(ticks):
        tree.tick_exactly_once()
    return tree


def document(body: str) -> str:
    return f'<root BTCPP_format="4"><BehaviorTree ID="M">{body}</BehaviorTree></root>'


SLEEP = '<Sleep _bts_id="z" msec="1000"/>'


@pytest.mark.parametrize(
    ("before", "after", "all_skipped"),
    [
        ("ab", "ab", True),  # as it was
        ("ab", "abc", True),  # one more, of which nothing is known
        ("ab", "a", True),
        ("a!", "a!", False),
        ("a!", "!", False),
        ("a!", "", False),
    ],
)
def test_whether_all_children_were_skipped_outlives_an_edit(before, after, all_skipped):
    def body(children: str) -> str:
        skipped = "".join(
            f'<AlwaysSuccess _bts_id="{child}" _skipIf="{str(child != "!").lower()}"/>' for child in children
        )
        return f'<Sequence _bts_id="s">{skipped}{SLEEP}<AlwaysSuccess _bts_id="e" _skipIf="true"/></Sequence>'

    old = ticked(body(before))
    new = Tree.from_xml(document(body(after)), clock=ManualClock())
    adopt(new, capture(old), {})
    sequence = new.nodes[0]
    assert isinstance(sequence, Sequence)
    assert sequence.index == len(after)
    assert (sequence.skips == len(after)) is all_skipped or not after


def test_the_results_of_a_parallel_are_counted_again_when_one_left():
    def body(first: str) -> str:
        return (
            f'<Parallel _bts_id="p" failure_count="3">{first}<AlwaysFailure _bts_id="f"/>'
            f'<AlwaysSuccess _bts_id="g"/>{SLEEP}</Parallel>'
        )

    old = ticked(body('<AlwaysSuccess _bts_id="x"/>').replace('"3"', '"-1" success_count="3"'))
    assert isinstance(old.nodes[0], Parallel)
    assert old.nodes[0].successes == 2
    new = Tree.from_xml(document(body("")), clock=ManualClock())
    adopt(new, capture(old), {})
    parallel = new.nodes[0]
    assert isinstance(parallel, Parallel)
    assert (parallel.done, parallel.successes, parallel.failures) == ({0, 1}, 1, 1)
    assert new.nodes[1].status is Status.FAILURE


def test_parts_are_those_of_the_nearest_class():
    tree = ticked(f"<SequenceWithMemory>{SLEEP}</SequenceWithMemory>")
    assert set(parts_of(tree.nodes[0])) == {"index", "skips"}
    assert set(parts_of(tree.nodes[1])) == {"is_over", "timer"}
    count_done(tree.nodes[0])  # is no Parallel: nothing to count
    assert not hasattr(tree.nodes[0], "failures")
