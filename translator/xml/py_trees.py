"""Reads XML of py_trees 2.6 (`py_trees.parsers.behaviour_tree_xml`) by its rules.

There a text without braces is a constant, `<BehaviorTree>` has the defaults of its keys as attributes,
composites keep their memory unless `memory` is false, and the decorators are those of `py_trees.decorators`.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from translator.catalog import PortModel
from translator.tree import SUBTREE, Node, Tree, pointer
from translator.xml.v3 import Change, Upgraded

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from translator.xml.source import Element

_COMPOSITES: Final = {"sequence": "Sequence", "selector": "Fallback", "fallback": "Fallback"}
_PARALLEL: Final = {
    "success_on_all": {"success_count": "-1", "failure_count": "1"},
    "success_on_one": {"success_count": "1", "failure_count": "1"},
}
_DECORATORS: Final = {
    "inverter": ("Inverter", {}),
    "failureissuccess": ("ForceSuccess", {}),
    "successisfailure": ("ForceFailure", {}),
    "repeat": ("Repeat", {"num_success": "num_cycles"}),
    "retry": ("RetryUntilSuccessful", {"num_failures": "num_attempts"}),
    "timeout": ("Timeout", {"duration": "msec"}),
}
_AS_CLASSES: Final = {
    name.lower(): name
    for name in (
        *("Count", "FailureIsRunning", "PassThrough", "RunningIsFailure", "RunningIsSuccess"),
        "SuccessIsRunning",
    )
}
_OTHERS: Final = {
    name.lower(): name for name in ("Condition", "EternalGuard", "ForEach", "OneShot", "StatusToBlackboard")
}
_MARKS: Final = {*_AS_CLASSES, *_OTHERS, "selector", "failureissuccess", "successisfailure", "retry"}
_MARKED_BY: Final = ("memory", "policy", "num_success", "duration")
_SUBTREES: Final = {"subtree", "subtreeplus"}
_INCLUDES: Final = {"import", "include"}
_SOURCE: Final = '''"""py_trees' {name}."""

import py_trees


class {name}(py_trees.decorators.{name}):
    """Works as py_trees' decorator of that name."""
'''


def is_of_py_trees(root: Element) -> bool:
    """Returns whether a document is one that only py_trees reads."""
    if "BTCPP_format" in root.attributes:
        return False
    for element in root.children:
        if element.tag.lower() in _INCLUDES and included_path(element):
            return True
        for below in element.walk() if element.tag == "BehaviorTree" else ():
            tag = below.tag.lower()
            is_parent = tag in _COMPOSITES or tag == "parallel" or tag in _DECORATORS
            if tag in _MARKS or (is_parent and any(name in below.attributes for name in _MARKED_BY)):
                return True
    return False


def included_path(element: Element) -> str:
    """Returns the file that an `<Import src>` or `<Include file>` names; "" if there is none."""
    if element.tag.lower() not in _INCLUDES or "path" in element.attributes:
        return ""
    return element.attributes.get("src") or element.attributes.get("file") or ""


def converted(type_: str, attributes: Mapping[str, str]) -> Upgraded:
    """Returns a node as BehaviorTree.CPP 4 writes it."""
    tag, given = type_.lower(), dict(attributes)
    if tag in _SUBTREES:
        return Upgraded(SUBTREE, given, _change(type_, SUBTREE))
    if tag in _COMPOSITES:
        has_memory = given.pop("memory", "true").lower() == "true"
        made = _COMPOSITES[tag] if has_memory else f"Reactive{_COMPOSITES[tag]}"
        changed = _change(type_, made) or ((("memory", made),) if "memory" in attributes else ())
        return Upgraded(made, given, changed)
    if tag == "parallel":
        policy = given.pop("policy", "success_on_one")
        given.pop("memory", None)
        counts = _PARALLEL.get(policy, _PARALLEL["success_on_one"])
        return Upgraded("Parallel", given | counts, ((policy, f"success_count={counts['success_count']}"),))
    if tag in _DECORATORS:
        made, names = _DECORATORS[tag]
        if tag == "timeout":
            given["duration"] = _milliseconds(given.get("duration", "5.0"))
        renamed = {names.get(name, name): text for name, text in given.items() if name != "memory"}
        changes = _change(type_, made) + tuple((old, new) for old, new in names.items() if new in renamed)
        return Upgraded(made, renamed, changes)
    made = _AS_CLASSES.get(tag) or _OTHERS.get(tag) or type_
    return Upgraded(made, given, _change(type_, made))


def _change(before: str, after: str) -> tuple[Change, ...]:
    return ((before, after),) if before != after else ()


def _milliseconds(text: str) -> str:
    try:
        return str(round(float(text) * 1000))
    except (ValueError, OverflowError):
        return text


def defaults_of(tree: Element) -> tuple[PortModel, ...]:
    """Returns the keys that a `<BehaviorTree>` gives a default."""
    given = {name: text for name, text in tree.attributes.items() if name not in {"ID", "name"}}
    return tuple(PortModel(name, default=text) for name, text in given.items() if not name.startswith("_"))


def with_defaults(trees: Mapping[str, Tree], ids: Sequence[str], main: str) -> dict[str, Tree]:
    """Returns the trees with the defaults of py_trees at each call; in the main tree they replace its keys.

    Args:
        trees: All trees.
        ids: Those that were read from XML of py_trees.
        main: The main tree.
    """
    defaults = {
        tree_id: {port.name: port.default for port in trees[tree_id].ports if port.default is not None}
        for tree_id in ids
        if tree_id in trees
    }
    made = dict(trees)
    for tree_id in defaults:
        nodes = {}
        for key, node in trees[tree_id].nodes.items():
            ports = {**defaults.get(node.tree, {}), **node.ports} if node.is_subtree else node.ports
            nodes[key] = replace(node, ports=ports) if ports != node.ports else node
        if tree_id == main:
            nodes = {key: _filled(node, defaults[main]) for key, node in nodes.items()}
        made[tree_id] = replace(trees[tree_id], nodes=nodes)
    return made


def _filled(node: Node, constants: Mapping[str, str]) -> Node:
    ports = {name: constants.get(pointer(text, name) or "", text) for name, text in node.ports.items()}
    return replace(node, ports=ports) if ports != node.ports else node


def class_source(type_: str) -> bytes | None:
    """Returns the action file of a decorator of py_trees that works as a node; None for other types."""
    return _SOURCE.format(name=type_).encode() if type_ in _AS_CLASSES.values() else None
