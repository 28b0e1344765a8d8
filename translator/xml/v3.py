"""Converts BehaviorTree.CPP v3 to v4: names and attributes that changed, with a note for each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from translator.tree import CONDITIONS, pointer

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from translator.xml.source import Element

TYPES = {
    "SequenceStar": "SequenceWithMemory",
    "FallbackStar": "Fallback",
    "RetryUntilSuccesful": "RetryUntilSuccessful",
    "SubTreePlus": "SubTree",
    "Subtree": "SubTree",
}
PORTS = {
    "Parallel": {
        "success_threshold": "success_count",
        "failure_threshold": "failure_count",
        "threshold": "success_count",
    }
}
_SUBTREES = {"SubTree", "SubTreePlus", "Subtree"}
_ONLY_IN_V3 = {"SequenceStar", "FallbackStar", "SubTreePlus", "RetryUntilSuccesful"}
_ONLY_IN_V4 = {
    *("AsyncSequence", "AsyncFallback", "SequenceWithMemory", "ParallelAll", "TryCatch", "RunOnce"),
    *("Precondition", "SkipUnlessUpdated", "WaitValueUpdate", "LoopInt", "LoopDouble", "LoopString"),
    *("LoopBool", "Script", "ScriptCondition", "UnsetBlackboard", "WasEntryUpdated", "Sleep"),
}
_ATTRIBUTES_OF_V4 = {*CONDITIONS, "_autoremap", "success_count", "failure_count"}
CHECKS = {"BlackboardCheckInt", "BlackboardCheckDouble", "BlackboardCheckBool", "BlackboardCheckString"}


# The old form, and the new one.
Change = tuple[str, str]


@dataclass(frozen=True, slots=True)
class Upgraded:
    """A node in the form of v4, with notes about the changes."""

    type: str
    attributes: Mapping[str, str]
    changes: tuple[Change, ...] = ()


def is_of_v4(root: Element) -> str | None:
    """Returns what a document without a version has that only version 4 knows; None if nothing, or v3 too."""
    found = None
    for element in (below for tree in root.children if tree.tag == "BehaviorTree" for below in tree.walk()):
        names = {element.tag, element.attributes.get("ID", "")}
        if names & (_ONLY_IN_V3 | CHECKS) or "__shared_blackboard" in element.attributes:
            return None
        nodes = names & _ONLY_IN_V4
        others = sorted(_ATTRIBUTES_OF_V4 & element.attributes.keys())
        found = found or (f"<{nodes.pop()}>" if nodes else others[0] if others else None)
    return found


def remaps_of(element: Element) -> list[Element]:
    """Returns the elements `<remap>` of a SubTree, with which version 2 wrote its ports."""
    return [child for child in element.children if child.tag == "remap" and element.tag in _SUBTREES]


def remapped(attributes: Mapping[str, str], remaps: Sequence[Element]) -> dict[str, str]:
    """Returns the attributes of a SubTree with its `<remap>` elements as ports."""
    pairs = ((remap.attributes.get("internal"), remap.attributes.get("external")) for remap in remaps)
    return {**attributes, **{inside: f"{{{outside}}}" for inside, outside in pairs if inside and outside}}


def upgrade(type_: str, attributes: Mapping[str, str]) -> Upgraded:
    """Returns a v3 node as v4 writes it."""
    if type_ in CHECKS:
        return _check(type_, attributes)
    new_type = TYPES.get(type_, type_)
    changes = [(type_, new_type)] if new_type != type_ else []
    if new_type == "SubTree":
        attributes = _subtree(attributes, is_plus=type_ == "SubTreePlus", changes=changes)
    names = PORTS.get(new_type, {})
    renamed = {names.get(name, name): text for name, text in attributes.items()}
    changes += [(name, names[name]) for name in attributes if name in names]
    return Upgraded(new_type, renamed, tuple(changes))


def _subtree(attributes: Mapping[str, str], *, is_plus: bool, changes: list[Change]) -> dict[str, str]:
    result: dict[str, str] = {}
    for name, text in attributes.items():
        if name in {"__shared_blackboard", "__autoremap"}:
            if text.lower() in {"true", "1"}:
                result["_autoremap"] = "true"
            changes.append((name, "_autoremap"))
        elif name in {"ID", "name"} or name.startswith("_") or is_plus or pointer(text) is not None:
            result[name] = text
        else:  # a v3 SubTree names the caller's entry without braces
            result[name] = f"{{{text}}}"
            changes.append((f'{name}="{text}"', f'{name}="{{{text}}}"'))
    return result


def _check(type_: str, attributes: Mapping[str, str]) -> Upgraded:
    quoted = type_ == "BlackboardCheckString"
    left, right = (_operand(attributes.get(name, ""), quoted=quoted) for name in ("value_A", "value_B"))
    kept = {
        name: text
        for name, text in attributes.items()
        if name not in {"value_A", "value_B", "return_on_mismatch", "ID"}
    }
    kept["if"] = f"{left} == {right}"
    kept["else"] = attributes.get("return_on_mismatch", "FAILURE")
    return Upgraded("Precondition", kept, ((type_, "Precondition"),))


def _operand(text: str, *, quoted: bool) -> str:
    key = pointer(text)
    if key is not None:
        return key
    return f"'{text}'" if quoted else text
