"""A client of Groot2's protocol: it asks another program about its tree.

The other program is not trusted: what it sends is bounded in time, size and depth.
"""

import itertools
import json
import re
import time
from collections.abc import Iterable, Iterator
from types import TracebackType
from typing import Any, Final

from tree_gardener.groot.libraries import libraries
from tree_gardener.groot.protocol import (
    LAST_PORT,
    PORT,
    GrootError,
    Header,
    Hook,
    HookKey,
    RequestType,
    Unlock,
    read_hooks,
)
from tree_gardener.groot.remote import (
    NodeState,
    RemoteTree,
    Transition,
    read_boards,
    read_statuses,
    read_transitions,
    read_tree,
)

TIMEOUT_S: Final = 1.0
LARGEST_REPLY: Final = 16 << 20
_MOST_ITEMS: Final = 100_000
_ADDRESS: Final = re.compile(r"(?P<host>[A-Za-z0-9._-]+|\[[0-9A-Fa-f:.]+\])(:(?P<port>[0-9]{1,5}))?")
_ANYWHERE: Final = ("0.0.0.0", "[::]", "::", "0")  # noqa: S104 - refused
_ID_BYTES: Final = 16
_CHANGES: Final = frozenset(
    {RequestType.HOOK_INSERT, RequestType.HOOK_REMOVE, RequestType.UNLOCK, RequestType.RECORDING}
)
"""Requests that change something: their reply may be a header alone, and they are not sent twice."""
_UID: Final = re.compile(rb"[0-9]{1,5}")
_MOST_REACHED: Final = 1000


class SilenceError(GrootError):
    """The other program did not answer in time."""


def read_address(text: str) -> tuple[str, int]:
    """Returns host and port of ``HOST[:PORT]``.

    Raises:
        GrootError: it is something else, such as an address of ZeroMQ's own.
    """
    example = f"Write HOST or HOST:PORT, such as robot.local:{PORT}"
    scheme, is_scheme, rest = text.partition("://")
    if is_scheme and scheme == "tcp":
        text = rest
    elif is_scheme or text.startswith(("ipc:", "inproc:")):
        raise GrootError(f"'{scheme.partition(':')[0]}:' is no program that is reached by TCP. {example}.")
    if "*" in text or text.rpartition(":")[0] in _ANYWHERE or text in _ANYWHERE:
        raise GrootError(f"'{text}' stands for every address of a computer, and names no robot. {example}.")
    if ";" in text or "/" in text or "@" in text:
        raise GrootError(f"'{text}' has more than a host and a port, such as a network interface. {example}.")
    found = _ADDRESS.fullmatch(text)
    if found is None:
        raise GrootError(f"'{text[:100]}' is no host and port. {example}.")
    port = int(found["port"] or PORT)
    if not 0 < port < LAST_PORT:
        raise GrootError(f"{port} is no port that can be asked: it is from 1 to {LAST_PORT - 1}. {example}.")
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
        self._events_address = f"tcp://{host}:{port + 1}"
        self._context = self._zmq.Context()
        self._socket: Any = None
        self._monitor: Any = None
        self._was_cut = False
        self._events: Any = None

    def close(self) -> None:
        """Ends the connection."""
        self._drop()
        if self._events is not None:
            self._events.close(linger=0)
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

    def listen(self) -> None:
        """Listens for hooks that are reached; those before it are not heard."""
        if self._events is None:
            self._events = self._open(self._zmq.SUB)
            self._events.setsockopt(self._zmq.SUBSCRIBE, b"")
            self._events.connect(self._events_address)

    def reached(self) -> list[int]:
        """Returns the uids of nodes whose hooks were reached since the last call; it does not wait."""
        uids: list[int] = []
        while self._events is not None and len(uids) < _MOST_REACHED and self._events.poll(0):
            parts = self._events.recv_multipart()
            if len(parts) == 2 and parts[0][1:2] == b"N" and _UID.fullmatch(parts[1]):
                uids.append(int(parts[1]))
        return uids

    def take_cut(self) -> bool:
        """Returns whether the connection was lost since the last call: another process may answer now."""
        self._note_cut()
        was_cut, self._was_cut = self._was_cut, False
        return was_cut

    def insert(self, hooks: Iterable[Hook]) -> None:
        """Inserts hooks, each in place of another at the same position.

        Raises:
            SilenceError, GrootError: as `tree`.
        """
        self._ask(RequestType.HOOK_INSERT, json.dumps([hook.to_json() for hook in hooks]).encode())

    def remove(self, key: HookKey) -> None:
        """Removes a hook; a tree that waits at it continues.

        Raises:
            SilenceError, GrootError: as `tree`.
        """
        self._ask(RequestType.HOOK_REMOVE, json.dumps(_place(key)).encode())

    def hooks(self) -> list[Hook]:
        """Returns all hooks of the other program, those of other clients too.

        Raises:
            SilenceError, GrootError: as `tree`.
        """
        return read_hooks(self._ask(RequestType.HOOKS_DUMP) or b"[]")

    def unlock(self, answer: Unlock) -> None:
        """Continues a tree that waits at a breakpoint.

        Raises:
            SilenceError, GrootError: as `tree`.
        """
        document = _place(answer.key) | {
            "desired_status": answer.desired_status.name,
            "remove_when_done": answer.remove_when_done,
        }
        self._ask(RequestType.UNLOCK, json.dumps(document).encode())

    def record(self, *, on: bool) -> None:
        """Begins or ends that the other program keeps its transitions.

        Raises:
            SilenceError, GrootError: as `tree`.
        """
        self._ask(RequestType.RECORDING, b"start" if on else b"stop")

    def transitions(self) -> tuple[Iterator[Transition], int]:
        """Returns the transitions since the last call, and the number of entries that could not be read.

        The other program keeps 1,000 at most.

        Raises:
            SilenceError, GrootError: as `tree`.
        """
        return read_transitions(self._ask(RequestType.TRANSITIONS))

    def _ask(self, kind: RequestType, *content: bytes) -> bytes:
        """Sends a request; returns the content of the reply."""
        header = Header(kind, next(self._numbers)).pack()
        try:
            reply = self._exchange([header, *content], is_change=kind in _CHANGES)
        except self._zmq.ZMQError as error:
            self._drop()
            raise GrootError(f"{self._address}: {error}") from None
        except SilenceError:
            self._drop()  # a socket that has lost a reply takes no further request
            raise
        return self._read(header, reply, 1 if kind in _CHANGES else 2)

    def _exchange(self, request: list[bytes], *, is_change: bool) -> list[bytes]:
        """Returns the reply of a request.

        A request that was on its way when the connection was cut has no reply: it is sent once more, unless
        it changes something.
        """
        end_s = time.monotonic() + self._timeout_msec / 1000
        socket = self._connected()
        self._note_cut()
        socket.send_multipart(request)
        if not is_change and self._is_cut_before_reply():
            self._drop()
            socket = self._connected()
            socket.send_multipart(request)
        if not socket.poll(max(0, round((end_s - time.monotonic()) * 1000))):
            raise SilenceError(f"no answer of {self._address} in {self._timeout_msec / 1000:g} s")
        return list(socket.recv_multipart())

    def _is_cut_before_reply(self) -> bool:
        """Waits for a reply, a cut, or the end of the time; returns whether it was a cut."""
        poller = self._zmq.Poller()
        for each in (self._socket, self._monitor):
            poller.register(each, self._zmq.POLLIN)
        found = dict(poller.poll(self._timeout_msec))
        return self._monitor in found and self._socket not in found

    def _note_cut(self) -> None:
        while self._monitor is not None and self._monitor.poll(0):
            self._monitor.recv_multipart()
            self._was_cut = True

    def _read(self, header: bytes, reply: list[bytes], least_parts: int) -> bytes:
        if reply[0] == b"error":
            why = b" ".join(reply[1:])[:500].decode(errors="replace")
            raise GrootError(f"the other program refuses: {why}")
        is_ours = reply[0][: len(header)] == header and len(reply[0]) == len(header) + _ID_BYTES
        if not is_ours or not least_parts <= len(reply) <= 2:
            self._drop()
            raise GrootError(
                "the other program answers in another way than Groot2's protocol 2; BehaviorTree.CPP 3 and"
                " Nav2 of Humble and before speak that of Groot 1"
            )
        self.publisher = reply[0][len(header) :]
        return reply[1] if len(reply) > 1 else b""

    def _connected(self) -> Any:
        if self._socket is None:
            self._socket = self._open(self._zmq.REQ)
            self._monitor = self._socket.get_monitor_socket(self._zmq.EVENT_DISCONNECTED)
            self._socket.connect(self._address)
        return self._socket

    def _open(self, kind: int) -> Any:
        zmq = self._zmq
        socket = self._context.socket(kind)
        socket.setsockopt(zmq.MAXMSGSIZE, LARGEST_REPLY)
        socket.setsockopt(zmq.LINGER, 0)
        socket.setsockopt(zmq.IPV6, 1)
        return socket

    def _drop(self) -> None:
        if self._socket is not None:
            self._socket.disable_monitor()
            self._monitor.close(linger=0)
            self._socket.close(linger=0)
            self._socket = self._monitor = None
            self._was_cut = True


def _place(key: HookKey) -> dict[str, Any]:
    return {"uid": key.uid, "position": int(key.position)}
