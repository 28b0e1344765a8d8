"""A tree of another program, as its publisher describes it; everything that comes is checked."""

import dataclasses
import re
import struct
from collections.abc import Iterator
from typing import Any, Final

from tree_gardener.document import Element, parse_document
from tree_gardener.errors import LoadError
from tree_gardener.groot.protocol import BECAME_IDLE, WIRE_STATUS, GrootError
from tree_gardener.status import IDLE, Status

_UID: Final = re.compile(r"[0-9]{1,5}")
_STATUS: Final = struct.Struct("<HB")
_TRANSITION: Final = struct.Struct("<IHHB")
Transition = tuple[int, int, int, int]
"""A change of a node: the lower 32 and upper 16 bits of the time in µs, which counts from the begin of the
recording or from the epoch; the uid; and the number of the status from then on.
"""
_OF_WIRE: Final = {number: status for status, number in WIRE_STATUS.items()}
LAST_STATUS: Final = max(_OF_WIRE)
_MOST_NODES: Final = 0xFFFF
"""Uids have two bytes."""


@dataclasses.dataclass(frozen=True)
class RemoteNode:
    """A node of another program's tree.

    Attributes:
        uid: its number.
        parent: that of the node above it; 0 for the root.
        type: the tag of the node in XML.
        name: its name.
        path: the path of its instance of a BehaviorTree, and its name.
        depth: the nodes above it, over all instances.
        attributes: its ports and conditions, as in XML.
    """

    uid: int
    parent: int
    type: str
    name: str
    path: str
    depth: int
    attributes: dict[str, str]


@dataclasses.dataclass(frozen=True)
class NodeState:
    """The state of a node of another program.

    Attributes:
        status: its status.
        was: what it was before it became IDLE; IDLE if that is not known.
    """

    status: Status
    was: Status = IDLE


_STATES: Final = {BECAME_IDLE + number: NodeState(IDLE, was) for number, was in _OF_WIRE.items()} | {
    number: NodeState(status) for number, status in _OF_WIRE.items()
}
"""The state of each number; there is one object of each, so that equal ones are found at once."""


@dataclasses.dataclass(frozen=True)
class RemoteTree:
    """The tree of another program.

    Attributes:
        id: the 16 bytes that its publisher has for as long as it lives.
        document: the XML, as it came.
        nodes: the nodes in pre-order, with those of subtrees below their SubTree nodes.
        scopes: the names of its blackboards.
    """

    id: bytes
    document: bytes
    nodes: tuple[RemoteNode, ...]
    scopes: tuple[str, ...]


def read_tree(publisher: bytes, document: bytes) -> RemoteTree:
    """Reads the description of a tree.

    Raises:
        GrootError: it is not XML, is too large, names no tree, or its instances lead round in a circle.
    """
    try:
        root = parse_document(document, "the tree of the other program").root
    except LoadError as error:
        raise GrootError(str(error)) from None
    trees = [each for each in root.children if each.tag == "BehaviorTree"]
    if not trees:
        raise GrootError("the other program described no tree")
    instances = {each.attributes.get("_fullpath", ""): each for each in reversed(trees)}
    nodes = tuple(_nodes(trees[0], "", instances))
    scopes = [path or trees[0].attributes.get("ID", "") for path in reversed(instances)]
    return RemoteTree(publisher, document, nodes, tuple(scopes))


def _nodes(main: Element, path: str, instances: dict[str, Element]) -> Iterator[RemoteNode]:
    stack = [(child, path, 0, 0) for child in reversed(main.children)]
    entered = {path}
    found = 0
    while stack:
        element, around, depth, parent = stack.pop()
        found += 1
        uid = element.attributes.get("_uid", "")
        if not _UID.fullmatch(uid) or int(uid) > _MOST_NODES or found > _MOST_NODES:
            raise GrootError(f"a node {element.tag} of the other program has no uid up to {_MOST_NODES}")
        below, inner = element.children, around
        full = element.attributes.get("_fullpath", "")
        if element.tag == "SubTree":
            if full in entered or full not in instances:
                raise GrootError(f"the other program describes the SubTree '{full}' not once")
            entered.add(full)
            below, inner = instances[full].children, full
        own = full.rpartition("/")[2] if element.tag == "SubTree" else element.attributes.get("name", "")
        name = own or element.tag
        where = f"{around}/{name}" if around else name
        yield RemoteNode(int(uid), parent, element.tag, name, where, depth, element.attributes)
        stack += [(child, inner, depth + 1, int(uid)) for child in reversed(below)]


def read_statuses(data: bytes) -> tuple[dict[int, NodeState], int]:
    """Returns the states of nodes by uid, and the number of entries that could not be read."""
    whole = len(data) - len(data) % _STATUS.size
    dropped = 1 if whole < len(data) else 0
    states: dict[int, NodeState] = {}
    known = _STATES.get
    for uid, number in _STATUS.iter_unpack(data[:whole]):
        if (state := known(number)) is not None:
            states[uid] = state
        else:
            dropped += 1
    return states, dropped


def read_transitions(data: bytes) -> tuple[Iterator[Transition], int]:
    """Returns the transitions of a reply, and the number of entries that could not be read.

    Those with a status above `LAST_STATUS` are counted, and among those that are returned.
    """
    whole = len(data) - len(data) % _TRANSITION.size
    statuses = data[_TRANSITION.size - 1 : whole : _TRANSITION.size]
    dropped = len(statuses.translate(None, bytes(_OF_WIRE))) + (1 if whole < len(data) else 0)
    return _TRANSITION.iter_unpack(data[:whole]), dropped


def read_boards(document: Any) -> dict[str, dict[str, Any]]:
    """Returns blackboards by name from a message; what has another form is left out."""
    if not isinstance(document, dict):
        return {}
    return {
        name: {key: value for key, value in (board or {}).items() if isinstance(key, str)}
        for name, board in document.items()
        if isinstance(name, str) and (board is None or isinstance(board, dict))
    }
