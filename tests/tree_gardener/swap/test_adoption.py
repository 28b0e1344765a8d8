"""A tree that takes over the state of another one."""

from __future__ import annotations

from tree_gardener import ManualClock, Status, Tree
from tree_gardener.swap import adopt, capture


def tree_of(body: str, clock: ManualClock) -> Tree:
    return Tree.from_xml(
        f'<root BTCPP_format="4"><BehaviorTree ID="M">{body}</BehaviorTree></root>', clock=clock
    )


def test_timers_with_one_deadline_fire_in_the_order_that_they_had():
    body = (
        '<Parallel _bts_id="p">'
        '<Delay _bts_id="d" delay_msec="100"><Script _bts_id="1" code="last := 1"/></Delay>'
        '<Sequence _bts_id="s"><Sleep _bts_id="z" msec="100"/>'
        '<Script _bts_id="2" code="last := 2"/></Sequence>'
        "</Parallel>"
    )
    clock = ManualClock()
    old = tree_of(body, clock)
    old.tick_exactly_once()
    new = tree_of(body, clock)
    adopt(new, capture(old), {})
    assert [item[:2] for item in sorted(new.timers.heap, key=lambda item: item[:2])] == [
        item[:2] for item in sorted(old.timers.heap, key=lambda item: item[:2])
    ]
    clock.advance(0.1)
    assert new.tick_exactly_once() is Status.SUCCESS
    assert new.blackboard["last"] == 2


def test_a_block_that_moved_remembers_and_is_idle():
    clock = ManualClock()
    once = '<RunOnce _bts_id="o"><Script _bts_id="c" code="n += 1"/></RunOnce>'
    old = tree_of(f'<Sequence _bts_id="s">{once}<Sleep _bts_id="z" msec="10"/></Sequence>', clock)
    old.blackboard["n"] = 0
    old.tick_exactly_once()
    new = tree_of(f'<Fallback _bts_id="f"><Inverter _bts_id="i">{once}</Inverter></Fallback>', clock)
    adopt(new, capture(old), {})
    new.tick_exactly_once()
    assert new.blackboard["n"] == 1


def test_an_entry_takes_the_type_of_the_new_tree():
    clock = ManualClock()
    old = tree_of('<Script code="n := 4"/>', clock)
    old.tick_exactly_once()
    new = tree_of('<Repeat num_cycles="{n}"><AlwaysSuccess/></Repeat>', clock)
    adopt(new, capture(old), {})
    entry = new.blackboard.entries["n"]
    assert (entry.value, entry.type.name, entry.sequence) == (4, "int", 1)
