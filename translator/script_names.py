"""Finds the names that a script reads and writes, and its errors, by the engine's own parser."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from translator.limits import SCRIPT_CHARACTERS

if TYPE_CHECKING:
    from tree_gardener.script import Program

MAX_INTEGER = 2**63 - 1


class Problem(NamedTuple):
    """The reason why a script cannot be read, with its position."""

    offset: int
    message: str
    hint: str


class ScriptNames(NamedTuple):
    """The entries that a script reads and assigns, each once; none if it cannot be read."""

    read: tuple[str, ...] = ()
    written: tuple[str, ...] = ()
    problem: Problem | None = None


@lru_cache(maxsize=32768)
def script_names(code: str) -> ScriptNames:
    """Returns names and errors of a script, without running it."""
    # Imported here, since the engine imports py_trees, which reading and writing trees do not need.
    from tree_gardener.script import ScriptError, parse  # noqa: PLC0415

    if len(code) > SCRIPT_CHARACTERS:
        return ScriptNames(problem=Problem(0, f"it is longer than {SCRIPT_CHARACTERS} characters", ""))
    try:
        read, written = _names(parse(code))
    except ScriptError as error:
        return ScriptNames(problem=Problem(error.span[0], error.message, error.hint))
    except RecursionError:
        return ScriptNames(problem=Problem(0, "it is nested too deeply", ""))
    return ScriptNames(tuple(dict.fromkeys(read)), tuple(dict.fromkeys(written)))


def integers_too_large(code: str) -> list[str]:
    """Returns the integers of a script that BehaviorTree.CPP reads as 0, since 64 bits cannot hold them."""
    from tree_gardener.script import ScriptError  # noqa: PLC0415
    from tree_gardener.script.lexer import tokenize  # noqa: PLC0415

    try:
        tokens = tokenize(code[:SCRIPT_CHARACTERS])
    except ScriptError:
        return []
    return [
        token.text
        for token in tokens
        if token.kind == "integer"
        and int(token.text, 16 if token.text[:2] in {"0x", "0X"} else 10) > MAX_INTEGER
    ]


def _names(program: Program) -> tuple[list[str], list[str]]:
    """Returns the names read and assigned, in one walk. A name that `:=` creates does not count as read."""
    from tree_gardener.script.syntax import Assignment, Name, walk  # noqa: PLC0415

    names: list[Name] = []
    written: list[str] = []
    created: set[int] = set()
    for statement in program.statements:
        for part in walk(statement):
            if isinstance(part, Name):
                names.append(part)
            elif isinstance(part, Assignment) and isinstance(part.target, Name):
                written.append(part.target.name)
                if part.operator == ":=":
                    created.add(id(part.target))
    return [name.name for name in names if id(name) not in created], written
