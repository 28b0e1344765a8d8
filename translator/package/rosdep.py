"""The rosdep keys of the imports of actions, by a table made from rosdistro's lists."""

from __future__ import annotations

import json
import re
import sys
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING

from translator.diagnostic import Diagnostic, Place, diagnostic

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping

    from translator.action import ActionModel

OWN = {"tree_gardener", "tree_tools", "actions"}
NAV2 = "tree_gardener.nav2."
_NAMED = re.compile(r'"([a-z0-9_]+_msgs)["/]|^\s*(?:from|import) (tf2_\w+)', re.MULTILINE)
_USED = re.compile(rf"^from {NAV2}(\w+) import", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class RosdepTable:
    """Python imports and their rosdep keys, and the names of released ROS packages, as of `date`."""

    date: str
    imports: Mapping[str, str]
    ros_packages: frozenset[str]

    def key_of(self, module: str) -> str | None:
        """Returns the rosdep key of an import, by its longest known beginning."""
        parts = module.split(".")
        for length in range(len(parts), 0, -1):
            name = ".".join(parts[:length])
            if name in self.imports:
                return self.imports[name]
        return parts[0] if parts[0] in self.ros_packages else None


@cache
def rosdep_table() -> RosdepTable:
    text = resources.files("translator.package").joinpath("rosdep.json").read_text(encoding="utf-8")
    document = json.loads(text)
    return RosdepTable(document["date"], document["imports"], frozenset(document["ros_packages"]))


def dependencies(
    actions: Iterable[ActionModel], own_modules: Collection[str]
) -> tuple[list[str], list[Diagnostic]]:
    """Returns the rosdep keys that the actions need, and the imports without one."""
    keys: set[str] = set()
    found: list[Diagnostic] = []
    told: set[str] = set()
    for action in actions:
        if any(item.module.startswith(NAV2) for item in action.imports):
            keys |= _named_by(action.source)
        for item in action.imports:
            top = item.module.partition(".")[0]
            if top in sys.stdlib_module_names or top in OWN or top in own_modules:
                continue
            key = rosdep_table().key_of(item.module)
            if key is not None:
                keys.add(key)
            elif top not in told:
                told.add(top)
                place = Place(action.path, line=item.line, column=1)
                found.append(diagnostic("BT0910", place, module=top))
    return sorted(keys), found


def _named_by(source: str) -> set[str]:
    """Returns the keys of packages that a node of Nav2 imports by name, itself or in the engine's modules."""
    names = {name or module for name, module in _NAMED.findall(source)}
    keys = {key for name in names if (key := rosdep_table().key_of(name)) is not None}
    return keys.union(*(_named_in_engine(module) for module in _USED.findall(source)))


@cache
def _named_in_engine(module: str) -> frozenset[str]:
    file = resources.files("tree_gardener").joinpath("nav2", f"{module}.py")
    return frozenset(_named_by(file.read_text(encoding="utf-8")) if file.is_file() else ())
