"""The garbage collector during a load: off, and on again afterwards, on every way out."""

from __future__ import annotations

import gc
import threading
import weakref
from typing import TYPE_CHECKING

import py_trees
import pytest

from tree_gardener import LoadError, Tree
from tree_gardener.collector import LARGE, MOST, paused_collector

if TYPE_CHECKING:
    from collections.abc import Iterator

DOCUMENT = '<root BTCPP_format="4"><BehaviorTree ID="M"><Probe/></BehaviorTree></root>'


@pytest.fixture(autouse=True)
def collector_is_on() -> Iterator[None]:
    gc.enable()
    yield
    gc.enable()


class Probe(py_trees.behaviour.Behaviour):
    """Notes whether the collector is on while it is made."""

    was_on: bool | None = None

    def __init__(self, name: str) -> None:
        super().__init__(name)
        Probe.was_on = gc.isenabled()

    def update(self) -> py_trees.common.Status:
        """Succeeds."""
        return py_trees.common.Status.SUCCESS


class Failing(Probe):
    """Cannot be made."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        raise KeyboardInterrupt


def test_it_is_off_during_a_load_and_on_afterwards() -> None:
    Tree.from_xml(DOCUMENT, {"Probe": Probe})
    assert Probe.was_on is False
    assert gc.isenabled()


@pytest.mark.parametrize("text", ["<", DOCUMENT.replace("Probe", "Nope")])
def test_it_is_on_after_an_error(text: str) -> None:
    with pytest.raises(LoadError):
        Tree.from_xml(text)
    assert gc.isenabled()


def test_it_is_on_after_an_exception_of_any_kind() -> None:
    with pytest.raises(KeyboardInterrupt):
        Tree.from_xml(DOCUMENT, {"Probe": Failing})
    assert gc.isenabled()


def test_who_has_switched_it_off_keeps_it_off() -> None:
    gc.disable()
    Tree.from_xml(DOCUMENT, {"Probe": Probe})
    assert not gc.isenabled()


def test_loads_that_overlap_do_not_keep_it_off_longer_than_one_of_them() -> None:
    is_inside, may_end = threading.Event(), threading.Event()

    def second() -> None:
        with paused_collector():
            is_inside.set()
            may_end.wait(10)

    thread = threading.Thread(target=second)
    with paused_collector():
        thread.start()
        assert is_inside.wait(10)
    assert gc.isenabled(), "the first load has ended it, although the second continues"
    may_end.set()
    thread.join()
    assert gc.isenabled()


@pytest.fixture
def thawed() -> Iterator[None]:
    """No object is frozen, as in a program that does not freeze its own."""
    gc.unfreeze()
    yield
    gc.collect()
    gc.freeze()


def passes() -> list[int]:
    return [generation["collections"] for generation in gc.get_stats()]


def document(leaves: int) -> str:
    body = "<Probe/>" * leaves
    return f'<root BTCPP_format="4"><BehaviorTree ID="M"><Sequence>{body}</Sequence></BehaviorTree></root>'


@pytest.mark.usefixtures("thawed")
def test_what_a_large_load_makes_is_not_looked_at_once_more() -> None:
    text = document(LARGE // 4)
    gc.collect()
    before = passes()
    tree = Tree.from_xml(text, {"Probe": Probe})
    assert passes() == before
    assert len(tree.nodes) == LARGE // 4 + 1


@pytest.mark.usefixtures("thawed")
def test_trees_that_are_dropped_are_given_back() -> None:
    text = document(LARGE // 4)
    gc.collect()
    before = passes()[-1]
    alive = []
    while passes()[-1] == before:
        alive.append(weakref.ref(Tree.from_xml(text, {"Probe": Probe}).nodes[0].behaviour))
        assert len(alive) * LARGE < 2 * MOST
    assert not any(each() is not None for each in alive[:-1])
