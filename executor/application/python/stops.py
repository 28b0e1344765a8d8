"""Decides at a breakpoint in Python with a condition, a count or a log line whether the program stops there.

debugpy stops where a condition *or* a count of all passes holds, does not report a condition that raises, and
shows nothing of a log line of which one name is unknown. So the session makes one condition of all that a
breakpoint has (`executor.session.debugger.lines`), and calls `stops` here. Passes count where the condition
is true, and an expression that cannot be evaluated is reported once.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from executor.application.python.looks import EndlessLookError, look

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from types import CodeType

__all__ = ["MOST_TEXT", "Teller", "stops", "tell_by"]

MOST_TEXT: Final = 2000
"""The most characters of a log line."""
_QUOTES: Final = ('"""', "'''", '"', "'")

Teller = tuple["Callable[[str], None]", "Callable[[str, int, str], None]"]
"""Two functions: for a log line; and for file, line and reason where an expression cannot be evaluated."""


_Parts = list["str | tuple[str, CodeType]"]
"""The texts of a log line, and its expressions with their code."""


@dataclass
class _Line:
    """The state of a breakpoint since it was set; what is compiled at the first pass is None before."""

    passes: int = 0
    is_told: bool = False
    condition: CodeType | None = None
    parts: _Parts | None = None


_lines: Final[dict[tuple[int, str, int], _Line]] = {}
_tellers: Final[list[Teller]] = []


def tell_by(log: Callable[[str], None], wrong: Callable[[str, int, str], None]) -> None:
    """Sets the functions that receive log lines and reasons."""
    _tellers[:] = [(log, wrong)]


def stops(
    place: tuple[int, str, int], condition: str, hits: int, log: str, names: tuple[Mapping[str, Any], ...]
) -> bool:
    """Returns whether the program stops; called by debugpy at each pass, on the thread of the code.

    Args:
        place: the number of the setting of breakpoints, the file in the project, and the line.
        condition: a Python expression; "" is always true.
        hits: the first pass that counts, of those where the condition is true.
        log: a line to tell in place of a stop, with values in braces as in an f-string; "" stops.
        names: the global and the local names of the code.
    """
    line = _lines.get(place)
    if line is None:
        for other in [each for each in _lines if each[:2] != place[:2] and each[1] == place[1]]:
            del _lines[other]
        line = _lines[place] = _Line()
    try:
        if condition and not _value(line, condition, names):
            return False
    except (Exception, EndlessLookError) as error:
        reason = f"The condition “{condition}” cannot be evaluated: {_sentence(error)}"
        _tell(line, place, reason)
        return False
    line.passes += 1
    if line.passes < hits:
        return False
    if not log:
        return True
    text = _text(line, place, log, names)
    for tell, _ in _tellers:
        tell(text[:MOST_TEXT])
    return False


def _value(line: _Line, expression: str, names: tuple[Mapping[str, Any], ...]) -> bool:
    if line.condition is None:
        line.condition = compile(expression.strip(), "<breakpoint>", "eval")
    with look():
        return bool(eval(line.condition, *names))  # type: ignore[arg-type] # noqa: S307 - the user's own code


def _text(line: _Line, place: tuple[int, str, int], log: str, names: tuple[Mapping[str, Any], ...]) -> str:
    """Returns a log line with its values; one that cannot be evaluated leaves the others as they are."""
    if line.parts is None:
        line.parts = _parts(log)
    if line.parts is None:
        line.parts = [log]
        _tell(line, place, f"The log line “{log}” has braces that cannot be read as in an f-string.")
    told: list[str] = []
    for part in line.parts:
        if isinstance(part, str):
            told.append(part)
            continue
        source, code = part
        try:
            with look():
                told.append(str(eval(code, *names)))  # type: ignore[arg-type] # noqa: S307 - the user's own code
        except (Exception, EndlessLookError) as error:
            told.append(f"{{{source}}}")
            _tell(line, place, f"“{source}” of the log line cannot be evaluated: {_sentence(error)}")
    return "".join(told)


def _parts(log: str) -> _Parts | None:
    """Returns the parts of a log line; None if it cannot be read."""
    for quote in _QUOTES:
        try:
            tree = ast.parse(f"rf{quote}{log}{quote}", mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            continue
        if isinstance(tree, ast.Constant):
            return [str(tree.value)]
        if isinstance(tree, ast.JoinedStr):
            return [_part(each) for each in tree.values]
    return None


def _part(part: ast.expr) -> str | tuple[str, CodeType]:
    if isinstance(part, ast.Constant):
        return str(part.value)
    assert isinstance(part, ast.FormattedValue)  # noqa: S101 - an f-string has nothing else
    one = ast.Expression(ast.copy_location(ast.JoinedStr([part]), part))
    return ast.unparse(part.value), compile(ast.fix_missing_locations(one), "<breakpoint>", "eval")


def _tell(line: _Line, place: tuple[int, str, int], reason: str) -> None:
    if line.is_told:
        return
    line.is_told = True
    for _, tell in _tellers:
        tell(place[1], place[2], reason)


def _sentence(error: BaseException) -> str:
    try:
        return f"{type(error).__name__}: {error}"[:300]
    except Exception:
        return type(error).__name__
