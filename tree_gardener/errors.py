"""Errors, each with its place.

```
TreeGardenerError
├── LoadError      a document that is refused; carries one Diagnostic for each thing that is wrong
├── TickError      a node that failed to do its work; carries node, file, line and the cause
│   └── CallbackError      a callback that belongs to no node raised
├── ScriptError    a script that does not parse or cannot be evaluated; carries the span
└── PortError      a port that cannot be read or written
    └── PortRefusedError   a new text for a port that is refused; carries the Diagnostic
```
"""

import dataclasses
import sys
from collections.abc import Iterable, Sequence
from types import FrameType, TracebackType
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.descriptions import error_text, text_of, traceback_text
from tree_gardener.ros_fields import field_problem, users_frames

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


_SHOWN: Final = 80


def shown(script: str) -> str:
    """Returns a script as messages show it: its first 80 characters."""
    return script if len(script) <= _SHOWN else f"{script[: _SHOWN - 1]}…"


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
        has_begun: whether it was raised in the first tick of an action, which is not RUNNING yet.
    """

    has_begun = False

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


class CallbackError(TickError):
    """A callback that belongs to no node raised an exception."""

    def __init__(self, cause: BaseException) -> None:
        self.uid = 0
        self.path = self.node_id = self.node_type = self.tree_id = self.code = self.hint = ""
        self.cause = cause
        self.message = describe(cause)
        self.file, self.line = _locate(cause.__traceback__)
        self.traceback_text = _format(cause)
        at = f" at {self.file}:{self.line}" if self.file else ""
        Exception.__init__(self, f"a callback that belongs to no node: {self.message}{at}")

    @classmethod
    def of(cls, error: BaseException) -> TickError:
        """Returns an exception outside of a tick as an error with its place."""
        return error if isinstance(error, TickError) else cls(error)


def in_full(error: TickError) -> str:
    """Returns an error with its traceback, for the author of the action."""
    return f"{error}\n{error.traceback_text}"


def warn_of(node: "Node", method: str, error: BaseException) -> None:
    """Reports an exception of a user's method whose result nobody needs; it changes nothing."""
    file, line = _locate(error.__traceback__)
    at = f" at {file}:{line}" if file else ""
    node.tree.warn(node, f"{method}() raised {describe(error)}{at}")


_PACKAGE = __file__.rsplit("/", 1)[0] + "/"
_LIBRARIES = frozenset(("tree_gardener", "py_trees", "builtins", "abc"))


def _locate(trace: TracebackType | None) -> tuple[str, int]:
    """Returns the innermost line of an action; if there is none, the innermost line outside of the engine."""
    return _nearest(users_frames(trace))


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
    return traceback_of(cause, trace)


def traceback_of(error: BaseException, trace: TracebackType | None = None) -> str:
    """Returns the traceback of an exception, from its own beginning or a later one."""
    text, problem = traceback_text(error, trace), field_problem(error)
    return text.replace(str(error), problem) if problem else text


def describe(error: BaseException) -> str:
    """Returns type and text of an exception, in one line."""
    if isinstance(error, SystemExit):
        return f"the action called sys.exit({text_of(error.code)})"
    if problem := field_problem(error):
        return problem
    text = error_text(error)
    return f"{type(error).__name__}: {text}" if text else type(error).__name__
