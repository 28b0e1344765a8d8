"""Finds sleeps in tests that wait for no condition: `python -m tests.tools.sleeps`, a part of `make lint`.

A sleep is allowed if

* it lasts 0 s: it only gives way;
* it is in a loop that ends at a deadline: the loop reads a clock, or stands in `asyncio.timeout(…)`;
* a comment on its line, or on the line before, says why real time must pass.

`--list` prints the sleeps of the last kind, with their reasons. Benchmarks are left out: they measure over
spans of real time.
"""

from __future__ import annotations

import ast
import io
import re
import sys
import tokenize
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT: Final = Path(__file__).resolve().parents[2]
LEFT_OUT: Final = ROOT / "tests" / "benchmarks"
NAMES: Final = ("sleep", "wait_for_timeout")
MODULES: Final = {"time", "asyncio"}
CLOCKS: Final = {"monotonic", "perf_counter", "time"}
# A suppressed rule of the linter is no reason.
NO_REASON: Final = re.compile(r"#\s*(?:noqa|type):?[^-#]*")
LEAST_WORDS: Final = 3


class Sleep(NamedTuple):
    """A sleep that waits for no condition."""

    line: int
    reason: str


def find(source: str) -> list[Sleep]:
    """Returns the sleeps of a file that wait for no condition, with their reasons."""
    if not any(name in source for name in NAMES):
        return []
    comments = _comments(source)
    return [
        Sleep(call.lineno, _reason(call, comments))
        for call, outer in _calls(ast.parse(source), [])
        if not _is_zero(call) and not _waits(outer)
    ]


def _calls(node: ast.AST, outer: list[ast.AST]) -> Iterator[tuple[ast.Call, list[ast.AST]]]:
    for child in ast.iter_child_nodes(node):
        # A call in a function that is defined inside a loop is not part of that loop.
        around = [] if isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda) else outer
        if isinstance(child, ast.Call) and _is_sleep(child.func):
            yield child, around
        yield from _calls(child, [*around, child])


def _is_sleep(called: ast.expr) -> bool:
    if isinstance(called, ast.Attribute):
        is_module = isinstance(called.value, ast.Name) and called.value.id in MODULES
        return called.attr == NAMES[1] or (called.attr == NAMES[0] and is_module)
    return isinstance(called, ast.Name) and called.id == NAMES[0]


def _is_zero(call: ast.Call) -> bool:
    return len(call.args) == 1 and isinstance(call.args[0], ast.Constant) and call.args[0].value == 0


def _waits(outer: list[ast.AST]) -> bool:
    loops = [at for at, node in enumerate(outer) if isinstance(node, ast.While)]
    if not loops:
        return False
    reads_clock = any(_called(node) in CLOCKS for node in ast.walk(outer[loops[-1]]))
    return reads_clock or any(_has_timeout(node) for node in outer)


def _has_timeout(node: ast.AST) -> bool:
    return isinstance(node, ast.AsyncWith) and any(
        _called(item.context_expr).startswith("timeout") for item in node.items
    )


def _called(node: ast.AST) -> str:
    return node.func.attr if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) else ""


def _comments(source: str) -> dict[int, str]:
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    return {token.start[0]: token.string for token in tokens if token.type == tokenize.COMMENT}


def _reason(call: ast.Call, comments: dict[int, str]) -> str:
    for line in (call.lineno, call.end_lineno or call.lineno, call.lineno - 1):
        text = NO_REASON.sub("", comments.get(line, "")).strip("#- ")
        if len(text.split()) >= LEAST_WORDS:
            return text
    return ""


def main(arguments: list[str]) -> int:
    """Checks all tests; returns 1 if a sleep has neither a condition nor a reason."""
    is_bad = False
    for path in sorted((ROOT / "tests").rglob("*.py")):
        if LEFT_OUT in path.parents:
            continue
        for sleep in find(path.read_text(encoding="utf-8")):
            place = f"{path.relative_to(ROOT)}:{sleep.line}"
            if not sleep.reason:
                is_bad = True
                print(f"{place}: sleeps without a condition; wait for one, or say why real time must pass")
            elif "--list" in arguments:
                print(f"{place}: {sleep.reason}")
    return int(is_bad)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
