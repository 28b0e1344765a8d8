"""Converts BehaviorTree.CPP v3 to v4: names and attributes that changed, with a note for each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from translator.tree import pointer

if TYPE_CHECKING:
    from collections.abc import Mapping

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
CHECKS = {"BlackboardCheckInt", "BlackboardCheckDouble", "BlackboardCheckBool", "BlackboardCheckString"}


# The old form, and the new one.
Change = tuple[str, str]


@dataclass(frozen=True, slots=True)
class Upgraded:
    """A node in the form of v4, with notes about the changes."""

    type: str
    attributes: Mapping[str, str]
    changes: tuple[Change, ...] = ()


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
