"""Runs behaviour tests against the trees of one document."""

import logging
import time
from collections.abc import Mapping, Sequence
from typing import Any, Final

from tree_gardener.actions import load_actions
from tree_gardener.blackboard import EMPTY, Entry
from tree_gardener.clock import ManualClock
from tree_gardener.errors import Diagnostic, LoadError, PortError, TickError, describe
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.loader import constant
from tree_gardener.node import Node
from tree_gardener.ports import INPUT, pointer_key
from tree_gardener.status import RUNNING
from tree_gardener.testing.cases import Case, Double, Failure, Result
from tree_gardener.testing.claims import Claims, View, path_to
from tree_gardener.testing.coverage import Coverage, Watch, key_of
from tree_gardener.testing.doubles import (
    DoubleBehaviour,
    LeafModel,
    MissingError,
    can_double,
    candidates,
    has_python,
    kind_of,
    matching,
    refused_result,
    stub_class,
)
from tree_gardener.tree import Tree
from tree_gardener.users_nodes import end_broken

MAX_VALUE_BYTES: Final = 16 * 1024 * 1024
_SHOWN = 8
_log = logging.getLogger("tree_gardener")


class Suite:
    """The trees of a document, ready for tests.

    Args:
        xml: the document. Sources of actions in it are not run.
        nodes: the project's own node types.
        sources: Python source by action, for doubles that are ``real``; None refuses them.
        ports: the defaults of each tree's own ports, by tree; used where no other tree calls it.
        on_error: what an exception of a real leaf does: ``stop`` fails the test, ``failure`` fails the leaf.
    """

    def __init__(
        self,
        xml: str | bytes,
        nodes: Mapping[str, LeafModel],
        *,
        sources: Mapping[str, str] | None = None,
        ports: Mapping[str, Mapping[str, str]] | None = None,
        on_error: str = "stop",
    ) -> None:
        self.xml = xml
        self.on_error = on_error
        self.models = dict(nodes)
        self.sources = sources
        self.ports = ports or {}
        self.stubs: dict[str, Any] = {name: stub_class(name, model) for name, model in nodes.items()}
        self._plain: dict[str, Tree] = {}

    @property
    def returns(self) -> dict[str, frozenset[str]]:
        """The results of the leaves by type, where they are known."""
        return {name: model.returns for name, model in self.models.items() if model.returns}

    def coverage(self, trees: list[str]) -> Coverage:
        """Returns an empty coverage of some trees; trees that cannot be built alone are left out."""
        coverage = Coverage()
        for name in trees:
            try:
                coverage.add_tree(self._tree(name), self.returns)
            except LoadError:
                continue
        return coverage

    def run_coverage(self, main: str, seen: Mapping[str, Sequence[str]]) -> dict[str, Any]:
        """Returns the coverage by runs of a tree that are known by the results of their nodes alone.

        Branches, conditions and halts are left out, since such runs do not tell them.

        Args:
            main: the tree that ran.
            seen: the items of each node, by its path; other paths are ignored.
        """
        coverage = Coverage(results_only=True)
        tree = self._tree(main)
        coverage.add_tree(tree, self.returns)
        for node in tree.nodes:
            coverage.add_seen({node.tree_id: {key_of(node): tuple(seen.get(node.path, ()))}})
        return coverage.to_json()

    def problems_of(self, case: Case) -> list[Diagnostic]:
        """Returns the problems of the names in a test: tree, doubles, nodes and ports."""

        def problem(code: str, message: str, hint: str, line: int) -> Diagnostic:
            return Diagnostic(code, message, hint, file=case.file, line=line or case.line, column=1)

        try:
            tree = self._tree(case.tree)
        except LoadError as error:
            return [
                problem(
                    "TG907",
                    f"the tree of '{case.name}': {error.diagnostics[0].message}",
                    error.diagnostics[0].hint,
                    case.line,
                )
            ]
        found = [
            problem(code, message, hint, double.line)
            for double in case.doubles
            for code, message, hint in self._double_problems(tree, case, double)
        ]
        for each in case.expect:
            for name in each.claim.nodes:
                nodes = candidates(tree.nodes, name)
                if len(nodes) == 1:
                    continue
                if nodes:
                    listed = ", ".join(f"'{node.path}'" for node in nodes[:_SHOWN])
                    found.append(
                        problem("TG905", f"'{name}' means several nodes", f"write one of {listed}", each.line)
                    )
                else:
                    found.append(
                        problem("TG905", f"there is no node '{name}'", _known(tree.nodes), each.line)
                    )
        return found

    def _double_problems(self, tree: Tree, case: Case, double: Double) -> list[tuple[str, str, str]]:
        def own(node: Node) -> bool:
            keys = (node.path, node.name, node.type)
            return double.pattern in keys or matching((double,), node) is double

        nodes = [node for node in tree.nodes if own(node)]
        leaves = [node for node in nodes if has_python(node) if double.real or can_double(node)]
        if not leaves:
            known = _known([node for node in tree.nodes if has_python(node)])
            if nodes:
                text = f"'{double.pattern}' is a node of the engine, which runs itself in tests"
                return [("TG905", text, f"remove this line; {known}")]
            return [("TG905", f"'{double.pattern}' matches no leaf of the tree", known)]
        if double.real:
            lost = [
                node.type for node in leaves if self.sources is not None and node.type not in self.sources
            ]
            return [("TG905", f"{lost[0]} has no Python in this project", "give it results")] if lost else []
        found = []
        for node in (leaf for leaf in leaves if matching(case.doubles, leaf) is double):
            assert isinstance(node, BehaviourLeaf)
            refused = refused_result(node, double)
            if refused is not None:
                text = f"{node.type} is {kind_of(node)} and cannot return {refused.name}"
                return [("TG904", text, "write SUCCESS, FAILURE or SKIPPED")]
            ports = {name for step in double.steps for name in step.outputs}
            manifest = node.manifest
            wrong = sorted(
                name
                for name in ports
                if manifest is not None and (name not in manifest or manifest[name].direction == INPUT)
            )
            if wrong:
                outputs = [name for name, spec in (manifest or {}).items() if spec.direction != INPUT]
                hint = f"its outputs: {', '.join(outputs) or 'none'}"
                found.append(("TG905", f"{node.type} has no output '{wrong[0]}'", hint))
                break
        return found

    def _tree(self, name: str) -> Tree:
        """Returns a tree of stubs, which is never ticked."""
        if name not in self._plain:
            self._plain[name] = Tree.from_xml(self.xml, self.stubs, ManualClock(), main_tree=name or None)
        return self._plain[name]

    def run(self, case: Case) -> Result:
        """Runs one test. Python of the project runs only if the test has a double that is ``real``."""
        start_s = time.perf_counter()
        clock = ManualClock()
        try:
            tree = Tree.from_xml(self.xml, self._nodes(case), clock, main_tree=case.tree or None)
        except (LoadError, _RealRefusedError) as error:
            text = error.diagnostics[0].message if isinstance(error, LoadError) else str(error)
            return _result(case, [Failure(text, case.line)], None, start_s)
        if self.on_error == "failure":
            tree.on_error = _tolerate
        watch = Watch(tree)
        view = View(tree, watch)
        claims = Claims(view, case.expect)
        played = self._bind(tree, case)
        try:
            self._fill(tree, case)
            tree.setup(node=None)
        except TickError as error:
            claims.failures.append(_raised(error, case, view, _real_sentence(error)))
            return _result(case, claims.failures, watch, start_s)
        except PortError as error:
            claims.failures.append(Failure(f"blackboard: {error}", case.line))
            return _result(case, claims.failures, watch, start_s)
        error_ = _tick(tree, case, clock, view, claims, played)
        if error_ is not None:
            claims.failures.append(error_)
        else:
            claims.at_end()
        _shut_down(tree, case, view, claims)
        return _result(case, claims.failures, watch, start_s, view)

    def _nodes(self, case: Case) -> dict[str, Any]:
        if not case.uses_real:
            return self.stubs
        if self.sources is None:
            raise _RealRefusedError("a leaf is `real`, and Python of the project does not run here")
        plain = self._tree(case.tree)
        wanted = {node.type for node in plain.nodes if has_python(node) and _is_real(case, node)}
        classes = load_actions(self.sources, only=sorted(wanted & set(self.sources)))
        return {**self.stubs, **classes}

    def _bind(self, tree: Tree, case: Case) -> dict[int, DoubleBehaviour]:
        """Gives each leaf its double; returns the doubles by uid."""
        played = {}
        for node in tree.nodes:
            if not isinstance(node, BehaviourLeaf):
                continue
            double = matching(case.doubles, node)
            if double is None:
                stub = self.stubs.get(node.type)
                if stub is None or not isinstance(node.instance_behaviour, stub):
                    node.bind(_unbound(node))  # ROS, or real elsewhere in the tree
            elif not double.real:
                played[node.uid] = DoubleBehaviour(node, double)
                node.bind(played[node.uid])
        return played

    def _fill(self, tree: Tree, case: Case) -> None:
        """Writes the defaults of the tree's ports, and the blackboard of the test."""
        board = tree.blackboard
        for scope in tree.boards:
            scope.journal = _bounded
        for port, text in self.ports.get(tree.nodes[0].tree_id, {}).items():
            if port not in case.blackboard and pointer_key(text, port) is None:
                entry = board.find(port)
                value, _ = constant(text)
                board[port] = (
                    entry.type.parse(text) if entry is not None and entry.is_strong and entry.type else value
                )
        for key, value in case.blackboard.items():
            board[key] = value


def _tick(  # noqa: PLR0913 - the parts of one run
    tree: Tree,
    case: Case,
    clock: ManualClock,
    view: View,
    claims: Claims,
    played: Mapping[int, DoubleBehaviour],
) -> Failure | None:
    """Ticks the tree to the end of the test; returns the failure that ended it early."""
    watch = view.watch
    for number in range(1, case.ticks + 1):
        view.tick, view.time_s = number, (number - 1) / case.tick_hz
        clock.sleep(view.time_s - clock.now())
        try:
            view.root = tree.tick_exactly_once()
        except TickError as error:
            watch.take()
            end_broken(tree.nodes, error)
            return _raised(
                error, case, view, "" if isinstance(error.cause, MissingError) else _real_sentence(error)
            )
        watch.take()
        for uid, behaviour in played.items():
            watch.halts[uid] = behaviour.halts
        claims.after_tick()
        if view.root is not RUNNING and not case.repeat:
            return None
    return None


def _tolerate(error: TickError) -> None:
    """Reports an error, so that its leaf fails; raises an error of the test itself."""
    if isinstance(error.cause, (MissingError, MemoryError)) or _real_sentence(error):
        raise error
    _log.warning("%s", error)


class _RealRefusedError(Exception):
    """Python of the project may not run here."""


def _is_real(case: Case, node: Node) -> bool:
    double = matching(case.doubles, node)
    return double is not None and double.real


def _unbound(node: BehaviourLeaf) -> Any:
    """Returns a behaviour that refuses its tick, for a leaf that the engine or the project would run."""
    stub = stub_class(node.type, LeafModel())(node.name)
    stub.tree_gardener_node = node
    return stub


def _bounded(entry: Entry, _: int) -> None:
    value = entry.value
    kind: Any = type(value)  # not `isinstance`, nor `len` of a derived class: they may be the user's code
    if issubclass(kind, (str, bytes)):
        size = (str if issubclass(kind, str) else bytes).__len__(value)
    elif issubclass(kind, (list, tuple)):
        size = 8 * (list if issubclass(kind, list) else tuple).__len__(value)
    else:
        return
    if size > MAX_VALUE_BYTES:
        entry.value = EMPTY
        raise PortError(f"the entry '{entry.key}' would hold more than {MAX_VALUE_BYTES // 1024 // 1024} MB")


def _raised(error: TickError, case: Case, view: View, sentence: str = "") -> Failure:
    node = view.tree.nodes[error.uid - 1]
    cause = error.cause
    text = str(cause) if isinstance(cause, MissingError) else sentence or error.message
    if isinstance(cause, MemoryError):
        text = "the test needs more memory than it may have"
    at = f" ({error.file}:{error.line})" if error.file and not isinstance(cause, MissingError) else ""
    return Failure(
        f"{text}{at}",
        line=case.line,
        tick=view.tick,
        time_s=view.time_s,
        node=node.path,
        tree=node.tree_id,
        node_id=node.node_id,
        wanted="no error",
        got="an error",
        path=path_to(node),
    )


def _real_sentence(error: TickError) -> str:
    """Returns the error for a real leaf that needs ROS, which tests do not have; else ""."""
    cause = error.cause
    is_missing = isinstance(cause, ImportError) or (
        isinstance(cause, AttributeError) and getattr(cause, "obj", 0) is None
    )
    if not is_missing or cause is None:
        return ""
    return (
        f"{error.node_type} needs ROS, which behaviour tests do not have: give it results ({describe(cause)})"
    )


def _shut_down(tree: Tree, case: Case, view: View, claims: Claims) -> None:
    try:
        tree.shutdown()
    except TickError as error:
        if not claims.failures:
            claims.failures.append(_raised(error, case, view, _real_sentence(error)))


def _result(
    case: Case, failures: list[Failure], watch: Watch | None, start_s: float, view: View | None = None
) -> Result:
    return Result(
        *(case.name, case.file, case.line, case.tree, tuple(failures)),
        ticks=view.tick if view is not None else 0,
        root=view.root.name if view is not None and view.root is not None else "",
        duration_s=time.perf_counter() - start_s,
        seen=watch.seen() if watch is not None else {},
    )


def _known(nodes: list[Node]) -> str:
    names = list(dict.fromkeys(node.name for node in nodes))
    more = ", …" if len(names) > _SHOWN else ""
    return f"the tree has {', '.join(names[:_SHOWN])}{more}" if names else "the tree has none"
