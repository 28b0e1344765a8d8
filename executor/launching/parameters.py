"""Values of parameters in launch files: their types by the rules of `launch`, and their text for a program.

A text with a substitution gets the type that its YAML has afterwards, one without keeps its own; `type` and
`value-sep` are read. All items of a list have one type.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

import yaml

from executor.launching.substitution import SubstitutionError, has_substitutions

if TYPE_CHECKING:
    from executor.launching.substitution import Substitutions

__all__ = ["parameter_text", "parameter_value"]

TYPES: Final[dict[str, type]] = {"str": str, "bool": bool, "float": float, "int": int}
_LISTS: Final = {f"list_of_{name}": kind for name, kind in TYPES.items()}
_ALLOWED: Final = "a number, a text, true or false, or a list of values of one of these types"
_ENDLESS: Final = 1_000_000_000  # no line of a text is broken


def parameter_value(
    given: Any, substitutions: Substitutions, *, type_name: str = "yaml", separator: str = "", is_xml: bool
) -> Any:
    """Returns the value of a parameter.

    Args:
        given: what the file says; a text in XML.
        substitutions: replaces those in texts.
        type_name: the value of `type`.
        separator: the value of `value-sep`, which XML may have.
        is_xml: whether the file is XML, whose texts get a type by YAML's rules.

    Raises:
        SubstitutionError: it has another type, or a substitution cannot be replaced.
    """
    wanted = TYPES.get(type_name) or _LISTS.get(type_name)
    if wanted is None and type_name != "yaml":
        known = ", ".join([*TYPES, *_LISTS, "yaml"])
        raise SubstitutionError(f"there is no type {type_name!r} ({known})")
    is_list = type_name in _LISTS
    by_text = False  # whether a text without a substitution gets a type, too
    if is_xml and separator:
        given, by_text = [item.strip() for item in given.split(separator)], True
    elif is_xml and (wanted is None or is_list):
        given = _of_yaml(given)
    else:
        by_text = is_xml
    if wanted is not None and not separator and isinstance(given, list) is not is_list:
        raise SubstitutionError(f"{given!r} is no value of the type {type_name}")
    if not isinstance(given, list):
        return _item(given, substitutions, wanted, by_text=by_text)
    found = [_item(each, substitutions, wanted, by_text=by_text) for each in given]
    if len({type(each) for each in found}) > 1:
        raise SubstitutionError(
            f"the items of {given!r} are of several types; write all as numbers with a point, "
            "or all in quotes"
        )
    return found


def _item(given: Any, substitutions: Substitutions, wanted: type | None, *, by_text: bool) -> Any:
    if isinstance(given, str):
        text = substitutions.text(given)
        if wanted is not str and (by_text or has_substitutions(given)):
            return _converted(text, wanted)
        given = text
    if not isinstance(given, str | bool | int | float):
        raise SubstitutionError(f"a parameter is {_ALLOWED}; {given!r} is none: put it in quotes")
    if wanted is not None and type(given) is not wanted:
        raise SubstitutionError(f"{given!r} is no value of the type {wanted.__name__}")
    return given


def _converted(text: str, wanted: type | None) -> Any:
    """Returns the value that a text stands for."""
    if wanted is bool and text in {"0", "1"}:
        return text == "1"
    try:
        if wanted in {int, float}:
            return wanted(text)
    except ValueError:
        raise SubstitutionError(f"{text!r} is no value of the type {wanted.__name__}") from None  # type: ignore[union-attr]
    value = _of_yaml(text)
    if wanted is not None and not isinstance(value, wanted):
        raise SubstitutionError(f"{text!r} is no value of the type {wanted.__name__}")
    return value


def _of_yaml(text: str) -> Any:
    """Returns what a text is as YAML 1.1; itself if it is none, as in ROS."""
    if not text:
        return text
    try:
        value = yaml.safe_load(text)
    except Exception:
        return text  # `2024-02-30` is a ValueError, `[[[[…` a RecursionError; `launch` keeps each as a text
    if isinstance(value, str | bool | int | float):
        return value
    if isinstance(value, list) and all(isinstance(item, str | bool | int | float) for item in value):
        return value
    raise SubstitutionError(f"a parameter is {_ALLOWED}; {text!r} is none: put it in quotes")


def parameter_text(value: Any) -> str:
    """Returns the text by which a program of ROS reads a value with its type."""
    if isinstance(value, list):
        return f"[{', '.join(map(parameter_text, value))}]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float) and not math.isfinite(value):
        return ".nan" if math.isnan(value) else f"{'-' if value < 0 else ''}.inf"
    if not isinstance(value, str):
        return repr(value)
    if value.isprintable():
        return "'" + value.replace("'", "''") + "'"
    written: str = yaml.dump(value, default_style='"', allow_unicode=True, width=_ENDLESS)
    return written.strip()
