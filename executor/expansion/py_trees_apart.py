"""Builds a tree of py_trees from a Python file in a child with limits; nothing of it runs in this process."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import msgspec

from executor.expansion.apart import answer_of
from executor.expansion.child import SECONDS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


_Identifier = Annotated[str, msgspec.Meta(pattern=r"^\w+\Z")]


class _Refusal(msgspec.Struct):
    """Why there is no tree."""

    error: str
    file: str
    line: int
    choices: Annotated[list[_Identifier], msgspec.Meta(max_length=500)] = []


class _Behaviour(msgspec.Struct, rename={"class_": "class"}):
    """A behaviour, as the child describes it."""

    module: Annotated[str, msgspec.Meta(pattern=r"^[\w.]*\Z")]
    class_: str
    kind: Literal["composite", "decorator", "leaf"]
    name: str
    arguments: dict[Annotated[str, msgspec.Meta(pattern=r"^\w+\Z")], str] | None
    children: list[_Behaviour]


class _Made(msgspec.Struct):
    """A tree, as the child describes it: the file's own code may have written the answer."""

    module: Annotated[str, msgspec.Meta(pattern=r"^\w+\Z")]
    expression: Annotated[str, msgspec.Meta(pattern=r"^\w+(\(\))?(\.root)?\Z")]
    files: list[Annotated[str, msgspec.Meta(pattern=r"^\w[\w/-]*\.py\Z")]]
    root: _Behaviour


class BuildError(Exception):
    """The file builds no tree, or several, which are then in `choices`; the place is in its folder."""

    def __init__(self, message: str, file: Path, line: int = 1, choices: Sequence[str] = ()) -> None:
        super().__init__(message)
        self.file = file
        self.line = line
        self.choices = list(choices)


def build_apart(file: Path, main: str = "") -> Mapping[str, Any]:
    """Returns the description of the tree that a file builds (`py_trees_file`).

    Args:
        file: the file; it may import what is in its folder and what is installed.
        main: the variable or the function with the tree; "" if it is to be found.

    Raises:
        BuildError: the file fails, builds no tree or several, or exceeds a limit.
    """
    file = file.resolve()
    if not file.stem.isidentifier():
        raise BuildError(f"{file.name} cannot be imported: rename it, with letters, digits and _ alone", file)
    answer = answer_of({"py_trees": str(file), "main": main})
    if answer is None:
        raise BuildError(f"it needs more than {SECONDS} s, 512 MB of memory or 16 MB for its tree", file)
    try:
        if isinstance(answer, dict) and "error" in answer:
            told = msgspec.convert(answer, _Refusal)
            raise BuildError(told.error, Path(told.file), told.line, told.choices)
        msgspec.convert(answer, _Made)
    except (msgspec.ValidationError, RecursionError):
        raise BuildError("what it says about its tree cannot be read", file) from None
    return answer
