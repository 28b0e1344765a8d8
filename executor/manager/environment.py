"""Numbers that the manager reads from its environment."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["WrongVariableError", "mebibytes", "number"]


class WrongVariableError(ValueError):
    """A variable has a value that cannot be used; the text names it."""


def number(name: str, default: float, environment: Mapping[str, str] = os.environ) -> float:
    """Returns the number of a variable, or the default if it is missing or empty.

    Raises:
        WrongVariableError: it is no number from 0 on.
    """
    text = environment.get(name, "").strip()
    try:
        found = float(text) if text else float(default)
    except ValueError:
        raise WrongVariableError(f"{name}: {text!r} is not a number") from None
    if not (math.isfinite(found) and found >= 0):
        raise WrongVariableError(f"{name}: {text!r} is not a number from 0 on")
    return found


def mebibytes(name: str, default: int, environment: Mapping[str, str] = os.environ) -> int:
    """Returns the bytes of a variable with a number of mebibytes.

    Raises:
        WrongVariableError: it is no number from 0 on.
    """
    return int(number(name, default, environment) * (1 << 20))
