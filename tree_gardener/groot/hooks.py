"""Hooks of clients: breakpoints at which the tree waits, and results that are forced on its nodes.

A hook before the tick comes after the node's pre-conditions, as in BehaviorTree.CPP. A node that is RUNNING
when its result is forced is halted first, with its children: there it would keep them RUNNING.
"""

import contextlib
import threading
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any

from tree_gardener.debugging.forces import Force, Forces
from tree_gardener.debugging.forces import Position as ForcePosition
from tree_gardener.debugging.wiring import RESULTS, Wanted, Wiring
from tree_gardener.groot.protocol import GrootError, Hook, HookKey, Mode, Position, Unlock
from tree_gardener.node import Node
from tree_gardener.status import Status

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

Waiting = Callable[[], contextlib.AbstractContextManager[object]]


class Hooks:
    """The hooks of one tree. It is the tree's debugger (`Tree.debug`) while there are any.

    Clients change the hooks from the publisher's thread. The ticking thread follows at the next node that
    asks, while it waits at a breakpoint, or with `follow`, which the publisher has called between two ticks.

    Args:
        tree: the tree.
        reached: called with the uid of a node whose hook was reached, on the ticking thread.
        held: called before the tree waits, on the ticking thread.
        waiting: entered while the tree waits, on the ticking thread.
    """

    def __init__(
        self,
        tree: "Tree",
        reached: Callable[[int], None],
        held: Callable[[], None],
        waiting: Waiting = contextlib.nullcontext,
    ) -> None:
        self._waiting = waiting
        self._tree = tree
        self._reached = reached
        self._held = held
        self._changed = threading.Condition()
        self._hooks: dict[HookKey, Hook] = {}
        self._unlocked: dict[HookKey, Status] = {}
        self._waits: HookKey | None = None
        self._is_stale = self._is_told = False
        self._wiring: Wiring | None = None
        self._forces = Forces(tree.nodes)

    def insert(self, hooks: Iterable[Hook]) -> None:
        """Inserts hooks, each in place of another at the same position.

        Raises:
            GrootError: the tree has no such node; no hook is inserted.
        """
        wanted = list(hooks)
        for hook in wanted:
            if not 0 < hook.key.uid <= len(self._tree.nodes):
                raise GrootError("Node ID not found")
        with self._change():
            self._hooks.update((hook.key, hook) for hook in wanted)

    def remove(self, key: HookKey) -> None:
        """Removes a hook; a tree that waits at it continues.

        Raises:
            GrootError: there is none.
        """
        with self._change():
            if self._hooks.pop(key, None) is None:
                raise GrootError("Node ID not found")

    def remove_all(self) -> None:
        """Removes all hooks."""
        with self._change():
            self._hooks.clear()

    def enable_all(self, *, on: bool) -> None:
        """Switches all hooks on or off."""
        with self._change():
            for hook in self._hooks.values():
                hook.enabled = on

    def unlock(self, answer: Unlock) -> None:
        """Continues a tree that waits at a breakpoint; without one that waits it has no effect.

        Raises:
            GrootError: there is no such hook.
        """
        with self._change():
            hook = self._hooks.get(answer.key)
            if hook is None:
                raise GrootError("Node ID not found")
            if self._waits == answer.key:
                hook.once |= answer.remove_when_done
                self._unlocked[answer.key] = answer.desired_status

    def dump(self) -> list[dict[str, Any]]:
        """Returns the hooks as clients read them, those after the tick first, as BehaviorTree.CPP does."""
        with self._changed:
            ordered = sorted(self._hooks.values(), key=lambda hook: (-hook.key.position, hook.key.uid))
            return [hook.to_json() for hook in ordered]

    @property
    def must_follow(self) -> bool:
        """Whether `follow` is to be called, since clients changed the hooks; True once for each change."""
        with self._changed:
            must, self._is_told = self._is_stale and not self._is_told, self._is_stale
            return must

    @contextlib.contextmanager
    def _change(self) -> Iterator[None]:
        """Holds the hooks for a change; the ticking thread looks at them afterwards."""
        with self._changed:
            yield
            self._is_stale = True
            self._changed.notify_all()

    def follow(self) -> None:
        """Chooses the nodes that ask, after clients changed the hooks."""
        with self._changed:
            if not self._is_stale:
                return
            self._is_stale = self._is_told = False
            wanted: dict[int, Wanted] = {}
            for key, hook in self._hooks.items():
                if hook.enabled:
                    is_before = key.position is Position.BEFORE
                    more = Wanted(within=True) if is_before else Wanted(results=RESULTS)
                    wanted[key.uid] = wanted.get(key.uid, Wanted()).joined(more)
        if self._wiring is None and wanted:
            self._tree.debug(self)
        if self._wiring is not None:
            self._wiring.choose(wanted)

    def detach(self) -> None:
        """Ends all asking, between two ticks."""
        if self._wiring is not None:
            self._wiring = None
            self._tree.debug(None)
            self._is_stale = True

    def attach(self, wiring: Wiring) -> None:
        """Connects the hooks to the tree that they hold; `Tree.debug` calls it."""
        self._wiring = wiring

    def before(self, node: Node) -> None:
        """Does nothing: hooks come after the pre-conditions."""

    def forced(self, node: Node) -> Status | None:
        """Acts at the hook before a node's tick; returns the result in its place, or None."""
        forced = self._act(HookKey(node.uid, Position.BEFORE))
        if forced is None:
            return None
        self._forces.set(Force(node.uid, forced, once=True))
        return self._forces.before(node)

    def after(self, node: Node, status: Status, decided: str) -> Status:
        """Acts at the hook after a node's tick; returns the result."""
        forced = None if decided else self._act(HookKey(node.uid, Position.AFTER))
        if forced is None:
            return status
        self._forces.set(Force(node.uid, forced, once=True, position=ForcePosition.AFTER))
        replaced = self._forces.after(node, status)
        return status if replaced is None else replaced

    def may_halt(self, node: Node) -> bool:
        """Returns True: no node is frozen by hooks."""
        return True

    def halted(self, node: Node) -> None:
        """Does nothing: hooks do not act at halts."""

    def _act(self, key: HookKey) -> Status | None:
        """Waits at a breakpoint; returns the result that is wanted, or None."""
        with self._changed:
            hook = self._hooks.get(key)
            if hook is None or not hook.enabled:
                wanted = None
            else:
                if hook.mode is Mode.BREAKPOINT:
                    self._held()  # before the news: a client that hears it asks at once for the state
                    self._reached(key.uid)
                    with self._waiting():
                        wanted = self._wait(hook)
                else:
                    self._reached(key.uid)
                    wanted = hook.desired_status
                if hook.once and self._hooks.get(key) is hook and hook.enabled:
                    del self._hooks[key]
                    self._is_stale = True
        self.follow()
        return wanted if wanted is not None and wanted.is_completed else None

    def _wait(self, hook: Hook) -> Status | None:
        """Waits until a client unlocks a breakpoint, removes it or switches it off."""
        self._waits = hook.key
        try:
            while self._hooks.get(hook.key) is hook and hook.enabled:
                if hook.key in self._unlocked:
                    return self._unlocked[hook.key]
                self._changed.wait()
            return None
        finally:
            self._waits = None
            self._unlocked.pop(hook.key, None)
