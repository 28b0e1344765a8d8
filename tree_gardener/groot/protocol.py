"""Messages of Groot2's protocol, version 2: what a client asks, and the bytes of the answers.

A request and its reply are multipart messages of ZeroMQ, little-endian. The first part is a header, the
second the content. Source: ``groot2_protocol.h`` and ``groot2_publisher.cpp`` of BehaviorTree.CPP 4, and
replies of a real publisher.
"""

import dataclasses
import enum
import json
import struct
from collections.abc import Iterable, Mapping
from typing import Any, Final, NamedTuple

from tree_gardener.status import IDLE, Status

VERSION: Final = 2
PORT: Final = 1667
"""The usual port; the next one has the messages that nobody asks for."""
LAST_PORT: Final = 65534
WIRE_STATUS: Final = {
    Status.IDLE: 0,
    Status.RUNNING: 1,
    Status.SUCCESS: 2,
    Status.FAILURE: 3,
    Status.SKIPPED: 4,
}
BECAME_IDLE: Final = 10
"""Is added to the status that a node had before it became IDLE."""
LONGEST_REQUEST: Final = 1 << 20
MOST_HOOKS: Final = 10_000

_HEADER: Final = struct.Struct("<BBI")
_STATUS: Final = struct.Struct("<HB")


class GrootError(ValueError):
    """A request cannot be answered; the text is sent to the client."""


class RequestType(enum.Enum):
    """The types of requests, and of the message that tells that a hook was reached."""

    FULL_TREE = "T"
    STATUS = "S"
    BLACKBOARD = "B"
    HOOK_INSERT = "I"
    HOOK_REMOVE = "R"
    HOOKS_REMOVE_ALL = "A"
    HOOKS_DISABLE = "X"
    HOOKS_DUMP = "D"
    UNLOCK = "U"
    RECORDING = "r"
    TRANSITIONS = "t"
    REACHED = "N"


class Header(NamedTuple):
    """The first part of a message."""

    type: RequestType
    id: int

    def pack(self) -> bytes:
        """Returns the bytes of the header."""
        return _HEADER.pack(VERSION, ord(self.type.value), self.id)

    @classmethod
    def read(cls, data: bytes) -> "Header":
        """Reads a header.

        Raises:
            GrootError: it has another length, version or type.
        """
        if len(data) != _HEADER.size:
            raise GrootError("wrong request header")
        version, kind, number = _HEADER.unpack(data)
        if version != VERSION:
            raise GrootError(f"protocol {version} is not spoken here, only {VERSION}")
        try:
            return cls(RequestType(chr(kind)), number)
        except ValueError:
            raise GrootError("Request not recognized") from None


class Position(enum.IntEnum):
    """Whether a hook acts in place of a node's tick, or after it."""

    BEFORE = 0
    AFTER = 1


class Mode(enum.IntEnum):
    """Whether a hook waits to be unlocked, or forces a result at once."""

    BREAKPOINT = 0
    REPLACE = 1


class HookKey(NamedTuple):
    """The place of a hook; there is one at most."""

    uid: int
    position: Position


@dataclasses.dataclass
class Hook:
    """A breakpoint at a node, or a result that is forced on it.

    Attributes:
        key: the node and the position.
        mode: whether it waits or replaces.
        once: whether it is removed after it was reached.
        desired_status: SUCCESS or FAILURE is the node's result; with all others the node does as it would.
        enabled: whether it acts.
    """

    key: HookKey
    mode: Mode
    once: bool
    desired_status: Status
    enabled: bool

    def to_json(self) -> dict[str, Any]:
        """Returns the hook as clients read it."""
        return {
            "desired_status": self.desired_status.name,
            "enabled": self.enabled,
            "mode": int(self.mode),
            "once": self.once,
            "position": int(self.key.position),
            "uid": self.key.uid,
        }


@dataclasses.dataclass(frozen=True)
class Unlock:
    """The answer of a client to a breakpoint that was reached."""

    key: HookKey
    desired_status: Status
    remove_when_done: bool


def read_hooks(data: bytes) -> list[Hook]:
    """Reads one hook, or an array of them.

    Raises:
        GrootError: the text is not JSON, or a field is missing or of another type.
    """
    document = _json(data)
    documents = document if isinstance(document, list) else [document]
    if len(documents) > MOST_HOOKS:
        raise GrootError(f"{len(documents)} hooks in one request; {MOST_HOOKS} are the most")
    return [_hook(each) for each in documents]


def read_key(data: bytes) -> HookKey:
    """Reads the place of a hook that is to be removed.

    Raises:
        GrootError: as `read_hooks`.
    """
    return _key(_object(_json(data)))


def read_unlock(data: bytes) -> Unlock:
    """Reads the answer to a breakpoint.

    Raises:
        GrootError: as `read_hooks`.
    """
    document = _object(_json(data))
    return Unlock(_key(document), _status(document), _flag(document, "remove_when_done"))


def pack_statuses(statuses: Iterable[tuple[int, int]]) -> bytes:
    """Returns the statuses of nodes, 3 bytes each, from uids and statuses of the wire."""
    return b"".join(_STATUS.pack(uid, status) for uid, status in statuses)


def pack_transition(time_us: int, uid: int, status: Status) -> bytes:
    """Returns a transition, 9 bytes: microseconds since the start of the recording, uid, status."""
    return time_us.to_bytes(6, "little") + _STATUS.pack(uid, WIRE_STATUS[status])


def wire_status(status: Status, before: int) -> int:
    """Returns the status of a node as it is sent.

    Args:
        status: its status now.
        before: what was sent before; a node that became IDLE is sent with the status that it had.
    """
    if status is not IDLE:
        return WIRE_STATUS[status]
    return before + BECAME_IDLE if 0 < before < BECAME_IDLE else before


def _json(data: bytes) -> Any:
    try:
        return json.loads(data)
    except (ValueError, RecursionError) as error:
        raise GrootError(f"the second part is not JSON: {str(error)[:200]}") from None


def _object(document: Any) -> Mapping[str, Any]:
    if not isinstance(document, dict):
        raise GrootError("the second part is not a JSON object")
    return document


def _hook(document: Any) -> Hook:
    fields = _object(document)
    try:
        mode = Mode(_number(fields, "mode"))
    except ValueError:
        raise GrootError("'mode' is 0 for a breakpoint or 1 to replace the result") from None
    return Hook(_key(fields), mode, _flag(fields, "once"), _status(fields), _flag(fields, "enabled"))


def _key(fields: Mapping[str, Any]) -> HookKey:
    try:
        position = Position(_number(fields, "position"))
    except ValueError:
        raise GrootError("'position' is 0 for before the tick or 1 for after it") from None
    return HookKey(_number(fields, "uid"), position)


def _number(fields: Mapping[str, Any], name: str) -> int:
    value = fields.get(name)
    if not isinstance(value, int) or isinstance(value, bool):
        raise GrootError(f"'{name}' is missing or not a whole number")
    return value


def _flag(fields: Mapping[str, Any], name: str) -> bool:
    value = fields.get(name)
    if not isinstance(value, bool):
        raise GrootError(f"'{name}' is missing or neither true nor false")
    return value


def _status(fields: Mapping[str, Any]) -> Status:
    value = fields.get("desired_status")
    found = Status.__members__.get(value) if isinstance(value, str) else None
    if found is None:
        raise GrootError(f"'desired_status' is missing or none of {', '.join(Status.__members__)}")
    return found
