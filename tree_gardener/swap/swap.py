"""The exchange of a running tree for a changed one, all or nothing."""

from typing import Any

from tree_gardener import tree_tools, users_nodes
from tree_gardener.controls.custom import CustomControl
from tree_gardener.errors import TickError, describe
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.node import Node
from tree_gardener.status import IDLE
from tree_gardener.swap.adoption import adopt
from tree_gardener.swap.capturing import behaviour_of, capture, scopes_of
from tree_gardener.swap.plan import Fate, Plan, plan
from tree_gardener.swap.state import Key, TreeState, keys_of
from tree_gardener.tree import Tree
from tree_gardener.type_words import type_words

CARRY_OVER = "carry_over"
"""The method of an action that takes over from the object of its changed class, which is the argument."""


class SwapRefusedError(Exception):
    """The new tree cannot take over from the old one, which continues.

    Attributes:
        plan: the plan, with its conflicts.
    """

    def __init__(self, found: Plan) -> None:
        first = found.conflicts[0]
        scope = f" in '{first.scope}'" if first.scope else ""
        old, new = type_words(first.old), type_words(first.new)
        super().__init__(
            f"the entry '{first.key}'{scope} holds {old} and would hold {new}"
            + (f", and {len(found.conflicts) - 1} more" if len(found.conflicts) > 1 else "")
        )
        self.plan = found


class Swap:
    """The exchange of a tree that runs for another one, between two ticks.

    The old tree is not touched until `run`, and continues if `run` raises.

    Attributes:
        plan: what stays, begins, and is halted.
        old_state: the state of the old tree when the plan was made.
        new_state: the state of the new tree before it takes over.
        is_done: whether the exchange was made.
    """

    def __init__(self, old: Tree, new: Tree) -> None:
        self.old = old
        self.new = new
        self.old_state = capture(old)
        self.new_state = capture(new)
        self.plan = plan(self.old_state, self.new_state)
        self.is_done = False
        self._old_keys = keys_of(old.nodes)
        self._new_keys = keys_of(new.nodes)
        tree_tools.use_blackboard(old.blackboard)  # the last tree that was made has taken this place

    def run(self, node: Any = None, **kwargs: Any) -> Tree:
        """Makes the exchange; returns the new tree, which continues where the old one was.

        New objects are set up first; those of a changed class may take over from the old ones in their method
        ``carry_over(old)``. Then the old tree halts what cannot continue. What it no longer needs is shut
        down at the end.

        Args:
            node: the rclpy node, or None.
            kwargs: passed on to ``setup``.

        Raises:
            SwapRefusedError: an entry of the blackboard has another type in the new tree.
            TickError: code of the user raised an exception. The old tree continues, unless it was raised by a
                halt: the exchange is complete then.
        """
        if self.plan.conflicts:
            raise SwapRefusedError(self.plan)
        kept = self._kept()
        begun = [node_ for node_ in self.new.nodes if self._new_keys[node_.uid] not in kept]
        try:
            users_nodes.setup(begun, node, kwargs)
            self._carry_over()
        except TickError:
            users_nodes.shutdown(begun)
            raise
        self.is_done = True  # from here on only the new tree can continue
        failed = self._halt()
        self.new.use_clock(self.old.clock)
        self.new.on_error, self.new.on_warning = self.old.on_error, self.old.on_warning
        adopt(self.new, self._state_now(), kept, self.new_state)
        self._move_timers(kept)
        self._share_scopes()
        tree_tools.use_blackboard(self.new.blackboard)
        left = [node_ for node_ in self.old.nodes if self._old_keys[node_.uid] not in kept]
        failed = users_nodes.shutdown(left) or failed
        if failed is not None:
            raise failed
        return self.new

    def _state_now(self) -> TreeState:
        """Returns the state of the old tree; users' code may have written entries since the plan was made."""
        is_as_planned = not self.plan.halted and self.old.tick_number == self.old_state.tick
        return capture(self.old, self.old_state if is_as_planned else None)

    def _kept(self) -> dict[Key, Any]:
        """Returns the user's objects that continue."""
        return {
            key: behaviour
            for node in self.old.nodes
            if self.plan.fates[key := self._old_keys[node.uid]] is Fate.KEPT
            and (behaviour := behaviour_of(node)) is not None
        }

    def _carry_over(self) -> None:
        before = {self._old_keys[node.uid]: node for node in self.old.nodes}
        for node in self.new.nodes:
            key = self._new_keys[node.uid]
            if self.plan.fates.get(key) is not Fate.RENEWED:
                continue
            assert isinstance(node, (BehaviourLeaf, CustomControl))  # only they have code
            take = getattr(node.instance_behaviour, CARRY_OVER, None)
            if take is None:
                continue
            try:
                take(behaviour_of(before[key]))
            except (Exception, SystemExit) as error:
                raise TickError(node, describe(error), error) from error

    def _halt(self) -> TickError | None:
        """Halts what cannot continue; returns the first error, after which all else is halted too."""
        halted = set(self.plan.halted)
        first: TickError | None = None
        for node in self.old.nodes:
            if self._old_keys[node.uid] not in halted or self._has_halted(node.parent, halted):
                continue
            try:
                node.stop()
            except TickError as error:
                first = first or error
                _reset(node)
        return first

    def _has_halted(self, parent: Node | None, halted: set[Key]) -> bool:
        return parent is not None and self._old_keys[parent.uid] in halted

    def _move_timers(self, kept: dict[Key, Any]) -> None:
        """Moves the timers that kept control nodes of the user have started."""
        owners = {id(behaviour) for behaviour in kept.values()}
        for _, order, timer in self.old.timers.heap:
            if id(timer.owner) in owners and timer.callback is not None:
                self.new.timers.restore(timer, order)
        self.old.timers.heap.clear()

    def _share_scopes(self) -> None:
        """Gives the scopes of the old tree the entries of the new one.

        A kept action may hold the text of a port that it read at its start, and that leads to an old scope.
        """
        scopes = scopes_of(self.new, self._new_keys)
        for key, board in scopes_of(self.old, self._old_keys).items():
            after = scopes.get(key)
            if after is not None:
                board.entries, board.remapping, board.autoremap = (
                    after.entries,
                    after.remapping,
                    after.autoremap,
                )
                board.parent, board.root = after.parent, after.root


def _reset(node: Node) -> None:
    """Makes a node and all below it IDLE, after an error in its halt."""
    stack = [node]
    while stack:
        below = stack.pop()
        below.status = IDLE
        stack += below.children
