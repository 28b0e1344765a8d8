"""Checks whether a literal suits the type of a port, by the rules of BehaviorTree.CPP at loading."""

from __future__ import annotations

import json
import math
import re
from enum import Enum

from tree_gardener.type_words import TYPE_WORDS

_INTEGER = re.compile(r"-?[0-9]+")
_UNSIGNED = re.compile(r"[0-9]+")
_REAL = re.compile(
    r"-?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:e[+-]?[0-9]+)?|inf(?:inity)?|nan(?:\(\w*\))?)",
    re.IGNORECASE | re.ASCII,
)
_BOOLEANS = {"0", "1", "true", "TRUE", "True", "false", "FALSE", "False"}
_STATUSES = {"SUCCESS", "FAILURE", "SKIPPED", "RUNNING"}
_NAMES = {"bool": _BOOLEANS, "status": _STATUSES}
_INT_RANGE = (-(2**31), 2**31 - 1)
_UINT_RANGE = (0, 2**32 - 1)


class Fit(Enum):
    """The fit of a literal to a type.

    `LOOSE` is accepted, but not as written (`12abc` as 12); `RANGE` is a number that the type cannot hold.
    """

    GOOD = "good"
    LOOSE = "loose"
    RANGE = "range"
    BAD = "bad"


def fit(type_: str, text: str) -> Fit:
    """Returns how a literal suits a port's type; types without a check accept all texts."""
    if type_.startswith("list["):
        return _fit_list(type_[5:-1], text)
    if (names := choices(type_)) is not None:
        return Fit.GOOD if text in names else _fit_integer("int", text)
    if type_ in {"int", "uint"}:
        return _fit_integer(type_, text)
    if type_ == "double":
        return Fit.RANGE if outside(type_, text) else _fit_prefix(_REAL, text)
    known = _NAMES.get(type_)
    return Fit.GOOD if known is None or text in known else Fit.BAD


def choices(type_: str) -> list[str] | None:
    """Returns the names of an enumeration's type (`Color[RED;GREEN]`), or None for another type."""
    if not type_.endswith("]") or type_.startswith("list["):
        return None
    return type_[type_.index("[") + 1 : -1].split(";")


def type_label(type_: str) -> str:
    """Returns the name of a type, without the names of an enumeration."""
    return type_ if choices(type_) is None else type_.partition("[")[0]


def describe(type_: str) -> str:
    """Returns the description of a type's values in messages; a class has only its name."""
    if (names := choices(type_)) is not None:
        return f"one of {', '.join(names)}"
    if type_.startswith("list["):
        return f"a list such as 1;2;3, each {describe(type_[5:-1])}"
    return TYPE_WORDS.get(type_, type_)


def outside(type_: str, text: str) -> tuple[str, str, str] | None:
    """Returns a number that the type cannot hold, with the limits of the type; None if there is none."""
    if type_.startswith("list["):
        found = (outside(type_[5:-1], part) for part in split_list(text))
        return next(filter(None, found), None)
    if type_ == "double":
        match = _REAL.match(text)
        return _outside_double(match.group()) if match is not None else None
    if choices(type_) is not None:
        type_ = "int"
    if type_ not in {"int", "uint"}:
        return None
    match = (_UNSIGNED if type_ == "uint" else _INTEGER).match(text)
    low, high = _UINT_RANGE if type_ == "uint" else _INT_RANGE
    if match is None or (len(match.group()) <= 20 and low <= int(match.group()) <= high):
        return None
    return match.group(), str(low), str(high)


def _outside_double(number: str) -> tuple[str, str, str] | None:
    digits = number.lower().partition("e")[0]
    if "nan" in digits:
        return None
    if not digits[-1:].isdigit() and not digits.endswith("."):
        return None  # inf and nan
    if math.isinf(float(number)):
        return number, "-1.8e308", "1.8e308"
    if float(number) == 0.0 and re.search("[1-9]", digits):
        return number, "4.9e-324", "1.8e308"
    return None


def _fit_prefix(pattern: re.Pattern[str], text: str) -> Fit:
    match = pattern.match(text)
    if match is None:
        return Fit.BAD
    return Fit.GOOD if match.end() == len(text) else Fit.LOOSE


def _fit_integer(type_: str, text: str) -> Fit:
    match = (_UNSIGNED if type_ == "uint" else _INTEGER).match(text)
    if match is None:
        return Fit.BAD
    if outside(type_, text):
        return Fit.RANGE
    return Fit.GOOD if match.end() == len(text) else Fit.LOOSE


def split_list(text: str) -> list[str]:
    """Returns the parts of a list; a separator at its end adds none."""
    return text.removesuffix(";").split(";") if text else []


def constant_type(text: str) -> str:
    """Returns the type of the entry that a SubTree makes of a constant; "" for a text."""
    if _INTEGER.fullmatch(text):
        number = int(text)
        if -(2**63) <= number < 2**63:
            return "int" if _INT_RANGE[0] <= number <= _INT_RANGE[1] else "int64"
    return "double" if _REAL.fullmatch(text) and outside("double", text) is None else ""


def _fit_list(item: str, text: str) -> Fit:
    if not text:
        return Fit.GOOD
    if text.startswith("json:"):
        return Fit.GOOD if _is_json_list(text[5:]) else Fit.BAD
    fits = {fit(item, part) for part in split_list(text)}
    return next((worst for worst in (Fit.BAD, Fit.RANGE, Fit.LOOSE) if worst in fits), Fit.GOOD)


def _is_json_list(text: str) -> bool:
    try:
        return isinstance(json.loads(text, parse_constant=_refuse), list)
    except (ValueError, RecursionError):
        return False


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is no JSON")
