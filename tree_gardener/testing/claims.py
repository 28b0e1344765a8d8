"""Tests the expectations of a behaviour test while its tree runs."""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from tree_gardener.descriptions import equals, text_of
from tree_gardener.node import Node
from tree_gardener.status import Status
from tree_gardener.testing.cases import Claim, Expectation, Failure
from tree_gardener.testing.coverage import Watch
from tree_gardener.testing.doubles import candidates
from tree_gardener.values import as_number

if TYPE_CHECKING:
    from tree_gardener.tree import Tree


class Mismatch(NamedTuple):
    """A difference between a claim and the tree."""

    what: str
    wanted: str
    got: str
    node: Node | None = None


class View:
    """The tree after a tick, as claims see it.

    Attributes:
        root: what the root returned in the last tick; None before it.
        tick: the number of the last tick.
        time_s: its time.
    """

    def __init__(self, tree: "Tree", watch: Watch) -> None:
        self.tree = tree
        self.watch = watch
        self.root: Status | None = None
        self.tick = 0
        self.time_s = 0.0

    def node(self, name: str) -> Node:
        """Returns the one node that a name means; the names were checked before."""
        return candidates(self.tree.nodes, name)[0]


Test = Callable[[], Mismatch | None]


class Claims:
    """All expectations of one test, and the failures found so far."""

    def __init__(self, view: View, expectations: Sequence[Expectation]) -> None:
        self.view = view
        self.failures: list[Failure] = []
        self._at: list[tuple[Expectation, Test]] = []
        self._end: list[tuple[Expectation, Test]] = []
        self._eventually: list[tuple[Expectation, Test]] = []
        self._never: list[tuple[Expectation, Test]] = []
        for each in expectations:
            pair = (each, _tester(view, each.claim))
            if each.kind == "at":
                (self._end if each.first is None else self._at).append(pair)
            else:
                (self._eventually if each.kind == "eventually" else self._never).append(pair)

    def after_tick(self) -> None:
        """Tests the claims about this tick."""
        view, tick = self.view, self.view.tick
        failed = []
        for pair in self._at:
            each, test = pair
            assert each.first is not None
            assert each.last is not None
            if each.first <= tick <= each.last and (mismatch := test()) is not None:
                self.fail(each, mismatch)
                failed.append(pair)
        self._at = [pair for pair in self._at if pair not in failed] if failed else self._at
        if self._never:
            self._never = [pair for pair in self._never if not self._happened(*pair)]
        if self._eventually:
            self._eventually = [
                (each, test)
                for each, test in self._eventually
                if (each.within_s is not None and view.time_s > each.within_s + 1e-9) or test() is not None
            ]

    def at_end(self) -> None:
        """Tests the claims about the end, and finds claims that were never reached."""
        for each, test in self._end:
            mismatch = test()
            if mismatch is not None:
                self.fail(each, mismatch)
        for each, _ in self._at:
            assert each.last is not None
            if each.last > self.view.tick:
                first = max(each.first or 1, self.view.tick + 1)
                text = f"tick {first} was not reached: the run ended at tick {self.view.tick}"
                self.failures.append(self.failure(text, each.line))
        for each, test in self._eventually:
            mismatch = test()
            within = f"within {each.within_s:g} s" if each.within_s is not None else "in the whole run"
            wanted = describe(each.claim)
            if mismatch is None:  # it holds now, but too late
                self.failures.append(self.failure(f"{wanted} did not happen {within}", each.line))
            else:
                self.fail(
                    each,
                    mismatch._replace(what=f"{wanted} did not happen {within}; at the end {mismatch.what}"),
                )

    def _happened(self, each: Expectation, test: Test) -> bool:
        if test() is not None:
            return False
        named = each.claim.nodes
        node = self.view.node(named[0]) if named else None
        wanted, got = f"never {describe(each.claim)}", describe(each.claim)
        self.failures.append(self.failure(f"{got}, which must never be", each.line, node, wanted, got))
        return True

    def fail(self, each: Expectation, mismatch: Mismatch) -> None:
        """Adds a failure."""
        text = f"{mismatch.what}: wanted {mismatch.wanted}, got {mismatch.got}"
        self.failures.append(self.failure(text, each.line, mismatch.node, mismatch.wanted, mismatch.got))

    def failure(
        self, message: str, line: int, node: Node | None = None, wanted: str = "", got: str = ""
    ) -> Failure:
        """Returns a failure at the current tick."""
        view = self.view
        if node is None:
            return Failure(message, line, view.tick, view.time_s, wanted=wanted, got=got)
        return Failure(
            message,
            line=line,
            tick=view.tick,
            time_s=view.time_s,
            node=node.path,
            tree=node.tree_id,
            node_id=node.node_id,
            wanted=wanted,
            got=got,
            path=path_to(node),
        )


def path_to(node: Node) -> tuple[tuple[str, str], ...]:
    """Returns the nodes from the root to a node, each with its status."""
    found = []
    at: Node | None = node
    while at is not None:
        found.append((at.name, at.status.name))
        at = at.parent
    return tuple(reversed(found))


def describe(claim: Claim) -> str:
    """Returns a claim in words."""
    parts = []
    if claim.status is not None:
        parts.append(f"'{claim.node}' is {claim.status.name}")
    if claim.result is not None:
        parts.append(f"'{claim.node}' returns {claim.result.name}")
    if claim.root is not None:
        parts.append(f"the root returns {claim.root.name}")
    parts += [f"'{key}' is {value!r}" for key, value in claim.blackboard.items()]
    parts += [f"'{name}' was halted" for name in claim.halted]
    parts += [f"'{name}' was ticked {count} times" for name, count in claim.ticked.items()]
    text = " and ".join(parts)
    return text if claim.during is None else f"{text} while {describe(claim.during)}"


def _tester(view: View, claim: Claim) -> Test:
    """Returns a function that compares a claim with the tree; None means that it holds."""
    tests: list[Test] = []
    if claim.during is not None:
        tests.append(_tester(view, claim.during))
    if claim.status is not None:
        tests.append(_status(view.node(claim.node), claim.status))
    if claim.result is not None:
        tests.append(_result(view, view.node(claim.node), claim.result))
    if claim.root is not None:
        tests.append(_root(view, claim.root))
    tests += [_entry(view, key, value) for key, value in claim.blackboard.items()]
    tests += [_halted(view, view.node(name)) for name in claim.halted]
    tests += [_ticked(view, view.node(name), count) for name, count in claim.ticked.items()]
    if len(tests) == 1:
        return tests[0]

    def test() -> Mismatch | None:
        for each in tests:
            mismatch = each()
            if mismatch is not None:
                return mismatch
        return None

    return test


def _status(node: Node, wanted: Status) -> Test:
    def test() -> Mismatch | None:
        got = node.status
        return None if got is wanted else Mismatch("status after the tick", wanted.name, got.name, node)

    return test


def _result(view: View, node: Node, wanted: Status) -> Test:
    def test() -> Mismatch | None:
        got = view.watch.last.get(node.uid)
        if got is wanted:
            return None
        return Mismatch("result of the tick", wanted.name, "no tick" if got is None else got.name, node)

    return test


def _root(view: View, wanted: Status) -> Test:
    root = view.tree.nodes[0]

    def test() -> Mismatch | None:
        got = view.root
        if got is wanted:
            return None
        return Mismatch("result of the root", wanted.name, "none" if got is None else got.name, root)

    return test


def _entry(view: View, key: str, wanted: Any) -> Test:
    def test() -> Mismatch | None:
        got = view.tree.blackboard.get(key)
        if same(got, wanted):
            return None
        return Mismatch(f"the entry '{key}'", _short(wanted), _short(got))

    return test


def _halted(view: View, node: Node) -> Test:
    def test() -> Mismatch | None:
        if view.watch.halts[node.uid]:
            return None
        return Mismatch("halts while RUNNING", "at least 1", "0", node)

    return test


def _ticked(view: View, node: Node, wanted: int) -> Test:
    def test() -> Mismatch | None:
        got = view.watch.ticked[node.uid]
        return None if got == wanted else Mismatch("number of ticks", str(wanted), str(got), node)

    return test


def same(got: Any, wanted: Any) -> bool:
    """Returns whether a value is the expected one; numbers may differ by rounding.

    An array of numpy is compared as a list.
    """
    if issubclass(type(wanted), (int, float)):
        number = as_number(got)
        if number is not None:
            return _is_close(number, wanted)
    if issubclass(type(wanted), (list, tuple)):
        if type(got).__module__ == "numpy" and hasattr(type(got), "tolist"):
            got = got.tolist()
        if issubclass(type(got), (list, tuple)):
            base: Any = list if issubclass(type(got), list) else tuple
            items = base.__iter__(got)
            return bool(base.__len__(got) == len(wanted)) and all(map(same, items, wanted))
    return equals(got, wanted)


def _is_close(got: float, wanted: float) -> bool:
    if type(got) is int and type(wanted) is int:  # `isclose` makes doubles of both
        return got == wanted
    try:
        return math.isclose(got, wanted, rel_tol=1e-9, abs_tol=1e-12)
    except OverflowError:
        return False


def _short(value: Any) -> str:
    return "no value" if value is None else text_of(value, 200)
