"""Runs one case, and compares the run with its expectation."""

import collections
import dataclasses
import gzip
import json
import math
import pathlib
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from tree_gardener.blackboard import EMPTY, Blackboard, Entry
from tree_gardener.clock import ManualClock
from tree_gardener.conformance.deviations import (
    Deviation,
    WatchedBlackboard,
    of_name,
    of_refusal,
    of_run,
)
from tree_gardener.conformance.leaves import Trace, leaves
from tree_gardener.errors import LoadError, PortError, ScriptError, TickError
from tree_gardener.nav2 import NODES
from tree_gardener.script import Environment, bind_run, bind_test, compile_script
from tree_gardener.status import Status
from tree_gardener.tree import Tree
from tree_gardener.values import BY_NAME, ValueType

_TYPES = {"queue_int": "list[int]", "queue_string": "list[string]", "queue_double": "list[double]"}


@dataclasses.dataclass(frozen=True)
class Outcome:
    """The result of a case.

    Attributes:
        name: the name of the case.
        differences: each point that differs from BehaviorTree.CPP.
        deviation: the name of the known reason for the differences (`DEVIATIONS`), or "".
    """

    name: str
    differences: tuple[str, ...]
    deviation: str = ""

    @property
    def passed(self) -> bool:
        """Whether nothing differs."""
        return not self.differences

    @property
    def failed(self) -> bool:
        """Whether something differs without a known reason."""
        return bool(self.differences) and not self.deviation


def run_file(path: str | pathlib.Path, own: Mapping[str, Deviation] | None = None) -> Iterator[Outcome]:
    """Runs all cases of a file: JSON lines (perhaps compressed), or one JSON list (the table of scripts).

    `own` are further reasons for differences, by the names of cases.
    """
    for outcome in _outcomes(path):
        given = of_name(outcome.name, own or {}) if outcome.failed else ""
        yield dataclasses.replace(outcome, deviation=given) if given else outcome


def _outcomes(path: str | pathlib.Path) -> Iterator[Outcome]:
    path = pathlib.Path(path)
    raw = path.read_bytes()
    text = (gzip.decompress(raw) if path.suffix == ".gz" else raw).decode("utf-8")
    if text.lstrip().startswith("["):
        for row in json.loads(text):
            yield run_expression(row)
        return
    for line in text.splitlines():
        if line.strip():
            yield run_case(json.loads(line))


def run_case(case: dict[str, Any], nodes: Callable[[Trace], Mapping[str, Any]] | None = None) -> Outcome:
    """Runs one case of any kind; `nodes` makes classes that its trees use beside the usual ones."""
    if "rejected_410" in case:
        return _run_load_case(case)
    try:
        run = _Run(case, nodes)
        return _outcome(case["name"], tuple(run.differences()), run)
    except LoadError as error:
        if case.get("load_error"):
            return Outcome(case["name"], ())
        return Outcome(case["name"], (f"it does not load: {error}",), of_refusal(case, error))


def _named_in(case: dict[str, Any]) -> str:
    """Returns all text of a case that can name a class of nodes."""
    return f"{case['xml']} {case.get('extra_xml', '')} {case.get('substitutions', '')}"


def _outcome(name: str, differences: tuple[str, ...], run: "_Run") -> Outcome:
    return Outcome(name, differences, of_run(run.case, run.tree, run.error) if differences else "")


def _run_load_case(case: dict[str, Any]) -> Outcome:
    try:
        run = _Run({**case, "ticks": 1, "tick_mode": "exactly_once"})
    except LoadError as error:
        located = all(problem.line > 0 and problem.column > 0 for problem in error.diagnostics)
        if case["rejected_410"]:
            return Outcome(case["name"], () if located else (f"the refusal has no position: {error}",))
        return Outcome(case["name"], (f"it must load, but: {error}",), of_refusal(case, error))
    if case["rejected_410"]:
        return _outcome(case["name"], (f"it must be refused: {case.get('error_410')}",), run)
    expected = case.get("first_tick_410")
    try:
        found = run.tick().name
    except TickError as error:
        found = f"exception: {error}"
        run.error = error
    wants_error = expected is not None and expected not in Status.__members__
    same = found.startswith("exception") if wants_error else expected in (None, found)
    differences = () if same else (f"first tick: expected {expected}, got {found}",)
    return _outcome(case["name"], differences, run)


class _Run:
    """One case in progress."""

    def __init__(
        self, case: dict[str, Any], nodes: Callable[[Trace], Mapping[str, Any]] | None = None
    ) -> None:
        self.case = case
        self.trace = Trace()
        self.clock = ManualClock()
        self.enums = case.get("enums", {})
        self.board = board = WatchedBlackboard()
        for key, (kind, value) in case.get("bb", {}).items():
            _preset(board, key, kind, value)
        if "init_script" in case:
            compile_script(case["init_script"]).run(Environment(board, self.enums))
        self.tree = Tree.from_xml(
            case["xml"],
            {
                **NODES,
                **leaves(self.trace, _named_in(case)),
                **(nodes(self.trace) if nodes is not None else {}),
            },
            self.clock,
            blackboard=board,
            enums=self.enums,
            main_tree=case.get("main_tree"),
            documents=case.get("extra_xml", ()),
            substitutions=case.get("substitutions"),
        )
        self.expected_board: dict[str, Any] = {}
        self.error: TickError | None = None

    def tick(self) -> Status:
        """Ticks the tree in the way that the case says."""
        mode = self.case.get("tick_mode", "exactly_once")
        if mode == "once":
            return self.tree.tick_once()
        if mode == "while_running":
            return self.tree.tick_while_running()
        return self.tree.tick_exactly_once()

    def differences(self) -> Iterator[str]:
        """Runs the case and yields each difference from its expectation."""
        yield from self.compare_nodes()
        for index, expected in enumerate(self.case["expected"]):
            self.before(index)
            place = f"tick {index}"
            yield from _compare(
                f"{place}: events before", expected.get("before_events", []), self.trace.take()
            )
            raised = None
            try:
                root = self.tick()
            except TickError as error:
                raised = self.error = error
            if (raised is not None) != ("exception" in expected):
                wanted = expected.get("exception", "no exception")
                yield f"{place}: expected {wanted}, got {raised or root.name}"
                return
            if raised is None:
                yield from _compare(f"{place}: root", expected["root"], root.name)
            yield from self.compare_state(place, expected)
        if "final_halt" in self.case:
            self.tree.halt()
            yield from self.compare_state("halt", self.case["final_halt"])

    def before(self, index: int) -> None:
        """Applies the steps of the case that come before a tick."""
        for operation in self.case.get("before", {}).get(str(index), []):
            kind = operation["op"]
            if kind == "script":
                environment = Environment(self.tree.blackboard, self.enums)
                bind_run(operation["code"], environment)()
            elif kind == "set":
                _set(self.tree.blackboard, operation["key"], operation["type"], operation["value"])
            elif kind == "unset":
                self.tree.blackboard.unset(operation["key"])
            elif kind == "halt":
                self.tree.halt()
            elif kind == "sleep":
                self.clock.advance(operation["ms"] / 1000.0)
                self.tree.fire_timers()

    def compare_nodes(self) -> Iterator[str]:
        """Compares the place, type and name of each node with the case; yields each difference."""
        for expected, node in zip(self.case.get("nodes", []), self.tree.nodes, strict=False):
            found = {
                "uid": node.number,
                "parent": node.parent.number if node.parent is not None else 0,
                "type": node.type,
                "kind": node.kind,
                "name": node.name,
                "path": node.path,
            }
            yield from _compare(f"node {node.number}", expected, found)
        if "nodes" in self.case:
            yield from _compare("number of nodes", len(self.case["nodes"]), len(self.tree.nodes))

    def compare_state(self, place: str, expected: dict[str, Any]) -> Iterator[str]:
        """Compares statuses, events and the blackboard with the case; yields each difference."""
        statuses = "".join(node.status.letter for node in self.tree.nodes)
        yield from _compare(f"{place}: statuses", expected["status"], statuses)
        yield from _compare(f"{place}: events", expected.get("events", []), self.trace.take())
        if "bb" in expected:
            # The case gives only the scopes that changed; each of them replaces its earlier state.
            self.expected_board = expected["bb"]
        yield from _compare(f"{place}: blackboard", _comparable(self.expected_board), _dump(self.tree))


def _compare(what: str, expected: Any, found: Any) -> Iterator[str]:
    if expected != found:
        yield f"{what}: expected {expected}, got {found}"


def _preset(board: Blackboard, key: str, kind: str, value: Any) -> None:
    value_type = _type(kind)
    board.set(key, _value(kind, value), value_type)
    if value_type.name == "string":
        board.entries[key].type = None


def _set(board: Blackboard, key: str, kind: str, value: Any) -> None:
    board.set(key, _value(kind, value), _type(kind))


def _type(kind: str) -> ValueType:
    return BY_NAME[_TYPES.get(kind, kind)]


def _value(kind: str, value: Any) -> Any:
    if kind.startswith("queue_"):
        return collections.deque(value)
    return float(value) if kind == "double" else value


def _dump(tree: Tree) -> dict[str, dict[str, Any]]:
    found = {}
    for board in tree.boards:
        if board.entries:
            found[board.path] = {key: _plain(entry) for key, entry in board.entries.items()}
    return found


def _plain(entry: Entry) -> Any:
    value = entry.value
    if value is EMPTY:
        return "empty"
    if isinstance(value, collections.deque):
        return list(value)
    return _number(value)


def _number(value: Any) -> Any:
    if isinstance(value, (bool, int, float)):
        number = float(value)
        return number if math.isfinite(number) else str(number)
    return value


def _comparable(board: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    return {
        scope: {key: "empty" if kind == "empty" else _number(value) for key, (kind, value) in entries.items()}
        for scope, entries in board.items()
        if entries
    }


_TABLE_SCRIPT = "i:=3; j:=2; d:=2.5; s:='abc'; n:='42'; t:=true"


def run_expression(row: dict[str, Any]) -> Outcome:
    """Compares the value of an expression, and its result as a condition, with the table."""
    text = row["expr"]
    differences = [
        *_compare(
            "value", row["value"][:4] if row["value"][:4] in ("EXC:", "LOAD") else _table(row), _evaluate(row)
        ),
        *_compare("as condition", row["as_condition"].split(":")[0], _condition(text)),
    ]
    return Outcome(text, tuple(differences))


def _table(row: dict[str, Any]) -> Any:
    value = json.loads(row["value"])
    if isinstance(value, list):
        return _number(value[1])
    return {key: _number(number) for key, (_, number) in value.items()}


def _environment() -> Environment:
    board = Blackboard()
    environment = Environment(board, {"RED": 5, "GREEN": 1})
    compile_script(_TABLE_SCRIPT).run(environment)
    return environment


def _evaluate(row: dict[str, Any]) -> Any:
    text, wanted = row["expr"], row["value"]
    try:
        script = compile_script(text if wanted.startswith("{") else f"r := {text}")
    except ScriptError:
        return "LOAD"
    environment = _environment()
    run = bind_run(script.text, environment)
    before = {key: _plain(entry) for key, entry in environment.board.entries.items()}
    try:
        run()
    except (ScriptError, PortError):
        return "EXC:"
    after = {key: _plain(entry) for key, entry in environment.board.entries.items()}
    if wanted.startswith("["):
        return after["r"]
    return {key: value for key, value in after.items() if before.get(key) != value}


def _condition(text: str) -> str:
    try:
        test = bind_test(text, _environment())
    except ScriptError:
        return "LOAD"
    try:
        return "SUCCESS" if test() else "FAILURE"
    except (ScriptError, PortError):
        return "EXC"
