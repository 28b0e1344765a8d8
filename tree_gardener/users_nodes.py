"""The nodes of a tree whose code is the user's: what is called once, before the first tick and at the end."""

import inspect
from collections.abc import Mapping, Sequence
from typing import Any

from tree_gardener.controls.adapted import inner_behaviours
from tree_gardener.controls.custom import CustomControl
from tree_gardener.errors import TickError, describe
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.node import Node
from tree_gardener.status import IDLE


def setup(nodes: Sequence[Node], node: Any, kwargs: Mapping[str, Any]) -> None:
    """Calls ``setup(node=…)`` of each of the user's nodes once, in pre-order.

    Each gets the arguments that its signature takes: py_trees' own skeleton is ``def setup(self)``.

    Raises:
        TickError: one raised an exception.
    """
    given = {"node": node, **kwargs}
    taken: dict[Any, dict[str, Any]] = {}
    for own in _users(nodes):
        try:
            for behaviour in _objects(own):
                method = behaviour.setup
                function = getattr(method, "__func__", None)
                arguments = taken.get(function)
                if arguments is None:
                    arguments = _taken(method, given)
                if function is not None:
                    taken[function] = arguments
                method(**arguments)
        except TickError:
            raise  # a call that the node must not make now; the error names node, line and remedy
        except (Exception, SystemExit) as error:
            raise TickError(own, describe(error), error) from error
        own.note_early_reads()


def _taken(method: Any, given: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the arguments that a method takes by name."""
    try:
        parameters = inspect.signature(method).parameters
    except (TypeError, ValueError):  # a callable without a signature
        return dict(given)
    if any(each.kind is inspect.Parameter.VAR_KEYWORD for each in parameters.values()):
        return dict(given)
    by_name = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
    return {
        name: value
        for name, value in given.items()
        if name in parameters and parameters[name].kind in by_name
    }


def shutdown(nodes: Sequence[Node]) -> TickError | None:
    """Calls ``shutdown()`` of each of the user's nodes, even if some raise; returns the first error."""
    first: TickError | None = None
    for own in _users(nodes):
        for behaviour in _objects(own):
            try:
                behaviour.shutdown()
            except TickError as error:
                first = first or error
            except (Exception, SystemExit) as error:
                first = first or TickError(own, describe(error), error)
    return first


def end_broken(nodes: Sequence[Node], error: TickError) -> None:
    """Ends the activation of an action whose first tick raised, which a halt of the tree leaves out."""
    node = nodes[error.uid - 1] if error.has_begun else None
    if isinstance(node, BehaviourLeaf):
        node.end_broken()


def halt_one_by_one(nodes: Sequence[Node]) -> None:
    """Halts each of the user's nodes, after halting the tree failed in one of them; all nodes become IDLE."""
    for own in _users(nodes):
        try:
            own.halt()
        except TickError:
            continue
    for node in nodes:
        node.status = IDLE


def _objects(own: BehaviourLeaf | CustomControl) -> list[Any]:
    """Returns the user's object of a node, after those that it made and holds itself."""
    inner = inner_behaviours(own.owner) if isinstance(own, CustomControl) else []
    return [*inner, own.instance_behaviour]


def _users(nodes: Sequence[Node]) -> list[BehaviourLeaf | CustomControl]:
    return [node for node in nodes if isinstance(node, (BehaviourLeaf, CustomControl))]
