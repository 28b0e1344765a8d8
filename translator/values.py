"""Whether a literal suits the type of a port, by the rules that BehaviorTree.CPP applies at loading."""

from __future__ import annotations

import json
import re
from enum import Enum

_INTEGER = re.compile(r"-?[0-9]+")
_UNSIGNED = re.compile(r"[0-9]+")
_REAL = re.compile(
    r"-?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:e[+-]?[0-9]+)?|inf(?:inity)?|nan)", re.IGNORECASE | re.ASCII
)
_BOOLEANS = {"0", "1", "true", "TRUE", "True", "false", "FALSE", "False"}
_STATUSES = {"SUCCESS", "FAILURE", "SKIPPED", "RUNNING"}
_INT_RANGE = (-(2**31), 2**31 - 1)
_UINT_RANGE = (0, 2**32 - 1)

DESCRIPTIONS = {
    "int": "a whole number",
    "uint": "a whole number, 0 or more",
    "double": "a number",
    "bool": "true or false",
    "status": "SUCCESS, FAILURE, SKIPPED or RUNNING",
}


class Fit(Enum):
    """How a literal suits a type; `LOOSE` is taken, but not as it reads (`12abc` as 12)."""

    GOOD = "good"
    LOOSE = "loose"
    BAD = "bad"


def fit(type_: str, text: str) -> Fit:
    """Tells how the literal suits the port's type; types without a check suit everything."""
    if type_.startswith("list["):
        return _fit_list(type_[5:-1], text)
    if type_ in {"int", "uint"}:
        return _fit_integer(type_, text)
    if type_ == "double":
        return _fit_prefix(_REAL, text)
    if type_ == "bool":
        return Fit.GOOD if text in _BOOLEANS else Fit.BAD
    if type_ == "status":
        return Fit.GOOD if text in _STATUSES else Fit.BAD
    return Fit.GOOD


def describe(type_: str) -> str:
    """Returns what a message calls the values of a type."""
    if type_.startswith("list["):
        return f"a list such as 1;2;3, each {describe(type_[5:-1])}"
    return DESCRIPTIONS.get(type_, "a text")


def _fit_prefix(pattern: re.Pattern[str], text: str) -> Fit:
    match = pattern.match(text)
    if match is None:
        return Fit.BAD
    return Fit.GOOD if match.end() == len(text) else Fit.LOOSE


def _fit_integer(type_: str, text: str) -> Fit:
    match = (_UNSIGNED if type_ == "uint" else _INTEGER).match(text)
    if match is None:
        return Fit.BAD
    low, high = _UINT_RANGE if type_ == "uint" else _INT_RANGE
    if len(match.group()) > 20 or not low <= int(match.group()) <= high:
        return Fit.BAD
    return Fit.GOOD if match.end() == len(text) else Fit.LOOSE


def _fit_list(item: str, text: str) -> Fit:
    if not text:
        return Fit.GOOD
    if text.startswith("json:"):
        return Fit.GOOD if _is_json_list(text[5:]) else Fit.BAD
    fits = {fit(item, part) for part in text.split(";")}
    return Fit.BAD if Fit.BAD in fits else Fit.LOOSE if Fit.LOOSE in fits else Fit.GOOD


def _is_json_list(text: str) -> bool:
    try:
        return isinstance(json.loads(text, parse_constant=_refuse), list)
    except (ValueError, RecursionError):
        return False


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is no JSON")
