"""Errors, each with its place.

```
TreeGardenerError
├── LoadError      a document that is refused; carries one Diagnostic for each thing that is wrong
├── TickError      a node that failed to do its work; carries node, file, line and the cause
├── ScriptError    a script that does not parse or cannot be evaluated; carries the span
└── PortError      a port that cannot be read or written
    └── PortRefusedError   a new text for a port that is refused; carries the Diagnostic
```
"""

import dataclasses
import sys
import traceback
from collections.abc import Iterable, Sequence
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from tree_gardener.node import Node


DOCUMENT: Final = "tree.xml"
"""The name of a document that has none."""


class TreeGardenerError(Exception):
    """The base of all errors of this package."""


@dataclasses.dataclass(frozen=True)
class Diagnostic:
    """One thing that is wrong with a document.

    Attributes:
        code: the stable code, such as ``TG103``.
        message: what is wrong, in one sentence.
        hint: what to do about it, or "".
        severity: ``error`` or ``warning``.
        file: the name of the document.
        line: from 1; 0 when unknown.
        column: from 1; 0 when unknown.
        tree: the ID of the BehaviorTree, or "".
        node: the node's tag, or "".
        node_id: the node's ``_bts_id``, or "".
        port: the port or attribute concerned, or "".
    """

    code: str
    message: str
    hint: str = ""
    severity: str = "error"
    file: str = DOCUMENT
    line: int = 0
    column: int = 0
    tree: str = ""
    node: str = ""
    node_id: str = ""
    port: str = ""

    def __str__(self) -> str:
        hint = f" ({self.hint})" if self.hint else ""
        return f"{self.file}:{self.line}:{self.column}: {self.code} {self.message}{hint}"

    def to_json(self) -> dict[str, Any]:
        """Returns the fields as a JSON object."""
        return dataclasses.asdict(self)


class LoadError(TreeGardenerError):
    """The document is refused.

    Attributes:
        diagnostics: what is wrong; at least one.
    """

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        self.diagnostics = list(diagnostics)
        super().__init__("\n".join(str(diagnostic) for diagnostic in self.diagnostics))


class ScriptError(TreeGardenerError):
    """A script does not parse, or cannot be evaluated.

    Attributes:
        span: start and end offsets in the script's text.
        message: what is wrong.
        hint: what to do about it, or "".
    """

    def __init__(self, span: tuple[int, int], message: str, hint: str = "") -> None:
        self.span = span
        self.message = message
        self.hint = hint
        super().__init__(message + (f" ({hint})" if hint else ""))


class PortError(TreeGardenerError):
    """A port cannot be read or written: missing, empty, or not convertible."""


class PortRefusedError(PortError):
    """A port of a running tree does not take a new text.

    Attributes:
        diagnostic: what is wrong, with the node and the port.
    """

    def __init__(self, diagnostic: Diagnostic) -> None:
        self.diagnostic = diagnostic
        hint = f" ({diagnostic.hint})" if diagnostic.hint else ""
        super().__init__(f"{diagnostic.message}{hint}")


class TickError(TreeGardenerError):
    """A node raised an exception while it was ticked, halted or set up.

    Attributes:
        uid: the node's uid.
        path: its path.
        node_id: its ``_bts_id``, or "".
        node_type: its tag.
        tree_id: the BehaviorTree that it belongs to.
        file: where the exception was raised, as near to the user's own code as the traceback shows; else
            where the class of the node is written; or "".
        line: the line in that file, or 0.
        message: type and text of the exception.
        traceback_text: the whole traceback, without the engine's own frames.
        cause: the exception itself, or None when the engine found the fault.
        code: stable, such as ``TG701``, for a node that broke the contract of control nodes; else "".
        hint: what to do about it, or "".
    """

    def __init__(  # noqa: PLR0913 - most are rare
        self,
        node: "Node",
        message: str,
        cause: BaseException | None = None,
        *,
        code: str = "",
        hint: str = "",
        place: tuple[str, int] = ("", 0),
    ) -> None:
        self.uid = node.uid
        self.path = node.path
        self.node_id = node.node_id
        self.node_type = node.type
        self.tree_id = node.tree_id
        self.cause = cause
        self.code = code
        self.hint = hint
        self.message = message = f"{message} ({hint})" if hint else message
        if cause is not None:
            place = _locate(cause.__traceback__)
            if not place[0]:  # the call itself failed, or no method was there to be called
                place = class_place(node)
        self.file, self.line = place
        self.traceback_text = _format(cause)
        at = f" at {self.file}:{self.line}" if self.file else ""
        super().__init__(f"node '{self.path}' [{self.node_type}]: {message}{at}")


_PACKAGE = __file__.rsplit("/", 1)[0] + "/"
_LIBRARIES = frozenset(("tree_gardener", "py_trees", "builtins", "abc"))


def _locate(trace: TracebackType | None) -> tuple[str, int]:
    """Returns the innermost line of an action; if there is none, the innermost line outside of the engine."""
    return _nearest((frame.filename, frame.lineno or 0) for frame in traceback.extract_tb(trace))


def _nearest(places: Iterable[tuple[str, int]]) -> tuple[str, int]:
    outside = [place for place in places if not place[0].startswith(_PACKAGE)]
    actions = [place for place in outside if place[0].startswith("actions/") or "/actions/" in place[0]]
    nearest = actions or outside
    return nearest[-1] if nearest else ("", 0)


def raised_at(error: BaseException) -> tuple[str, int]:
    """Returns file and line of the user's code that raised an exception, or ("", 0)."""
    return _locate(error.__traceback__)


def calling_place() -> tuple[str, int]:
    """Returns file and line of the user's code that called the engine, or ("", 0)."""
    places = []
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        places.append((frame.f_code.co_filename, frame.f_lineno))
        frame = frame.f_back
    return _nearest(reversed(places))


def class_place(node: "Node") -> tuple[str, int]:
    """Returns file and line of the user's class of a node, or ("", 0)."""
    return place_of(type(getattr(node, "instance_behaviour", None)))


def place_of(cls: type) -> tuple[str, int]:
    """Returns file and line of a user's class, by its `update` or its first method; ("", 0) if unknown."""
    for base in cls.__mro__:
        if base.__module__.partition(".")[0] in _LIBRARIES:
            continue
        for function in (base.__dict__.get("update"), *base.__dict__.values()):
            code = getattr(getattr(function, "__func__", function), "__code__", None)
            if code is not None:
                return code.co_filename, code.co_firstlineno
        file = getattr(sys.modules.get(base.__module__), "__file__", None)
        if file:
            return file, 1
    return "", 0


def _format(cause: BaseException | None) -> str:
    if cause is None:
        return ""
    trace = cause.__traceback__
    while trace is not None and trace.tb_frame.f_code.co_filename.startswith(_PACKAGE):
        trace = trace.tb_next
    return "".join(traceback.format_exception(type(cause), cause, trace))


def describe(error: BaseException) -> str:
    """Returns type and text of an exception, in one line."""
    if isinstance(error, SystemExit):
        return f"the action called sys.exit({error.code!r})"
    text = str(error)
    return f"{type(error).__name__}: {text}" if text else type(error).__name__
