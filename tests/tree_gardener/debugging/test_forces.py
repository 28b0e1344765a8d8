import pytest

from tests.tree_gardener.debugging.trees import named, tree_of
from tree_gardener import Status
from tree_gardener.debugging import Force, ForceError, Position
from tree_gardener.debugging.forces import Forces
from tree_gardener.debugging.wiring import RESULTS, Wanted


def forces():
    tree = tree_of('<Sequence name="s"><Leaf name="a.S"/><Leaf name="b.S"/><Leaf name="c.S"/></Sequence>')
    return tree, Forces(tree.nodes)


@pytest.mark.parametrize(
    ("force", "why"),
    [
        (Force(2, Status.IDLE), "IDLE is not a result"),
        (Force(2, Status.RUNNING, once=True), "is frozen"),
        (Force(2, Status.RUNNING, position=Position.AFTER), "is frozen"),
    ],
)
def test_what_cannot_be_forced(force: Force, why: str) -> None:
    _, found = forces()
    with pytest.raises(ForceError, match=why):
        found.set(force)
    assert found.all == []


def test_a_node_has_one_forced_result_and_a_result_for_once_ends() -> None:
    tree, found = forces()
    a = named(tree, "a")
    found.set(Force(a.uid, Status.FAILURE))
    found.set(Force(a.uid, Status.SUCCESS, once=True))
    assert found.before(a) is Status.SUCCESS
    assert found.before(a) is None
    assert found.has_ended


def test_a_frozen_node_is_not_halted_before_it_has_begun() -> None:
    tree, found = forces()
    a = named(tree, "a")
    found.set(Force(a.uid, Status.RUNNING))
    assert found.may_halt(a)
    assert found.before(a) is Status.RUNNING
    assert not found.may_halt(a)
    assert found.release(a.uid)
    assert found.may_halt(a)


def test_what_must_be_asked() -> None:
    tree, found = forces()
    found.set(Force(2, Status.SUCCESS))
    assert found.wanted() == {2: Wanted(within=True)}
    found.set(Force(2, Status.SUCCESS, position=Position.AFTER))
    assert found.wanted() == {2: Wanted(results=RESULTS, within=True)}
    found.release(2)
    found.skip_to(named(tree, "b"), 0)
    assert found.wanted() == {
        1: Wanted(results=RESULTS),
        2: Wanted(results=RESULTS, within=True),
        3: Wanted(before=True),
    }


@pytest.mark.parametrize("is_reached", [True, False])
def test_skips_end_with_the_node_that_they_lead_to_or_with_its_parent(is_reached: bool) -> None:
    tree, found = forces()
    found.set(Force(4, Status.SUCCESS))
    found.skip_to(named(tree, "c"), 1)
    assert [force.uid for force in found.all] == [3, 4]
    found.forget_skips(named(tree, "a"), is_reached=is_reached)
    assert len(found.all) == 2
    found.forget_skips(named(tree, "c" if is_reached else "s"), is_reached=is_reached)
    assert [force.uid for force in found.all] == [4]
