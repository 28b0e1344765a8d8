"""Functions that actions give to others to call: each belongs to the action that gave it.

Its exception is one of that action: with ``on_error: failure`` the action fails at its next tick if it is
RUNNING; otherwise the run stops.
"""

import functools
import inspect
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.controls.custom import CustomControl
from tree_gardener.errors import TickError, describe
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.status import RUNNING

if TYPE_CHECKING:
    from types import FrameType

UsersNode = BehaviourLeaf | CustomControl
ERRORS: Final = (Exception, SystemExit)
NODE: Final = "tree_gardener_node"


def owner() -> Any:
    """Returns the user's object whose code runs now, by the innermost frame of one; None without one."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        code = frame.f_code
        if code.co_argcount:
            first: Any = frame.f_locals.get(code.co_varnames[0])
            if isinstance_of(first, Owned):
                return first.owner
            if isinstance_of(first, UsersNode):
                return first.instance_behaviour
            if NODE in attributes_of(first):
                return first
        frame = frame.f_back
    return None


def owned(callback: Any, otherwise: Callable[[TickError], Any] | None = None) -> Any:
    """Returns a function to call in place of a callback, if an action gives the callback; else the callback.

    Args:
        callback: what is called; coroutine functions stay coroutine functions.
        otherwise: returns what the caller gets where an exception makes the action fail at its next tick.
    """
    mine = owner()
    if mine is None or not callable(callback) or isinstance_of(callback, Owned):
        return callback
    guarded = Owned(callback, mine, otherwise)
    return guarded.coroutine() if inspect.iscoroutinefunction(callback) else guarded


class Owned:
    """A callback of an action. It equals the callback, by which others remove it.

    Attributes:
        owner: the user's object; its node may change while the tree runs.
    """

    def __init__(
        self, callback: Any, owner: Any, otherwise: Callable[[TickError], Any] | None = None
    ) -> None:
        functools.update_wrapper(self, callback, updated=())
        self.owner = owner
        self._callback = callback
        self._otherwise = otherwise

    def __call__(self, *arguments: Any, **options: Any) -> Any:
        """Calls the callback; an exception is one of its owner."""
        try:
            return self._callback(*arguments, **options)
        except ERRORS as error:
            return self._failed(error)

    def __eq__(self, other: object) -> bool:
        return bool(self._callback == (other._callback if isinstance(other, Owned) else other))

    def __hash__(self) -> int:
        return hash(self._callback)

    def coroutine(self) -> Any:
        """Returns a coroutine function that does the same."""

        async def call(owned: Owned, *arguments: Any, **options: Any) -> Any:
            try:
                return await owned._callback(*arguments, **options)
            except ERRORS as error:
                return owned._failed(error)

        async def bound(*arguments: Any, **options: Any) -> Any:
            return await call(self, *arguments, **options)

        return functools.update_wrapper(bound, self._callback, updated=())

    def _failed(self, error: Exception | SystemExit) -> Any:
        fault = raised_by(self.owner, error)
        return None if self._otherwise is None else self._otherwise(fault)


def raised_by(behaviour: Any, error: Exception | SystemExit) -> TickError:
    """Makes a node fail at its next tick because of an exception of its callback; returns the error.

    Raises:
        TickError: the node is not RUNNING, or an error stops the run.
    """
    node: UsersNode = behaviour.tree_gardener_node
    fault = error if isinstance(error, TickError) else TickError(node, describe(error), error)
    tree = node.tree
    if tree.current_uid == node.uid:  # the node spins within its own tick, which fails
        raise fault from error
    if tree.on_error is None or node.status is not RUNNING:
        tree.fault = fault  # code of another action that spins may catch the exception
        raise fault from error
    fail_next(node, fault)
    return fault


def fail_next(node: UsersNode, fault: TickError) -> None:
    """Makes the next tick of a RUNNING node fail; it does nothing if the node is halted before."""
    before = node.update
    waiting = [fault]

    def update() -> Any:
        if not waiting:
            return before()
        node.replace_update(before)
        error = waiting.pop()
        if node.status is RUNNING:
            raise error
        return before()

    node.replace_update(update)


def isinstance_of(thing: Any, kinds: Any) -> bool:
    """Returns whether a user's object has one of some types, without asking the object."""
    return issubclass(type(thing), kinds)


def attributes_of(thing: Any) -> Any:
    """Returns the attributes of a user's object, without asking the object."""
    try:
        return object.__getattribute__(thing, "__dict__")
    except AttributeError:
        return {}
