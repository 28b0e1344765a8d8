"""Hooks: what clients may ask, and its effect on ticks."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Any

import pytest

from tests.tree_gardener.trees import subtree
from tree_gardener import Status, Tree
from tree_gardener.groot.hooks import Hooks
from tree_gardener.groot.protocol import GrootError, Hook, HookKey, Mode, Position, Unlock

if TYPE_CHECKING:
    from collections.abc import Iterator

XML = f"<root>{subtree('Main', '<Sequence><AlwaysSuccess/><AlwaysFailure/></Sequence>')}</root>"


class Hooked:
    """A tree with hooks, and the uids that were reached."""

    def __init__(self) -> None:
        self.tree = Tree.from_xml(XML)
        self.reached: list[int] = []
        self.hooks = Hooks(self.tree, self.reached.append, lambda: None)

    def replace(
        self, uid: int, status: Status, position: Position = Position.BEFORE, *, once: bool = False
    ) -> None:
        self.hooks.insert([Hook(HookKey(uid, position), Mode.REPLACE, once, status, enabled=True)])

    def ticked(self) -> Status:
        self.hooks.follow()
        return self.tree.tick_exactly_once()


@pytest.mark.parametrize("position", list(Position))
def test_a_result_is_replaced_for_as_long_as_the_hook_is_there(position: Position) -> None:
    hooked = Hooked()
    hooked.replace(3, Status.SUCCESS, position)
    assert [hooked.ticked() for _ in range(2)] == [Status.SUCCESS] * 2
    hooked.hooks.enable_all(on=False)
    assert hooked.ticked() is Status.FAILURE
    hooked.hooks.enable_all(on=True)
    assert hooked.ticked() is Status.SUCCESS
    hooked.hooks.remove(HookKey(3, position))
    assert hooked.ticked() is Status.FAILURE
    assert hooked.reached == [3] * 3


def test_a_result_is_replaced_once() -> None:
    hooked = Hooked()
    hooked.replace(3, Status.SUCCESS, once=True)
    assert [hooked.ticked() for _ in range(2)] == [Status.SUCCESS, Status.FAILURE]
    assert hooked.hooks.dump() == []


@pytest.mark.parametrize("status", [Status.SKIPPED, Status.RUNNING, Status.IDLE])
def test_a_status_that_is_no_result_lets_the_node_tick(status: Status) -> None:
    hooked = Hooked()
    hooked.replace(3, status)
    assert hooked.ticked() is Status.FAILURE
    assert hooked.reached == [3]


def test_hooks_of_no_node_are_refused_and_change_nothing() -> None:
    hooked = Hooked()
    with pytest.raises(GrootError, match="not found"):
        hooked.hooks.insert(
            [
                Hook(HookKey(uid, Position.BEFORE), Mode.REPLACE, False, Status.SUCCESS, True)
                for uid in (1, 99)
            ]
        )
    for act in (
        lambda: hooked.hooks.remove(HookKey(1, Position.BEFORE)),
        lambda: hooked.hooks.unlock(
            Unlock(HookKey(1, Position.BEFORE), Status.SKIPPED, remove_when_done=True)
        ),
    ):
        with pytest.raises(GrootError, match="not found"):
            act()
    assert hooked.hooks.dump() == []


def test_changes_are_followed_once() -> None:
    hooked = Hooked()
    assert not hooked.hooks.must_follow
    hooked.replace(2, Status.SUCCESS)
    assert [hooked.hooks.must_follow for _ in range(2)] == [True, False]
    hooked.hooks.follow()
    assert not hooked.hooks.must_follow
    hooked.hooks.remove_all()
    assert hooked.hooks.must_follow


def test_a_tree_is_free_of_hooks_afterwards() -> None:
    hooked = Hooked()
    hooked.replace(3, Status.SUCCESS)
    hooked.ticked()
    hooked.hooks.detach()
    assert hooked.tree.tick_exactly_once() is Status.FAILURE
    assert hooked.ticked() is Status.SUCCESS  # a client that comes back finds its hooks


def test_a_wait_at_a_breakpoint_is_within_what_its_user_enters() -> None:
    hooked = Hooked()
    seen: list[Any] = []

    @contextlib.contextmanager
    def waiting() -> Iterator[None]:
        seen.append(list(hooked.reached))
        hooked.hooks.enable_all(on=False)  # the wait ends at once
        yield
        seen.append(["over"])

    hooked.hooks = Hooks(hooked.tree, hooked.reached.append, lambda: None, waiting)
    hooked.hooks.insert([Hook(HookKey(2, Position.BEFORE), Mode.BREAKPOINT, False, Status.SKIPPED, True)])
    assert hooked.ticked() is Status.FAILURE
    assert seen == [[2], ["over"]]
