"""Follows the code of the user's project through one tick: its calls, its lines, and the values of its names.

It is only for a run that is made again out of sight, in a process that ends afterwards: `repr` of the user's
classes runs, and each line of an action costs.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final, Protocol

from executor.application.preview import text_of
from executor.child_messages import TickSource
from executor.source_events import (
    MOST_CALLS,
    MOST_SOURCE_BYTES,
    MOST_VALUES,
    SourceCall,
    SourceLine,
    SourceValue,
)
from tree_gardener.errors import describe

if TYPE_CHECKING:
    from types import CodeType, FrameType, TracebackType

    from executor.application.locate import Locator

    LocalTrace = Any

__all__ = ["LineTracer"]

MOST_STEPS: Final = 50_000
"""So many lines are followed at most: a loop of a million lines would take a minute."""
MOST_TEXTS: Final = 5_000
MOST_CHARACTERS: Final = MOST_SOURCE_BYTES // 2
LONGEST_TEXT: Final = 200
ENGINE_FIELD: Final = "tree_gardener_node"
SIMPLE: Final = (bool, int, float, complex, str, bytes, type(None))
"""Values of these types do not change in place."""


class Files(Protocol):
    """The files of the program, as they are used here."""

    def file_of(self, path: str) -> str:
        """Returns the name in the project of a file; "" for one outside of it."""

    def text_of(self, path: str, most_bytes: int) -> str | None:
        """Returns the text of a file of the project; None if it is longer."""


@dataclass
class _Open:
    """A call, and what is known of it meanwhile."""

    call: SourceCall
    owner: Any
    hidden: frozenset[str]
    lines: dict[int, SourceLine] = field(default_factory=dict)
    known: dict[str, tuple[Any, str]] = field(default_factory=dict)
    line: int = 0
    raised: str = ""


class LineTracer:
    """Follows what is called while it is entered as a context.

    Args:
        locator: finds the node of a stack frame.
        files: the files of the program.
    """

    def __init__(self, locator: Locator, files: Files) -> None:
        self._locator = locator
        self._files = files
        self._names: dict[str, str] = {}
        self._open: dict[FrameType, _Open] = {}
        self._hidden: dict[type[Any], frozenset[str]] = {}
        self._earlier: Any = None
        self._steps = self._texts = self._characters = 0
        self.is_in_tick = False
        """Whether the callbacks before the tick are done."""
        self.has_run = False
        self.calls: list[SourceCall] = []
        self.left_out = 0
        self.is_cut = False

    def __enter__(self) -> LineTracer:
        self.has_run = True
        self._earlier = sys.gettrace()
        sys.settrace(self._begin)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        sys.settrace(self._earlier)
        self._open.clear()

    def source(self, t_s: float, tick: int) -> TickSource:
        """Returns what was found, for a tick at a time in s."""
        return TickSource(
            "",
            t=t_s,
            tick=tick,
            calls=self.calls,
            files=self._texts_of_files(),
            left_out=self.left_out,
            is_cut=self.is_cut,
        )

    def _texts_of_files(self) -> dict[str, str]:
        """Returns the text of each file with a call, as far as there is room for it."""
        found: dict[str, str] = {}
        left = MOST_SOURCE_BYTES // 2
        called = {call.file for call in self.calls}
        for path, name in self._names.items():
            if name in called and (text := self._files.text_of(path, left)) is not None:
                found[name] = text
                left -= len(text.encode(errors="replace"))
        return found

    def _name_of(self, path: str) -> str:
        """Returns the name in the project of a file; "" for one outside of it."""
        if path not in self._names:
            self._names[path] = self._files.file_of(path)
        return self._names[path]

    def _begin(self, frame: FrameType, _event: str, _arg: Any) -> LocalTrace:
        """Begins a call; Python calls this for each new frame."""
        code = frame.f_code
        file = "" if self.is_cut else self._name_of(code.co_filename)
        if not file:
            return None
        outer = self._open.get(frame.f_back) if frame.f_back is not None else None
        if code.co_name.startswith("<") and outer is not None and outer.call.file == file:
            return self._follow_part(outer)  # a comprehension is a part of the function that holds it
        if len(self.calls) >= MOST_CALLS:
            self.left_out += not code.co_name.startswith("<")
            return None
        node = self._locator.node_of(frame)
        call = SourceCall(
            file=file,
            function=code.co_qualname,
            line=code.co_firstlineno,
            uid=node.uid if node is not None else 0,
            path=node.path if node is not None else "",
            part="tick" if self.is_in_tick else "callback",
        )
        self.calls.append(call)
        owner = frame.f_locals.get("self") if "self" in code.co_varnames[: code.co_argcount] else None
        self._open[frame] = it = _Open(call, owner, self._hidden_of(type(owner)))
        self._note(it, frame)
        for name in list(it.known):  # the arguments are shown in the line of the function
            if not name.startswith("self."):
                self._line_of(it, code.co_firstlineno).values.append(SourceValue(name, it.known[name][1]))
        return self._follow

    def _follow(self, frame: FrameType, event: str, arg: Any) -> LocalTrace:
        """Follows one call; Python calls this for each of its lines, and at its end."""
        it = self._open.get(frame)
        if it is None or self.is_cut:
            return None
        if event == "exception":
            it.raised = _short(describe(arg[1]))
            return self._follow
        self._look(it, frame)
        if event == "line":
            it.line, it.raised = frame.f_lineno, ""
            self._line_of(it, it.line).times += 1
            self._step()
        elif event == "return":
            self._end(it, frame, arg)
        return self._follow

    def _follow_part(self, outer: _Open) -> LocalTrace:
        """Returns what notes the lines of a comprehension in the call that holds it."""

        def follow(frame: FrameType, event: str, _arg: Any) -> LocalTrace:
            if self.is_cut:
                return None
            if event == "line":
                self._line_of(outer, frame.f_lineno).times += 1
                self._step()
            return follow

        return follow

    def _step(self) -> None:
        self._steps += 1
        if self._steps >= MOST_STEPS:
            self.is_cut = True

    def _line_of(self, it: _Open, number: int) -> SourceLine:
        if number not in it.lines:
            it.lines[number] = SourceLine(number, 0)
            it.call.lines = sorted(it.lines.values(), key=lambda each: each.line)
        return it.lines[number]

    def _look(self, it: _Open, frame: FrameType) -> None:
        """Notes what the last line of a call has changed."""
        changed = self._note(it, frame)
        if not it.line or not changed:
            return
        line = self._line_of(it, it.line)
        names = {value.name for value in changed}
        line.values = [each for each in line.values if each.name not in names] + changed
        del line.values[:-MOST_VALUES]

    def _note(self, it: _Open, frame: FrameType) -> list[SourceValue]:
        """Takes the values of all names; returns those that are not what they were."""
        changed: list[SourceValue] = []
        for name, value in self._values_of(it, frame):
            before = it.known.get(name)
            if before is not None and before[0] is value and type(value) in SIMPLE:
                continue
            text = self._text(value)
            it.known[name] = (value, text)
            if before is None or before[1] != text:
                changed.append(SourceValue(name, text))
        return changed

    def _values_of(self, it: _Open, frame: FrameType) -> list[tuple[str, Any]]:
        found = [
            (name, value)
            for name, value in frame.f_locals.items()
            if name != "self" and not name.startswith(("__", "."))
        ]
        return found[:MOST_VALUES] + self._fields(it)[:MOST_VALUES]

    def _fields(self, it: _Open) -> list[tuple[str, Any]]:
        try:
            fields = getattr(it.owner, "__dict__", None)
        except Exception:  # a property of the user
            return []
        if type(fields) is not dict:
            return []
        return [(f"self.{name}", value) for name, value in list(fields.items()) if name not in it.hidden]

    def _end(self, it: _Open, frame: FrameType, result: Any) -> None:
        if it.raised and result is None:
            it.call.end, it.call.result = "raised", it.raised
        else:
            it.call.end, it.call.result = "returned", self._text(result)
        for name, _ in self._values_of(it, frame):
            value = SourceValue(name, it.known[name][1]) if name in it.known else SourceValue(name, "…")
            (it.call.fields if name.startswith("self.") else it.call.locals).append(value)
        del self._open[frame]

    def _text(self, value: Any) -> str:
        """Returns a value as text; "…" once there is no more room."""
        if self._texts >= MOST_TEXTS or self._characters >= MOST_CHARACTERS:
            self.is_cut = True
            return "…"
        text = _short(text_of(value))
        self._texts += 1
        self._characters += len(text)
        return text

    def _hidden_of(self, kind: type[Any]) -> frozenset[str]:
        """Returns the fields that base classes outside of the project set, such as those of py_trees."""
        if kind not in self._hidden:
            starts = [getattr(vars(base).get("__init__"), "__code__", None) for base in kind.__mro__]
            codes: list[CodeType] = [start for start in starts if start is not None]
            names = {name for code in codes if not self._name_of(code.co_filename) for name in code.co_names}
            self._hidden[kind] = frozenset({*names, ENGINE_FIELD})
        return self._hidden[kind]


def _short(text: str) -> str:
    return text if len(text) <= LONGEST_TEXT else f"{text[: LONGEST_TEXT - 1]}…"
