"""A client of Groot2's protocol: it asks another program about its tree.

The other program is not trusted: what it sends is bounded in time, size and depth.
"""

import itertools
import re
from types import TracebackType
from typing import Any, Final

from tree_gardener.groot.libraries import libraries
from tree_gardener.groot.protocol import GrootError, Header, RequestType
from tree_gardener.groot.publisher import LAST_PORT, PORT
from tree_gardener.groot.remote import NodeState, RemoteTree, read_boards, read_statuses, read_tree

TIMEOUT_S: Final = 1.0
LARGEST_REPLY: Final = 16 << 20
_MOST_ITEMS: Final = 100_000
_ADDRESS: Final = re.compile(r"(?P<host>[A-Za-z0-9._-]+|\[[0-9A-Fa-f:.]+\])(:(?P<port>[0-9]{1,5}))?")
_ID_BYTES: Final = 16


class SilenceError(GrootError):
    """The other program did not answer in time."""


def read_address(text: str) -> tuple[str, int]:
    """Returns host and port of ``HOST[:PORT]``.

    Raises:
        GrootError: it is something else, such as an address of ZeroMQ's own.
    """
    found = _ADDRESS.fullmatch(text)
    port = int(found["port"] or PORT) if found is not None else 0
    if found is None or not 0 < port <= LAST_PORT:
        raise GrootError(f"{text!r} is not HOST or HOST:PORT, such as robot.local:{PORT}")
    return found["host"], port


class Groot2Client:
    """Asks a publisher of Groot2's protocol, such as any program of BehaviorTree.CPP 4 can have.

    Args:
        host: a name or an address.
        port: the port of the publisher.
        timeout_s: the time in which each answer has to come.

    Attributes:
        publisher: the 16 bytes that name the publisher which answered last; others after it was replaced.

    Raises:
        ModuleNotFoundError: pyzmq or msgpack is not installed.
    """

    def __init__(self, host: str, port: int = PORT, timeout_s: float = TIMEOUT_S) -> None:
        self._zmq, self._msgpack = libraries()
        self.publisher = b""
        self._address = f"tcp://{host}:{port}"
        self._timeout_msec = round(timeout_s * 1000)
        self._numbers = itertools.count(1)
        self._context = self._zmq.Context()
        self._socket: Any = None

    def close(self) -> None:
        """Ends the connection."""
        self._drop()
        self._context.term()

    def __enter__(self) -> "Groot2Client":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def tree(self) -> RemoteTree:
        """Returns the tree of the other program.

        Raises:
            SilenceError: there was no answer in time.
            GrootError: the answer cannot be used.
        """
        document = self._ask(RequestType.FULL_TREE)
        return read_tree(self.publisher, document)

    def statuses(self) -> tuple[dict[int, NodeState], int]:
        """Returns the states of nodes by uid, and the number of entries that could not be read.

        Raises:
            SilenceError, GrootError: as `tree`.
        """
        return read_statuses(self._ask(RequestType.STATUS))

    def blackboards(self, scopes: tuple[str, ...]) -> dict[str, dict[str, Any]]:
        """Returns blackboards by name.

        Raises:
            SilenceError, GrootError: as `tree`.
        """
        content = self._ask(RequestType.BLACKBOARD, ";".join(scopes).encode())
        try:
            document = self._msgpack.unpackb(
                content,
                strict_map_key=False,
                max_str_len=LARGEST_REPLY,
                max_array_len=_MOST_ITEMS,
                max_map_len=_MOST_ITEMS,
            )
        except ValueError as error:
            raise GrootError(f"a blackboard of the other program cannot be read: {error}") from None
        return read_boards(document)

    def _ask(self, kind: RequestType, *content: bytes) -> bytes:
        """Sends a request; returns the content of the reply."""
        header = Header(kind, next(self._numbers)).pack()
        socket = self._connected()
        try:
            socket.send_multipart([header, *content])
            if not socket.poll(self._timeout_msec):
                raise SilenceError(f"no answer of {self._address} in {self._timeout_msec / 1000:g} s")
            reply = socket.recv_multipart()
        except self._zmq.ZMQError as error:
            self._drop()
            raise GrootError(f"{self._address}: {error}") from None
        except SilenceError:
            self._drop()  # a socket that has lost a reply takes no further request
            raise
        return self._read(header, reply)

    def _read(self, header: bytes, reply: list[bytes]) -> bytes:
        if reply[0] == b"error":
            why = b" ".join(reply[1:])[:500].decode(errors="replace")
            raise GrootError(f"the other program refuses: {why}")
        if reply[0][: len(header)] != header or len(reply[0]) != len(header) + _ID_BYTES or len(reply) != 2:
            self._drop()
            raise GrootError(
                "the other program answers in another way than Groot2's protocol 2; BehaviorTree.CPP 3 and"
                " Nav2 of Humble and before speak that of Groot 1"
            )
        self.publisher = reply[0][len(header) :]
        return reply[1]

    def _connected(self) -> Any:
        if self._socket is None:
            zmq = self._zmq
            socket = self._context.socket(zmq.REQ)
            socket.setsockopt(zmq.MAXMSGSIZE, LARGEST_REPLY)
            socket.setsockopt(zmq.LINGER, 0)
            socket.setsockopt(zmq.IPV6, 1)
            socket.connect(self._address)
            self._socket = socket
        return self._socket

    def _drop(self) -> None:
        if self._socket is not None:
            self._socket.close(linger=0)
            self._socket = None
