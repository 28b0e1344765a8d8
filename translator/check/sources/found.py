"""A finding in a source, and when the program would meet it."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import ast
    from collections.abc import Mapping


class Moment(Enum):
    """When a piece of code runs."""

    LOAD = "surely, when the module is loaded"
    MAKE = "surely, when the node is made or set up"
    LATER = "perhaps"
    NEVER = "never, as below `if TYPE_CHECKING`"


@dataclass(frozen=True, slots=True)
class Found:
    """A finding. What surely stops the program is an error, what may stop it a warning."""

    code: str
    line: int
    column: int
    moment: Moment
    values: Mapping[str, object] = field(default_factory=dict)


def found_at(code: str, node: ast.AST, moment: Moment, **values: object) -> Found:
    """Returns a finding at a node of the syntax tree."""
    line, column = getattr(node, "lineno", 1), getattr(node, "col_offset", 0) + 1
    return Found(code, line, column, moment, values)
