"""Finds tests that replace private state: `python -m tests.tools.seams`, a part of `make lint`.

A test passes a fake by a constructor's argument or a public name. What still assigns to a private attribute
of another object, or patches one, is listed in `private_state.txt`, which only shrinks (`--write`).
Benchmarks are no tests: they measure the product without one of its parts.
"""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tests.tools import shrinking

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT: Final = Path(__file__).resolve().parents[2]
LEFT_OUT: Final = ROOT / "tests" / "benchmarks"
LIST: Final = Path(__file__).with_name("private_state.txt")
PATCHES: Final = {"setattr", "delattr", "object"}
OWN: Final = {"self", "cls"}
# What has no such text replaces nothing private, and is not parsed.
PRIVATE: Final = re.compile(r"""[.'"]_""")


def find(source: str) -> list[str]:
    """Returns the private names that a file replaces in other objects."""
    if not PRIVATE.search(source):
        return []
    return sorted({name for node in ast.walk(ast.parse(source)) for name in _replaced(node)})


def _replaced(node: ast.AST) -> Iterator[str]:
    if isinstance(node, ast.Assign):
        for target in node.targets:
            for part in target.elts if isinstance(target, ast.Tuple) else [target]:
                yield from _private(part)
    elif isinstance(node, ast.AugAssign | ast.AnnAssign):
        yield from _private(node.target)
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute | ast.Name):
        called = node.func.attr if isinstance(node.func, ast.Attribute) else node.func.id
        if called in PATCHES:
            yield from _patched(node.args)


def _patched(arguments: list[ast.expr]) -> Iterator[str]:
    for argument in arguments[:2]:
        if isinstance(argument, ast.Constant) and isinstance(argument.value, str):
            yield from (part for part in argument.value.split(".") if _is_private(part))
        else:
            yield from _private(argument)


def _private(expression: ast.expr) -> Iterator[str]:
    """Yields the private attributes on the way to what is replaced, but for those of the test's own class."""
    while isinstance(expression, ast.Attribute | ast.Subscript):
        inner = expression.value
        is_own = isinstance(inner, ast.Name) and inner.id in OWN
        if isinstance(expression, ast.Attribute) and _is_private(expression.attr) and not is_own:
            yield expression.attr
        expression = inner


def _is_private(name: str) -> bool:
    return name.startswith("_") and not name.endswith("__")


def main(arguments: list[str]) -> int:
    """Compares with the list, or writes it; returns 1 where they differ."""
    found = [
        f"{path.relative_to(ROOT)} {name}"
        for path in sorted((ROOT / "tests").rglob("*.py"))
        if LEFT_OUT not in path.parents
        for name in find(path.read_text(encoding="utf-8"))
    ]
    return shrinking.compare(
        found,
        LIST,
        arguments,
        new="replaces private state; pass it to a constructor, or use a public name",
        gone="is not replaced any more; run `python -m tests.tools.seams --write`",
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
