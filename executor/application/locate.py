"""Maps stack frames to nodes of the tree and lines of actions."""

from __future__ import annotations

import traceback
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, Final

from executor import child_messages
from executor.supervision.pulse import place_in_our_code

if TYPE_CHECKING:
    from types import FrameType

    from tree_gardener import Tree

__all__ = ["Locator", "Place"]

DEPTH: Final = 200
_NO_PLACE: Final = ("", 0)


@dataclass(frozen=True)
class Place:
    """A node, and a line in an action; a field is empty if it is unknown."""

    node_id: str = ""
    tree_id: str = ""
    node_path: str = ""
    node_type: str = ""
    file: str = ""
    line: int = 0
    traceback: str = ""

    @property
    def is_in_action(self) -> bool:
        return bool(self.file or self.node_path)

    def __str__(self) -> str:
        what = f"{self.node_type or 'an action'} '{self.node_path}'" if self.node_path else "an action"
        return f"{what} ({self.file}:{self.line})" if self.file else what

    def to_message(self) -> child_messages.Place | None:
        """Returns the place in the form that a beat carries; None if it is outside of the user's code."""
        return child_messages.Place(str(self), **asdict(self)) if self.is_in_action else None


class Locator:
    """Finds the node to which a stack frame belongs: the node whose behaviour is the frame's `self`."""

    def __init__(self) -> None:
        self._nodes: dict[int, Any] = {}

    def learn(self, tree: Tree) -> None:
        """Stores the behaviours of a tree's nodes, so that their frames can be found, and no others."""
        self._nodes = {}
        for node in tree.nodes:
            behaviour = getattr(node, "instance_behaviour", None)
            if behaviour is not None:
                self._nodes[id(behaviour)] = node

    def node_of(self, frame: FrameType | None) -> Any:
        """Returns the node whose behaviour runs in the innermost method of the stack, or None."""
        for _ in range(DEPTH):
            if frame is None:
                return None
            if frame.f_code.co_argcount:
                owner = frame.f_locals.get(frame.f_code.co_varnames[0])
                node = self._nodes.get(id(owner)) if owner is not None else None
                if node is not None:
                    return node
            frame = frame.f_back
        return None

    def place_of_error(self, error: BaseException) -> Place:
        """Returns the place where an exception was raised."""
        trace, frame = error.__traceback__, None
        while trace is not None:
            frame, trace = trace.tb_frame, trace.tb_next
        return self.place_of(frame)

    def beat_place(self, frame: FrameType | None) -> child_messages.Place:
        """Returns the place of the main thread for a beat: in the user's code, otherwise in BT Studio's."""
        return self.place_of(frame).to_message() or place_in_our_code(frame)

    def place_of(self, frame: FrameType | None) -> Place:
        """Returns the node, file and line of the innermost user code on a stack.

        The place is empty if no user code is on the stack.
        """
        node = self.node_of(frame)
        stack = traceback.extract_stack(frame, limit=DEPTH) if frame is not None else []
        first = next((i for i, entry in enumerate(stack) if is_action_file(entry.filename)), None)
        if first is None:
            return Place()
        file, line = next(
            ((e.filename, e.lineno or 0) for e in reversed(stack) if is_action_file(e.filename)), _NO_PLACE
        )
        text = "".join(traceback.format_list(stack[first:]))
        if node is None:
            return Place(file=file, line=line, traceback=text)
        return Place(node.node_id, node.tree_id, node.path, node.type, file, line, text)


def is_action_file(name: str) -> bool:
    """Returns whether a file is an action of the project."""
    return name.startswith("actions/")
