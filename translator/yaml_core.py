"""The one way in which the files of BT Studio are read as YAML: the core schema of YAML 1.2.

Launch, parameter and map files of ROS are read by YAML 1.1, as ROS reads them.
"""

from __future__ import annotations

import re
from typing import Any, Final

import yaml

__all__ = ["CoreDumper", "CoreLoader", "core_value"]

_TAG: Final = "tag:yaml.org,2002:"
_DIGITS: Final = "-+0123456789"
_RULES: Final[tuple[tuple[str, str, str | None], ...]] = (
    ("null", r"~|null|Null|NULL|", None),
    ("bool", r"true|True|TRUE|false|False|FALSE", "tTfF"),
    ("int", r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+", _DIGITS),
    (
        "float",
        r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)",
        f"{_DIGITS}.",
    ),
)


class CoreLoader(yaml.CSafeLoader):
    """Composes nodes whose scalars have the tags of the core schema; `core_value` gives their values."""


class CoreDumper(yaml.SafeDumper):
    """Writes text so that readers of YAML 1.1 and 1.2 find the same."""


CoreLoader.yaml_implicit_resolvers = {}  # none of YAML 1.1
for _name, _pattern, _first in _RULES:
    for _class in (CoreLoader, CoreDumper):
        _class.add_implicit_resolver(
            _TAG + _name,
            re.compile(rf"(?:{_pattern})\Z"),
            [*_first] if _first is not None else ["~", "n", "N", ""],
        )


def core_value(node: yaml.ScalarNode) -> Any:
    """Returns the value of a scalar.

    Raises:
        ValueError: its tag does not fit its text.
    """
    kind, text = node.tag.removeprefix(_TAG), node.value
    if kind == "null":
        return None
    if kind == "bool":
        if text.lower() not in ("true", "false"):
            raise ValueError(f"{text!r} is neither true nor false")
        return text.lower() == "true"
    if kind == "int":
        return int(text, {"0o": 8, "0x": 16}.get(text[:2], 10))
    if kind == "float":
        return float(text.lower().replace(".inf", "inf").replace(".nan", "nan"))
    return text
