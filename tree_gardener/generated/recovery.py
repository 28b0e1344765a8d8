"""Continues a tick where generated code leaves the usual way.

The code passes the line of a value, which tells the node and what was done with it, and what was returned.
The node's own methods then finish its tick, and those of the nodes above it up to the root of the region
continue with the result, as in a tree without generated code.
"""

import time
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.debugging.wiring import DECIDES
from tree_gardener.errors import PortError, ScriptError, TickError, shown
from tree_gardener.generated.parts import (
    AFTER_FAILURE,
    AFTER_SUCCESS,
    ASK_BEFORE,
    CALL,
    COMPOSITES,
    DECIDING,
    IF_BEFORE,
    IF_FAILURE,
    IF_SUCCESS,
    INITIALISE,
    NODE,
    ON_FAILURE,
    ON_SUCCESS,
    PARALLEL,
    POST,
    RUN,
    TERMINATE,
    TEST,
    UPDATE,
    WHILE,
    Part,
    Region,
    Variant,
)
from tree_gardener.generated.writer import Meaning
from tree_gardener.node import Node
from tree_gardener.observe import Recorder
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status

if TYPE_CHECKING:
    from tree_gardener.debugging.wiring import Wiring
    from tree_gardener.hooks import ResultCount
    from tree_gardener.tree import Tree

UNTICKED: Final = object()
"""Stands for a result where a node was not ticked by the code: it was not IDLE, or a condition decided."""
_QUESTIONS: Final = frozenset((ASK_BEFORE, AFTER_SUCCESS, AFTER_FAILURE))
_TESTS: Final = frozenset((IF_BEFORE, IF_SUCCESS, IF_FAILURE))
_OF_BEHAVIOURS: Final = frozenset((UPDATE, INITIALISE, TERMINATE))


class Recovery:
    """Continues the ticks of one region."""

    __slots__ = (
        "base",
        "counts",
        "epoch",
        "lines",
        "node",
        "recorder",
        "root",
        "tree",
        "values",
        "variant",
        "wiring",
    )

    def __init__(  # noqa: PLR0913 - all parts of one region
        self,
        tree: "Tree",
        region: Region,
        variant: Variant,
        counts: "list[ResultCount] | None",
        recorder: Recorder,
        lines: Mapping[int, Meaning],
        wiring: "Wiring | None" = None,
    ) -> None:
        self.tree = tree
        self.node: Any = region.node
        self.root = region.root
        self.base = region.base
        self.values = region.values
        self.variant = variant
        self.counts = counts
        self.recorder = recorder
        self.lines = lines
        self.wiring = wiring
        self.epoch = None if wiring is None else wiring.epoch

    def rest(self, line: int, returned: Any, start_s: float = 0.0) -> Status | None:
        """Continues after the value on a line returned something unusual.

        Raises:
            TickError: a node could not do its work.
        """
        try:
            return self.continued(line, returned, start_s)
        except BaseException:
            self.unmark()
            raise

    def continued(self, line: int, returned: Any, start_s: float) -> Status | None:
        """Finishes the tick of the node of a line, and continues in those above."""
        part, letter, _ = self.lines[line]
        node: Any = self.values[part.first]
        self.report(line, node)
        if letter == NODE:
            if returned is UNTICKED:
                self.unmark()
                returned = node.parent.ticks[self.position(node, part)]()
            elif part.kind != CALL:  # the tree was held within its tick
                returned = self.ended(node, returned)
            return self.climb(node, part, returned)
        if letter in _TESTS:
            return self.tested(node, part, letter)
        if letter in _QUESTIONS:
            return self.asked(node, part, letter, returned)
        start_s = 0.0 if part.kind in COMPOSITES else start_s
        if letter == UPDATE:
            status = self.conditioned(node, node.conclude(returned, self.before))
            status = self.ended(node, status, start_s)
        else:
            status = self.decided(node, letter)
            name = "_while" if letter == WHILE else DECIDES[status]
            status = self.ended(node, status, start_s, name)
        return self.climb(node, part, status)

    def asked(self, node: Node, part: Part, letter: str, returned: Any) -> Status | None:
        """Continues where a debugger was asked, and the code does not hold any more."""
        if letter == ASK_BEFORE:
            assert self.wiring is not None
            returned = self.wiring.ticked(node)
        self.counted(node, returned)
        return self.climb(node, part, returned)

    def recover(self, error: BaseException, start_s: float = 0.0) -> Status | None:
        """Continues after an exception in the code, or in a function that it called.

        Raises:
            TickError: the exception ends the tick.
        """
        try:
            return self.handled(error, start_s)
        except BaseException:
            self.unmark()
            raise

    def handled(self, error: BaseException, start_s: float) -> Status | None:
        """Fails the node of an exception, or raises the exception with its place."""
        trace = error.__traceback__
        assert trace is not None
        line = trace.tb_lineno
        part, letter, _ = self.lines.get(line, (self.root, NODE, ()))
        node: Any = self.values[part.first]
        self.report(line, node)
        if letter in _OF_BEHAVIOURS and part.kind not in (TEST, RUN):
            status = self.ended(node, self.conditioned(node, node.failed(error)), start_s)
            result = self.climb(node, part, status)
            if self.root.kind == PARALLEL and result is None:
                self.tick_from(self.position(node, part) + 1, self.base + len(self.root.children))
            return result
        if letter in _TESTS:
            return self.tested(node, part, letter)
        if letter == NODE or not isinstance(error, (ScriptError, PortError)):
            raise error.with_traceback(trace.tb_next)
        if letter == UPDATE:
            raise node.script.fault(error) from None
        if letter in (ON_SUCCESS, ON_FAILURE, POST):
            node.status = node.status_within(IDLE)
        raise TickError(node, f"in the script '{shown(_condition(node, letter))}': {error}") from None

    def tested(self, node: Any, part: Part, letter: str) -> Status | None:
        """Asks a debugger where the condition of a breakpoint is true, or could not be tested."""
        self.unmark()
        if letter == IF_BEFORE:
            return self.climb(node, part, node.parent.ticks[self.position(node, part)]())
        return self.climb(node, part, self.ended(node, node.status))

    def flush(self, line: int) -> None:
        """Reports the results of children before a line that were to be reported together."""
        meaning = self.lines.get(line)
        if meaning is not None and meaning.pending:
            self.recorder.results += [self.values[place].marks[index] for place, index in meaning.pending]

    def report(self, line: int, node: Node) -> None:
        """Sends observers the reports that were still missing when the function was left at a line."""
        if not self.variant.is_observed:
            return
        self.flush(line)
        above: Any = node
        while above is not self.node:
            above = above.parent
            self.recorder.touched.append(above)

    @property
    def before(self) -> Status:
        """The status of every inlined leaf before its tick."""
        return RUNNING if self.root.kind == PARALLEL else IDLE

    def decided(self, node: Node, letter: str) -> Status:
        """Returns the result that a pre-condition decided."""
        guard = node.guard
        assert guard is not None
        return node.decided(SKIPPED if letter == WHILE else guard.deciding[DECIDING.index(letter)][1])

    def conditioned(self, node: Node, status: Status) -> Status:
        """Runs the post-conditions of a node after its result."""
        guard = node.guard
        if guard is not None and (status is SUCCESS or status is FAILURE):
            try:
                guard.after(node, status)
            except TickError:
                node.status = node.status_within(IDLE)
                raise
        return status

    def ended(self, node: Node, status: Status, start_s: float = 0.0, decided: str = "") -> Status:
        """Does what follows a node's tick: removes its mark, measures, asks a debugger, and counts.

        Returns the result to use.
        """
        self.unmark()
        if start_s:
            duration_s = time.perf_counter() - start_s
            if duration_s > self.tree.slowest[0]:
                self.tree.slowest = (duration_s, node.uid)
        if self.wiring is not None:
            status = self.wiring.asked(node, status, decided)
        self.counted(node, status)
        return status

    def counted(self, node: Node, status: Status) -> None:
        """Counts a result."""
        if self.counts is not None:
            self.counts[node.uid - 1].add(status)

    def unmark(self) -> None:
        """Removes the mark of the action in progress."""
        if self.variant.marks:
            self.tree.current[0] = 0

    def position(self, node: Node, part: Part) -> int:
        """Returns the position of a node among its parent's children."""
        return part.position + self.base if node.parent is self.node else part.position

    def climb(self, node: Node, part: Part, status: Status) -> Status | None:
        """Continues in the nodes above with the result of a node; returns the root's result.

        A slice of a ParallelAll continues by itself, for which None is returned, unless a debugger has
        changed which nodes ask: then its other children are ticked here.
        """
        position = self.position(node, part)
        above: Any = node.parent
        while above is not self.node:
            status = self.ended(above, self.conditioned(above, above.go_on(position, status)))
            above, below = above.parent, above
            position = above.children.index(below)
        if self.root.kind == PARALLEL:
            above.tally(position, status)
            if self.epoch is None or not self.epoch.is_over:
                return None
            self.tick_from(position + 1, len(above.children))
            return RUNNING
        result: Status = above.go_on(position, status)
        return result

    def tick_from(self, start: int, end: int) -> None:
        """Ticks children of a ParallelAll, from one position to before another one."""
        for index in range(start, end):
            self.node.tally(index, self.node.ticks[index]())


def _condition(node: Node, letter: str) -> str:
    guard = node.guard
    assert guard is not None
    if letter in DECIDING:
        return guard.deciding[DECIDING.index(letter)][0].text
    condition = {
        WHILE: guard.while_true,
        ON_SUCCESS: guard.on_success,
        ON_FAILURE: guard.on_failure,
        POST: guard.post,
    }[letter]
    assert condition is not None
    return condition.text
