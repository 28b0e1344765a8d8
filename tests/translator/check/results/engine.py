"""Runs random trees in the engine, and compares the results of each node with those that are predicted."""

from __future__ import annotations

import contextlib
import gzip
import json
import re
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import py_trees
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.fuzz.generate import KEYS, Case, Spec, generate
from translator.check.context import Context
from translator.check.reach import check_reachability
from translator.check.results import interpret
from translator.check.results.sets import names_of
from translator.diagnostic import TranslatorError
from translator.importer import from_xml
from translator.tree import callees_first
from tree_gardener import LoadError, ScriptError, Status, TickError, Tree
from tree_gardener.blackboard import Blackboard
from tree_gardener.clock import ManualClock
from tree_gardener.conformance.leaves import Trace, leaves
from tree_gardener.nav2 import NODES
from tree_gardener.ports import node_of
from tree_gardener.script import Environment, bind_run
from tree_gardener.values import BY_NAME, INT

if TYPE_CHECKING:
    from collections.abc import Iterator

    from translator.project import Project

ENDLESS_S = 0.5
AGAIN_S = 0.05
RESULTS = {
    "S": PyTreesStatus.SUCCESS,
    "F": PyTreesStatus.FAILURE,
    "R": PyTreesStatus.RUNNING,
    "K": Status.SKIPPED,
}
WORDS = {"S": "SUCCESS", "F": "FAILURE", "R": "RUNNING", "K": "SKIPPED"}
KINDS = {"Leaf": "Action", "SyncLeaf": "SyncAction", "Cond": "Condition"}


def declared(spec: Spec) -> Spec:
    """Returns a tree whose leaves have types that state their results: ``Leaf_RS`` for a script ``RRS``."""
    tag = spec.tag
    if tag in KINDS:
        script = dict(spec.attributes)["name"].rpartition(".")[2]
        tag = f"{tag}_{''.join(sorted(set(script)))}"
    return Spec(tag, spec.attributes, tuple(declared(child) for child in spec.children))


def leaf_types(spec: Spec) -> Iterator[str]:
    """Yields the types of the leaves that `declared` made."""
    if spec.tag.partition("_")[0] in KINDS:
        yield spec.tag
    for child in spec.children:
        yield from leaf_types(child)


def source(type_: str) -> str:
    """Returns the Python of a leaf as the checker reads it."""
    kind, _, letters = type_.partition("_")
    names = ", ".join(f'"{WORDS[letter]}"' for letter in letters)
    return (
        "import py_trees\n\n\n"
        f"class {type_}(py_trees.behaviour.Behaviour):\n    NODE_KIND = {KINDS[kind]!r}\n"
        f"    RETURNS = {{{names}}}\n\n    def update(self):\n        return self.next()\n"
    )


def leaf_class(type_: str) -> type:
    """Returns a leaf that plays the letters of its name's script; the last one repeats."""

    class Leaf(py_trees.behaviour.Behaviour):
        NODE_KIND = KINDS[type_.partition("_")[0]]
        cursor = 0

        def update(self) -> Any:
            script = node_of(self).path.rpartition(".")[2]
            letter = script[min(self.cursor, len(script) - 1)]
            self.cursor += 1
            return RESULTS[letter]

    return Leaf


def project_of(case: Case, types: set[str]) -> Project:
    """Returns a case as a project."""
    return from_xml(case.xml(), actions={f"{type_}.py": source(type_).encode() for type_ in types})


def case_project(seed: int) -> tuple[Project, list[tuple[int, Status]], Tree]:
    """Runs the case of a seed; returns its project, uid and result of each tick, and the tree."""
    case = generate(seed)
    trees = tuple((name, declared(spec)) for name, spec in case.trees)
    case = Case(case.seed, trees, case.ticks, case.mode, case.halts, case.writes)
    types = {type_ for _, spec in case.trees for type_ in leaf_types(spec)}
    log, tree = run(case, {type_: leaf_class(type_) for type_ in types})
    return project_of(case, types), log, tree


def compare(seed: int) -> list[str]:
    """Runs the case of a seed; returns each result that was not predicted."""
    project, log, tree = case_project(seed)
    results = interpret(project, callees_first(project.trees))
    predicted = expected(project, tree, results.may)
    return [
        f"{tree.nodes[uid - 1].type} {uid}: {status.name} is not among {names_of(predicted[uid])}"
        for uid, status in sorted(set(log), key=str)
        if status.name not in names_of(predicted[uid])
    ]


def run(case: Case, nodes: dict[str, type]) -> tuple[list[tuple[int, Status]], Tree]:
    """Runs a case as the comparison with BehaviorTree.CPP does; returns uid and result of each tick."""
    board = Blackboard()
    for key in KEYS:
        board.set(key, 1, INT)
    tree = Tree.from_xml(case.xml(), nodes, blackboard=board)
    log = tree.log_results()
    with contextlib.suppress(TickError, EndlessError), at_most(ENDLESS_S):
        for tick in range(case.ticks):
            if tick in case.halts:
                tree.halt()
            for when, key, value in case.writes:
                if when == tick:
                    board.set(key, value, INT)
            tree.tick_once() if case.mode == "once" else tree.tick_exactly_once()
    return log, tree


class EndlessError(Exception):
    """A tick does not end: two nodes that yield under a reactive node wake each other up."""


@contextlib.contextmanager
def at_most(limit_s: float) -> Iterator[None]:
    """Raises `EndlessError` in the block after this processor time; the log until then counts.

    It is raised again until it is heard: Python ignores an exception in a callback of a weak reference.
    """

    def end(*_: object) -> None:
        raise EndlessError

    def ignored(found: sys.UnraisableHookArgs) -> None:
        if found.exc_type is not EndlessError:
            hook(found)

    before, hook = signal.signal(signal.SIGVTALRM, end), sys.unraisablehook
    sys.unraisablehook = ignored
    signal.setitimer(signal.ITIMER_VIRTUAL, limit_s, AGAIN_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
        sys.unraisablehook = hook


def expected(project: Project, tree: Tree, may: dict[str, dict[str, int]]) -> dict[int, int]:
    """Returns the predicted set of each node of a running tree by its uid."""
    return {uid: may[place][node] for uid, (place, node) in places_of(project, tree).items()}


CORPUS = Path(__file__).parents[3] / "conformance"
_SCRIPTED = re.compile(r"""<(Leaf|SyncLeaf|Cond)\b([^>]*?)\bscript=['"]([SFRK]+)['"]""")


def corpus(*, every: int) -> Iterator[dict[str, Any]]:
    """Yields cases of the conformance corpus: all focused and timed ones, and some of the others."""
    for name in ("focused.jsonl", "timed.jsonl", "added.jsonl", "random.jsonl", "controls.jsonl.gz"):
        raw = (CORPUS / name).read_bytes()
        rows = (gzip.decompress(raw) if name.endswith(".gz") else raw).splitlines()
        for row in rows[:: every if len(rows) > 100 else 1]:
            case = json.loads(row)
            if "expected" in case and not case.get("load_error") and "substitutions" not in case:
                yield case


def corpus_project(case: dict[str, Any]) -> tuple[Project, dict[str, type]]:
    """Returns a case as a project in which the leaves state their results, and their classes."""
    kinds = leaves(Trace())
    types: dict[str, type] = dict(kinds)

    def named(match: re.Match[str]) -> str:
        kind, attributes, script = match.groups()
        type_ = f"{kind}_{''.join(sorted(set(script)))}"
        types[type_] = kinds[kind]
        return f'<{type_}{attributes}script="{script}"'

    case["xml"] = _SCRIPTED.sub(named, case["xml"])
    own = {f"{type_}.py": source(type_).encode() for type_ in types if "_" in type_}
    included = {f"{index}.xml": text.encode() for index, text in enumerate(case.get("extra_xml", ()))}
    return from_xml(case["xml"], actions=own, included=included), types


def corpus_observed(case: dict[str, Any]) -> list[str]:
    """Runs a case; returns each result that was not predicted, and each node that ran, but never should."""
    try:
        project, types = corpus_project(case)
    except TranslatorError:
        return []
    if case.get("main_tree") not in {None, project.settings.main_tree} or case.get("extra_xml"):
        return []
    context = Context(project)
    check_reachability(context)
    log, tree = play(case, types)
    if tree is None:
        return []
    predicted = expected(project, tree, context.results.may)
    places = places_of(project, tree)
    never = {
        (item.place.tree, item.place.node) for item in context.found if item.code in {"BT0114", "BT0117"}
    }
    wrong = [
        f"{tree.nodes[uid - 1].type} {uid}: {status.name} is not among {names_of(predicted[uid])}"
        for uid, status in sorted(set(log), key=str)
        if status.name not in names_of(predicted[uid])
    ]
    guarded = {item.place.node for item in context.found if item.place.port.startswith("_")}
    ran = {places[uid] for uid, _ in log}
    return wrong + [f"{place} ran" for place in sorted(ran & never) if place[1] not in guarded]


def play(case: dict[str, Any], types: dict[str, type]) -> tuple[list[tuple[int, Status]], Tree | None]:
    """Runs a case of the corpus as it is defined; the tree is None if it does not load."""
    clock, board = ManualClock(), Blackboard()
    for key, (kind, value) in case.get("bb", {}).items():
        if kind not in BY_NAME:
            return [], None
        board.set(key, BY_NAME[kind].convert(value), BY_NAME[kind])
    try:
        tree = Tree.from_xml(
            case["xml"], {**NODES, **types}, clock, blackboard=board, enums=case.get("enums", {})
        )
    except LoadError:
        return [], None
    log = tree.log_results()
    for index in range(len(case["expected"])):
        for operation in case.get("before", {}).get(str(index), []):
            with contextlib.suppress(ScriptError, TickError):
                if operation["op"] == "script":
                    bind_run(operation["code"], Environment(board, case.get("enums", {})))()
                elif operation["op"] == "halt":
                    tree.halt()
                elif operation["op"] == "sleep":
                    clock.advance(operation["ms"] / 1000.0)
                    tree.fire_timers()
        try:
            tree.tick_once() if case.get("tick_mode") == "once" else tree.tick_exactly_once()
        except TickError:
            break
    return log, tree


def places_of(project: Project, tree: Tree) -> dict[int, tuple[str, str]]:
    """Returns tree and node of each node of a running tree by its uid."""
    walks: dict[int, Iterator[Any]] = {}
    found = {}
    for node in tree.nodes:
        tree_id = node.tree_id or project.settings.main_tree
        walk = walks.setdefault(id(node.instance), project.trees[tree_id].walk())
        found[node.uid] = tree_id, next(walk).id
    return found
