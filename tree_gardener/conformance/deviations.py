"""The deliberate differences from BehaviorTree.CPP, and the way to recognise them in a run.

A case whose differences have such a reason does not fail; its outcome has the name of the reason.
"""

import dataclasses
import fnmatch
import json
import pathlib
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any, Final

from tree_gardener.blackboard import Blackboard, Entry
from tree_gardener.decorators.loop import Loop
from tree_gardener.errors import LoadError, TickError
from tree_gardener.ports import pointer_key
from tree_gardener.substitution import parse_rules
from tree_gardener.tree import Tree
from tree_gardener.values import ValueType

KINDS: Final = ("stricter here", "more here", "quirk", "unspecified")


@dataclasses.dataclass(frozen=True)
class Deviation:
    """A reason for which a case may differ.

    Attributes:
        kind: one of `KINDS`. A *quirk* of BehaviorTree.CPP is not repeated; what is *unspecified* there is
            specified here.
        reason: one sentence for users.
        cases: patterns of names of cases, from your own file; "" for those that a run recognises.
    """

    kind: str
    reason: str
    cases: tuple[str, ...] = ()


DEVIATIONS: Final[Mapping[str, Deviation]] = {
    "global-through-remap": Deviation(
        "quirk",
        'an entry that is made through a remap to a global (x="{@g}") is the global here; '
        "BehaviorTree.CPP 4.10 makes one that is literally named '@g', and what is written there is "
        "lost",
    ),
    "output-literal": Deviation(
        "stricter here",
        "an output port needs an entry; BehaviorTree.CPP loads a literal that has the type of the "
        "port, and each write fails",
    ),
    "ill-formed-xml": Deviation(
        "stricter here",
        "a document must be well-formed; BehaviorTree.CPP also reads '<' within an attribute and "
        "ignores what follows the first root element",
    ),
    "name-of-testnode": Deviation(
        "stricter here",
        "TestNode is the name of a node; in BehaviorTree.CPP a tree may have it as its ID",
    ),
    "script-from-number": Deviation(
        "stricter here",
        "the script of a node must be a text; BehaviorTree.CPP also reads a number that a SubTree is given",
    ),
    "long-script": Deviation(
        "stricter here",
        "a script has at most 20,000 characters and 250 levels of brackets; BehaviorTree.CPP has no "
        "limit but its stack",
    ),
    "rule-without-children": Deviation(
        "stricter here",
        "a substitution rule cannot replace a leaf by a node with children; BehaviorTree.CPP loads "
        "it, and skips it or crashes",
    ),
    "json-in-loop-queue": Deviation(
        "more here",
        "the queue of a Loop reads json:[…], as lists do; BehaviorTree.CPP reads it for lists only",
    ),
    "equals-sign": Deviation(
        "quirk",
        "'=' alone is a text; BehaviorTree.CPP reads it as '{=}' where a port is read, and as a text "
        "elsewhere",
    ),
    "attribute-blanks": Deviation(
        "quirk",
        "a tab or a line break within an attribute is a blank, as XML says; BehaviorTree.CPP keeps it",
    ),
    "script-queue-operand": Deviation(
        "quirk",
        "-=, +=, *= and /= with a value that is no number and no text are errors; BehaviorTree.CPP "
        "writes the entry unchanged",
    ),
    "status-out-of-range": Deviation(
        "unspecified",
        "a number that no status has is an error where a status is read; BehaviorTree.CPP returns an "
        "invalid status",
    ),
    "two-rules": Deviation(
        "unspecified",
        "of two substitution rules for one node the first one counts; in BehaviorTree.CPP the order "
        "of a hash table decides",
    ),
}

_REFUSED: Final = {
    "TG102": "ill-formed-xml",
    "TG224": "name-of-testnode",
    "TG304": "output-literal",
    "TG306": "script-from-number",
    "TG606": "rule-without-children",
}
_BLANK = re.compile(r"""=\s*(?:"[^"]*[\t\n][^"]*"|'[^']*[\t\n][^']*')""")
_OPERAND = re.compile(r"'[-+*/]=' does not work on .* and a value of type ")


def of_refusal(case: Mapping[str, Any], error: LoadError) -> str:
    """Returns the reason for which a document is refused that BehaviorTree.CPP loads, or ""."""
    names = {
        "" if problem.code == "TG306" and problem.port != "code" else _REFUSED.get(problem.code, "")
        for problem in error.diagnostics
    }
    name = names.pop() if len(names) == 1 else ""
    if all("longer than" in each.message or "too deeply" in each.message for each in error.diagnostics):
        return "long-script"
    if name == "name-of-testnode" and 'BehaviorTree ID="TestNode"' not in case["xml"]:
        return ""
    return name


def of_run(case: Mapping[str, Any], tree: Tree, error: TickError | None) -> str:
    """Returns the reason for which a run differs, or ""; `error` ended it."""
    return next(iter(_reasons(case, tree, error)), "")


def _reasons(case: Mapping[str, Any], tree: Tree, error: TickError | None) -> Iterator[str]:
    if isinstance(tree.blackboard, WatchedBlackboard):
        yield from sorted(tree.blackboard.deviations)
    message = "" if error is None else str(error)
    if _OPERAND.search(message):
        yield "script-queue-operand"
    if "is no status: they have the numbers" in message:
        yield "status-out-of-range"
    if any(_has_json_queue(node) for node in tree.nodes if isinstance(node, Loop)):
        yield "json-in-loop-queue"
    if any("=" in node.ports.values() for node in tree.nodes):
        yield "equals-sign"
    if _BLANK.search(case["xml"]):
        yield "attribute-blanks"
    rules = parse_rules(case.get("substitutions", {}))
    for node in tree.nodes if len(rules) > 1 else ():
        if sum(rule.matches(node.name, node.type, node.path) for rule in rules) > 1:
            yield "two-rules"


def _has_json_queue(loop: Loop) -> bool:
    text: Any = loop.ports.get("queue", "")
    key = pointer_key(text, "queue")
    entry = None if key is None else loop.board.find(key)
    text = text if entry is None else entry.value
    return isinstance(text, str) and text.startswith("json:")


def read_deviations(path: str | pathlib.Path) -> dict[str, Deviation]:
    """Reads a file of your own reasons: by name, an object with `kind`, `reason` and `cases`.

    Raises:
        ValueError: the file has another form.
    """
    rows = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    if not isinstance(rows, dict):
        raise ValueError("the deviations are not an object")
    return {name: _deviation(name, row) for name, row in rows.items()}


def _deviation(name: str, row: Any) -> Deviation:
    if not isinstance(row, dict) or set(row) != {"kind", "reason", "cases"}:
        raise ValueError(f"the deviation '{name}' needs kind, reason and cases")
    kind, reason, cases = row["kind"], row["reason"], row["cases"]
    if kind not in KINDS:
        raise ValueError(f"the kind of the deviation '{name}' is not one of: {', '.join(KINDS)}")
    if not isinstance(reason, str) or not isinstance(cases, list):
        raise ValueError(f"the deviation '{name}' needs a sentence as its reason, and a list of cases")
    return Deviation(kind, reason, tuple(map(str, cases)))


def of_name(name: str, deviations: Mapping[str, Deviation]) -> str:
    """Returns the reason that your own file gives for a case, or ""."""
    found = (
        reason
        for reason, deviation in deviations.items()
        if any(fnmatch.fnmatchcase(name, pattern) for pattern in deviation.cases)
    )
    return next(found, "")


def report(counts: Counter[str], deviations: Mapping[str, Deviation]) -> Iterator[str]:
    """Yields one line for each reason for which cases differ."""
    for name, deviation in deviations.items():
        if counts[name]:
            yield f"{counts[name]} differ on purpose, {name} ({deviation.kind}): {deviation.reason}"


class WatchedBlackboard(Blackboard):
    """A blackboard that records the deviations that occur in a run."""

    __slots__ = ("deviations",)

    def __init__(self, parent: Blackboard | None = None) -> None:
        super().__init__(parent)
        self.deviations: set[str] = parent.deviations if isinstance(parent, WatchedBlackboard) else set()

    def create(self, key: str, kind: ValueType | None) -> Entry:
        """Declares an entry, and records if a remapping leads to a global entry."""
        if _leads_to_global(self, key):
            self.deviations.add("global-through-remap")
        return super().create(key, kind)


def _leads_to_global(board: Blackboard, key: str) -> bool:
    while board.parent is not None and key[:1] != "@" and key not in board.entries:
        outer = board.remapping.get(key)
        if outer is None and (not board.autoremap or key[:1] == "_"):
            return False
        board, key = board.parent, key if outer is None else outer
        if key[:1] == "@":
            return True
    return False
