"""Answers to the requests of Groot2's protocol, from the copies of a tree and its hooks."""

import json
import uuid
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Final

from tree_gardener.groot.document import document_of
from tree_gardener.groot.hooks import Hooks
from tree_gardener.groot.mirror import Mirror, Pack
from tree_gardener.groot.protocol import (
    LONGEST_REQUEST,
    GrootError,
    Header,
    RequestType,
    read_hooks,
    read_key,
    read_unlock,
)

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

Content = bytes | None
_CHANGES: Final = frozenset({RequestType.HOOK_INSERT, RequestType.HOOK_REMOVE, RequestType.UNLOCK})
"""The requests that hold the tree or change its results."""


class Answers:
    """Answers requests about one tree, on the publisher's thread.

    Args:
        tree: the tree, whose document is written once.
        mirror: the copies of its state.
        hooks: its hooks.
        pack: writes a value as MessagePack.
        looks_only: whether requests that hold or change the tree are refused.
    """

    def __init__(
        self, tree: "Tree", mirror: Mirror, hooks: Hooks, pack: Pack, *, looks_only: bool = False
    ) -> None:
        self._looks_only = looks_only
        self.id: Final = uuid.uuid4().bytes
        self._document = document_of(tree)
        self._mirror = mirror
        self._hooks = hooks
        self._pack = pack
        self._answers: dict[RequestType, Callable[[], Content]] = {
            RequestType.FULL_TREE: lambda: self._document,
            RequestType.STATUS: mirror.statuses,
            RequestType.HOOKS_DUMP: lambda: json.dumps(hooks.dump(), separators=(",", ":")).encode(),
            RequestType.HOOKS_REMOVE_ALL: hooks.remove_all,
            RequestType.HOOKS_DISABLE: lambda: hooks.enable_all(on=False),
            RequestType.TRANSITIONS: mirror.take_transitions,
        }
        self._answers_with_content: dict[RequestType, Callable[[bytes], Content]] = {
            RequestType.BLACKBOARD: self._blackboards,
            RequestType.HOOK_INSERT: lambda content: hooks.insert(read_hooks(content)),
            RequestType.HOOK_REMOVE: lambda content: hooks.remove(read_key(content)),
            RequestType.UNLOCK: lambda content: hooks.unlock(read_unlock(content)),
            RequestType.RECORDING: self._recording,
        }

    def answer(self, parts: Sequence[bytes]) -> list[bytes]:
        """Returns the parts of the reply to a request; what is wrong with it, in two parts."""
        try:
            header = Header.read(parts[0])
            content = self._content(header.type, parts)
        except GrootError as error:
            return [b"error", str(error).encode()]
        reply = [header.pack() + self.id]
        return reply if content is None else [*reply, content]

    def _content(self, kind: RequestType, parts: Sequence[bytes]) -> Content:
        if self._looks_only and kind in _CHANGES:
            raise GrootError("this program can only be looked at; it is held and forced by its own debugger")
        if kind in self._answers:
            return self._answers[kind]()
        if kind not in self._answers_with_content:
            raise GrootError("Request not recognized")
        if len(parts) != 2:
            raise GrootError("must be 2 parts message")
        if len(parts[1]) > LONGEST_REQUEST:
            raise GrootError(f"a request of {len(parts[1])} bytes; {LONGEST_REQUEST} are the most")
        return self._answers_with_content[kind](parts[1])

    def _blackboards(self, content: bytes) -> bytes:
        names = content.decode("utf-8", "replace").split(";")
        return self._pack(self._mirror.blackboards(names))

    def _recording(self, content: bytes) -> Content:
        if content == b"start":
            return str(self._mirror.start_recording()).encode()
        if content == b"stop":
            self._mirror.stop_recording()
            return None
        raise GrootError("a recording is 'start' or 'stop'")
