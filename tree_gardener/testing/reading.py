"""Reads behaviour tests from plain dictionaries; whatever is wrong is reported with its place."""

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.errors import Diagnostic
from tree_gardener.intended_values import Wanted, intended
from tree_gardener.spelling import nearest
from tree_gardener.status import IDLE, SKIPPED, Status
from tree_gardener.testing.cases import MAX_TICKS, REAL, Case, Claim, Double, Expectation, Step

if TYPE_CHECKING:
    from tree_gardener.testing.suite import Suite

Path = tuple[str | int, ...]
Place = Callable[[Path], tuple[int, int]]

FORMAT: Final = "bt-studio/test"
VERSION: Final = 1
DEFAULT_HZ: Final = 20.0
MAX_HZ: Final = 10_000.0

_FILE_KEYS = ("format", "version", "tests")
_TEST_KEYS = ("name", "tree", "blackboard", "doubles", "tick_hz", "ticks", "for_s", "repeat", "expect")
_STEP_KEYS = ("status", "outputs", "times", "for_s", "then")
_CLAIM_KEYS = ("node", "status", "result", "root", "blackboard", "halted", "ticked")
_NESTED_KEYS = (*_CLAIM_KEYS, "while")
_WHEN_KEYS = ("at", "eventually", "never")
_RETURNED = tuple(status.name for status in Status if status is not IDLE)
_STORED = tuple(status.name for status in Status if status is not SKIPPED)


class _RefusedError(Exception):
    """A part of the document cannot be read; it was reported."""


def read_tests(
    document: Any,
    file: str = "",
    place: Place | None = None,
    *,
    tick_hz: float = DEFAULT_HZ,
    suite: "Suite | None" = None,
) -> tuple[list[Case], list[Diagnostic]]:
    """Returns the tests of a document, and the problems of unreadable ones.

    Args:
        document: the parsed document.
        file: its name in messages.
        place: returns line and column of a part of the document; without it, all problems are at line 1.
        tick_hz: the rate of tests that give none.
        suite: the trees; with it, names of trees, nodes and ports are checked too.
    """
    reader = _Reader(file, place or (lambda path: (1, 1)), tick_hz)
    cases = reader.file_(document)
    if suite is not None:
        sound = []
        for case in cases:
            found = suite.problems_of(case)
            reader.problems += found
            sound += [] if found else [case]
        cases = sound
    return cases, reader.problems


class _Reader:
    def __init__(self, file: str, place: Place, tick_hz: float) -> None:
        self.name = file
        self.place = place
        self.tick_hz = tick_hz
        self.problems: list[Diagnostic] = []

    def refuse(self, path: Path, code: str, message: str, hint: str = "") -> _RefusedError:
        line, column = self.place(path)
        self.problems.append(Diagnostic(code, message, hint, file=self.name, line=line, column=column))
        return _RefusedError()

    def line(self, path: Path) -> int:
        return self.place(path)[0]

    def file_(self, document: Any) -> list[Case]:
        try:
            held = self.mapping(document, (), _FILE_KEYS)
            if held.get("format") != FORMAT:
                raise self.refuse(
                    ("format",), "TG901", f"the format is not '{FORMAT}'", f"write format: {FORMAT}"
                )
            if held.get("version") != VERSION or isinstance(held.get("version"), bool):
                raise self.refuse(
                    ("version",), "TG901", f"the version is not {VERSION}", f"write version: {VERSION}"
                )
            tests = self.list_(held.get("tests"), ("tests",))
        except _RefusedError:
            return []
        cases: list[Case] = []
        names: set[str] = set()
        for index, item in enumerate(tests):
            path: Path = ("tests", index)
            try:
                case = self.test(item, path)
                if case.name in names:
                    hint = "give each test of a file its own name"
                    raise self.refuse((*path, "name"), "TG903", f"two tests are named '{case.name}'", hint)
            except _RefusedError:
                continue
            names.add(case.name)
            cases.append(case)
        return cases

    def test(self, item: Any, path: Path) -> Case:
        held = self.mapping(item, path, _TEST_KEYS)
        before = len(self.problems)
        name = self.text(held.get("name"), (*path, "name"))
        rate = self.number(held.get("tick_hz", self.tick_hz), (*path, "tick_hz"), MAX_HZ)
        ticks = self.ticks(held, rate, path)
        doubles = self.doubles(held.get("doubles", {}), (*path, "doubles"))
        expected = held.get("expect") or []
        wanted = self.list_(expected, (*path, "expect"))
        if not wanted:
            raise self.refuse(
                path, "TG906", f"the test '{name}' expects nothing", "write expect: with one line or more"
            )
        expect = []
        for index, each in enumerate(wanted):
            try:
                expect.append(self.expectation(each, (*path, "expect", index)))
            except _RefusedError:
                continue
        tree = self.text(held["tree"], (*path, "tree")) if "tree" in held else ""
        board = self.any_mapping(held.get("blackboard", {}), (*path, "blackboard"))
        repeat = self.flag(held.get("repeat", False), (*path, "repeat"))
        if len(self.problems) > before:
            raise _RefusedError
        return Case(
            *(name, tree, ticks, rate, tuple(doubles), tuple(expect), board, repeat),
            *(self.name, self.line(path)),
        )

    def ticks(self, held: Mapping[str, Any], rate: float, path: Path) -> int:
        if ("ticks" in held) == ("for_s" in held):
            raise self.refuse(
                path, "TG902", "the test needs either ticks or for_s", "write for example ticks: 60"
            )
        if "ticks" in held:
            return self.whole(held["ticks"], (*path, "ticks"), 1, MAX_TICKS)
        seconds = self.number(held["for_s"], (*path, "for_s"), MAX_TICKS / rate)
        return max(1, math.ceil(seconds * rate - 1e-9))

    def doubles(self, item: Any, path: Path) -> list[Double]:
        found = []
        for pattern, given in self.any_mapping(item, path).items():
            try:
                found.append(self.double(pattern, given, (*path, pattern)))
            except _RefusedError:
                continue
        return found

    def double(self, pattern: str, given: Any, path: Path) -> Double:
        line = self.line(path)
        if given == REAL:
            return Double(pattern, real=True, line=line)
        if isinstance(given, list):
            if not given:
                raise self.refuse(
                    path, "TG902", "an empty list says no result", "write for example [SUCCESS]"
                )
            steps = [self.step(each, (*path, index)) for index, each in enumerate(given)]
            self.in_order(steps, path)
            return Double(pattern, tuple(steps), line=line)
        if isinstance(given, Mapping) and ("for_s" in given or "then" in given):
            held = self.mapping(given, path, _STEP_KEYS)
            if "for_s" not in held or "then" not in held or "times" in held:
                hint = "write {status: RUNNING, for_s: 2, then: SUCCESS}"
                raise self.refuse(path, "TG902", "for_s and then belong together, without times", hint)
            first = self.status(held.get("status"), (*path, "status"), _RETURNED)
            then = self.status(held["then"], (*path, "then"), _RETURNED)
            for_s = self.number(held["for_s"], (*path, "for_s"), 1e9)
            outputs = self.any_mapping(held.get("outputs", {}), (*path, "outputs"))
            return Double(pattern, (Step(first), Step(then, outputs)), for_s, line=line)
        return Double(pattern, (self.step(given, path),), line=line)

    def step(self, given: Any, path: Path) -> Step:
        if not isinstance(given, Mapping):
            return Step(self.status(given, path, _RETURNED, or_real=len(path) > 0))
        held = self.mapping(given, path, ("status", "outputs", "times", "at"))
        if "at" in held and "times" in held:
            hint = "at says until when by the next item"
            raise self.refuse((*path, "times"), "TG902", "an item has either at or times", hint)
        return Step(
            self.status(held.get("status"), (*path, "status"), _RETURNED),
            self.any_mapping(held.get("outputs", {}), (*path, "outputs")),
            self.whole(held.get("times", 1), (*path, "times"), 1, MAX_TICKS),
            self.whole(held["at"], (*path, "at"), 1, MAX_TICKS) if "at" in held else None,
        )

    def in_order(self, steps: list[Step], path: Path) -> None:
        """Refuses a list in which only some items have `at`, or the ticks go back."""
        if all(step.at is None for step in steps):
            return
        last = 0
        for index, step in enumerate(steps):
            if step.at is None or step.at < last:
                hint = "write at in each item, the earliest tick first"
                raise self.refuse((*path, index), "TG902", "the ticks of a list are not in order", hint)
            last = step.at

    def expectation(self, item: Any, path: Path) -> Expectation:
        held = self.any_mapping(item, path)
        kinds = [key for key in _WHEN_KEYS if key in held]
        if len(kinds) != 1:
            hint = "write for example {at: 1, root: RUNNING}"
            raise self.refuse(path, "TG902", "an expectation has one of at, eventually and never", hint)
        kind, line = kinds[0], self.line(path)
        if kind == "at":
            self.mapping(held, path, ("at", *_CLAIM_KEYS))
            first, last = self.when(held["at"], (*path, "at"))
            claim = self.claim({key: value for key, value in held.items() if key != "at"}, path, nested=False)
            return Expectation("at", claim, first, last, line=line)
        self.mapping(held, path, (kind, "within_s") if kind == "eventually" else (kind,))
        claim = self.claim(held[kind], (*path, kind), nested=True)
        within = held.get("within_s")
        limit = None if within is None else self.number(within, (*path, "within_s"), 1e9)
        return Expectation(kind, claim, within_s=limit, line=line)

    def when(self, given: Any, path: Path) -> tuple[int | None, int | None]:
        if given == "end":
            return None, None
        if isinstance(given, str) and ".." in given:
            low, _, high = given.partition("..")
            if low.strip().isdecimal() and high.strip().isdecimal() and len(given) < 20:
                first, last = int(low), int(high)
                if 1 <= first <= last <= MAX_TICKS:
                    return first, last
            hint = "write for example 1..40; ticks count from 1"
            raise self.refuse(path, "TG902", f"'{given}' is no range of ticks", hint)
        tick = self.whole(given, path, 1, MAX_TICKS)
        return tick, tick

    def claim(self, item: Any, path: Path, *, nested: bool) -> Claim:
        held = self.mapping(item, path, _NESTED_KEYS if nested else _CLAIM_KEYS)
        if not any(key in held for key in _CLAIM_KEYS[1:]):
            hint = "write node and status, root, blackboard, halted or ticked"
            raise self.refuse(path, "TG902", "the expectation says nothing about the tree", hint)
        about_node = "status" in held or "result" in held
        if about_node != ("node" in held):
            raise self.refuse(
                path, "TG902", "node goes together with status or result", "write both, or none of them"
            )
        node = self.text(held["node"], (*path, "node")) if about_node else ""
        halted = held.get("halted", [])
        names = [halted] if isinstance(halted, str) else self.list_(halted, (*path, "halted"))
        ticked = self.any_mapping(held.get("ticked", {}), (*path, "ticked"))
        return Claim(
            node=node,
            status=self.optional_status(held, "status", path, _STORED),
            result=self.optional_status(held, "result", path, _RETURNED),
            root=self.optional_status(held, "root", path, _RETURNED),
            blackboard=self.any_mapping(held.get("blackboard", {}), (*path, "blackboard")),
            halted=tuple(self.text(name, (*path, "halted", i)) for i, name in enumerate(names)),
            ticked={
                name: self.whole(count, (*path, "ticked", name), 0, MAX_TICKS * 100)
                for name, count in ticked.items()
            },
            during=self.claim(held["while"], (*path, "while"), nested=False) if "while" in held else None,
        )

    def optional_status(
        self, held: Mapping[str, Any], key: str, path: Path, allowed: tuple[str, ...]
    ) -> Status | None:
        return self.status(held[key], (*path, key), allowed) if key in held else None

    def any_mapping(self, item: Any, path: Path) -> Mapping[str, Any]:
        if not isinstance(item, Mapping) or not all(isinstance(key, str) for key in item):
            raise self.refuse(
                path, "TG902", "names with values are needed here", "write for example {name: value}"
            )
        return item

    def mapping(self, item: Any, path: Path, keys: tuple[str, ...]) -> Mapping[str, Any]:
        held = self.any_mapping(item, path)
        unknown = [key for key in held if key not in keys]
        for key in unknown:
            close = nearest(key, keys)
            hint = f"did you mean {close}?" if close else f"known are: {', '.join(keys)}"
            self.refuse((*path, key), "TG901", f"the key '{key}' is not known here", hint)
        if unknown:
            raise _RefusedError
        return held

    def list_(self, item: Any, path: Path) -> list[Any]:
        if not isinstance(item, list):
            raise self.refuse(
                path, "TG902", "a list is needed here", "write one line for each, beginning with -"
            )
        return item

    def text(self, item: Any, path: Path) -> str:
        if not isinstance(item, str) or not item:
            raise self.refuse(
                path, "TG902", "a name is needed here", "put it in quotes if it looks like a number"
            )
        return item

    def flag(self, item: Any, path: Path) -> bool:
        if not isinstance(item, bool):
            raise self.refuse(path, "TG902", "true or false is needed here", _write(item, "boolean"))
        return item

    def whole(self, item: Any, path: Path, least: int, most: int) -> int:
        # 1e2 is a whole number, too
        is_whole = isinstance(item, int) or (isinstance(item, float) and item.is_integer())
        if not is_whole or isinstance(item, bool) or not least <= item <= most:
            text = f"a whole number from {least} to {most} is needed here"
            raise self.refuse(path, "TG902", text, _write(item, "integer"))
        return int(item)

    def number(self, item: Any, path: Path, most: float) -> float:
        is_number = isinstance(item, (int, float)) and not isinstance(item, bool)
        if not is_number or not math.isfinite(item) or not 0 < item <= most:
            text = f"a number above 0, at most {most:g}, is needed here"
            raise self.refuse(path, "TG902", text, _write(item, "number"))
        return float(item)

    def status(self, item: Any, path: Path, allowed: tuple[str, ...], *, or_real: bool = False) -> Status:
        if not isinstance(item, str) or item not in allowed:
            others = (*allowed, REAL) if or_real else allowed
            hint = f"write one of {', '.join(others)}"
            raise self.refuse(path, "TG904", f"{item!r} is no status that can be here", hint)
        return Status[item]


def _write(item: Any, wanted: Wanted) -> str:
    write = intended(item, wanted)
    return "" if write is None else f"write {write}"
