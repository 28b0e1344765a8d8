"""What a script reads and writes, and what is wrong with it, by the engine's own parser."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

MAX_LENGTH = 20_000


class Problem(NamedTuple):
    """Why a script cannot be read, and where in it."""

    offset: int
    message: str
    hint: str


class ScriptNames(NamedTuple):
    """The entries that a script reads and assigns, each once; none where it cannot be read."""

    read: tuple[str, ...] = ()
    written: tuple[str, ...] = ()
    problem: Problem | None = None


@lru_cache(maxsize=4096)
def script_names(code: str) -> ScriptNames:
    """Returns what is to be known about a script without running it."""
    # Only here, since the engine brings py_trees, which reading and writing trees does without.
    from tree_gardener.script import ScriptError, names_read, names_written, parse  # noqa: PLC0415

    if len(code) > MAX_LENGTH:
        return ScriptNames(problem=Problem(0, f"it is longer than {MAX_LENGTH} characters", ""))
    try:
        program = parse(code)
        read, written = names_read(program), names_written(program)
    except ScriptError as error:
        return ScriptNames(problem=Problem(error.span[0], error.message, error.hint))
    except RecursionError:
        return ScriptNames(problem=Problem(0, "it is nested too deeply", ""))
    return ScriptNames(
        tuple(dict.fromkeys(name.name for name in read)), tuple(dict.fromkeys(name.name for name in written))
    )
