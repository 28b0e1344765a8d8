"""Random trees as a client of Groot2's protocol sees them: of BehaviorTree.CPP's publisher, and of ours."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

import msgpack

from tests.tree_gardener.debugging.hooked import free_port, run_batch
from tests.tree_gardener.fuzz.reference import Line, run_reference
from tests.tree_gardener.fuzz.trace import run_ours
from tests.tree_gardener.groot.zmtp import Groot2
from tree_gardener import LoadError
from tree_gardener.groot import Groot2Publisher
from tree_gardener.groot.protocol import BECAME_IDLE

if TYPE_CHECKING:
    from tests.tree_gardener.fuzz.generate import Case
    from tree_gardener import Tree

FROM_RUNNING = 11


class Client:
    """A client that asks for everything, and keeps the publisher."""

    def __init__(self, publisher: Any, port: int) -> None:
        self.publisher = publisher
        self.groot = Groot2(port)
        document = ET.fromstring(self.groot.ask("T")[0])  # noqa: S314 - a publisher of the test
        self.trees = [_plain(tree) for tree in document.iter("BehaviorTree")]
        self.groot.ask("r", b"start")
        self.scopes = [tree[1]["_fullpath"] or tree[1]["ID"] for tree in self.trees]

    def look(self) -> dict[str, Any]:
        """The answers after a tick."""
        boards = msgpack.unpackb(self.groot.ask("B", ";".join(self.scopes).encode())[0])
        transitions = self.groot.ask("t")[0]
        return {
            "trees": self.trees,
            "statuses": _by_uid(self.groot.ask("S")[0]),
            "boards": boards,
            "transitions": len(transitions) % 9,
        }


def _by_uid(statuses: bytes) -> list[list[int]]:
    return [list(each) for each in struct.iter_unpack("<HB", statuses)]


def agreed(reference: list[Line], found: list[Line]) -> list[Line]:
    """Our trace, with IDLE after RUNNING where BehaviorTree.CPP has it and the node is IDLE here.

    Our observers are not told of a node that becomes RUNNING and is halted in one tick.
    """
    for expected, line in zip(reference, found, strict=False):
        pairs = zip(_statuses_of(expected), _statuses_of(line), strict=False)
        for theirs_, ours_ in pairs:
            if theirs_[1] == FROM_RUNNING and (ours_[1] == 0 or ours_[1] >= BECAME_IDLE):
                ours_[1] = FROM_RUNNING
    return found


def _statuses_of(line: Line) -> list[list[int]]:
    seen: list[list[int]] = line.get("seen", {}).get("statuses", [])
    return seen


def _plain(element: ET.Element) -> list[Any]:
    return [element.tag, dict(element.attrib), [_plain(child) for child in element]]


def theirs(case: Case) -> list[Line]:
    """The trace of BehaviorTree.CPP."""

    def prepare(tree: Any) -> Client:
        import behaviortreepy as cpp

        port = free_port()
        return Client(cpp.Groot2Publisher(tree, port), port)

    return run_reference(case, prepare, Client.look)


def ours(case: Case) -> list[Line]:
    """Our trace, in the same form."""
    clients: list[Client] = []

    def prepare(tree: Tree) -> Client:
        port = free_port()
        clients.append(Client(Groot2Publisher(tree, port), port))
        tree.fire_timers()  # attaches before the first tick, which would attach as it begins
        return clients[-1]

    try:
        return run_ours(case, prepare, Client.look)
    except LoadError:
        return [{"load": "refused"}]
    finally:
        for client in clients:
            client.groot.close()
            client.publisher.close()


if __name__ == "__main__":
    run_batch(theirs)
