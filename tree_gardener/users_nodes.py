"""The nodes of a tree whose code is the user's: what is called once, before the first tick and at the end."""

from collections.abc import Mapping, Sequence
from typing import Any

from tree_gardener.controls.custom import CustomControl
from tree_gardener.errors import TickError, describe
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.node import Node
from tree_gardener.status import IDLE


def setup(nodes: Sequence[Node], node: Any, kwargs: Mapping[str, Any]) -> None:
    """Calls ``setup(node=…)`` of each of the user's nodes once, in pre-order.

    Raises:
        TickError: one raised an exception.
    """
    for own in _users(nodes):
        try:
            own.instance_behaviour.setup(node=node, **kwargs)
        except TickError:
            raise  # a call that the node must not make now; the error names node, line and remedy
        except (Exception, SystemExit) as error:
            raise TickError(own, describe(error), error) from error
        own.note_early_reads()


def shutdown(nodes: Sequence[Node]) -> TickError | None:
    """Calls ``shutdown()`` of each of the user's nodes, even if some raise; returns the first error."""
    first: TickError | None = None
    for own in _users(nodes):
        try:
            own.instance_behaviour.shutdown()
        except TickError as error:
            first = first or error
        except (Exception, SystemExit) as error:
            first = first or TickError(own, describe(error), error)
    return first


def halt_one_by_one(nodes: Sequence[Node]) -> None:
    """Halts each of the user's nodes, after halting the tree failed in one of them; all nodes become IDLE."""
    for own in _users(nodes):
        try:
            own.halt()
        except TickError:
            continue
    for node in nodes:
        node.status = IDLE


def _users(nodes: Sequence[Node]) -> list[BehaviourLeaf | CustomControl]:
    return [node for node in nodes if isinstance(node, (BehaviourLeaf, CustomControl))]
