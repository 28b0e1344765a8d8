"""Substitutions in launch files: `$(var name)` and `$(dirname)`, as in ROS."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["SubstitutionError", "substitute", "truth"]

_SUBSTITUTION: Final = re.compile(r"\$\((?P<name>[\w-]*)\s*(?P<rest>[^()]*)\)")
_TRUTHS: Final = {"true": True, "1": True, "false": False, "0": False}


class SubstitutionError(ValueError):
    """A text cannot be replaced; the message says why."""


def substitute(text: str, variables: Mapping[str, str], folder: str) -> str:
    """Returns a text with its substitutions replaced; `folder` is that of the launch file.

    Raises:
        SubstitutionError: there is no such variable, or the substitution is not supported.
    """

    def replaced(match: re.Match[str]) -> str:
        name, rest = match["name"], match["rest"].strip().strip("'\"")
        if name == "dirname":
            return folder
        if name == "var":
            if rest not in variables:
                known = ", ".join(sorted(variables)) or "there are none"
                raise SubstitutionError(f"there is no argument {rest!r} with a value ({known})")
            return variables[rest]
        raise SubstitutionError(f"$({name} …) is not read here; $(var …) and $(dirname) are")

    result = _SUBSTITUTION.sub(replaced, text)
    if "$(" in result:
        raise SubstitutionError("a substitution within another is not read here")
    return result


def truth(text: str) -> bool:
    """Returns the truth value of a condition's text.

    Raises:
        SubstitutionError: it is neither true nor false.
    """
    value = _TRUTHS.get(text.strip().lower())
    if value is None:
        raise SubstitutionError(f"{text!r} is neither true nor false")
    return value
