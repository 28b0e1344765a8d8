"""Makes the syntax of a region: a function without arguments that ticks its nodes.

The syntax is built of `ast` nodes out of a shape, which contains nothing of the document. Every value is a
parameter with a default, bound by position: ``c0``, ``c1`` … for those of the region's nodes, and the names
in `FIXED` for the rest. Each value has its line, so that the line of an exception tells what raised it.
"""

import ast
from collections.abc import Iterator
from typing import Final, NamedTuple

from tree_gardener.generated import syntax
from tree_gardener.generated.parts import (
    AFTER_FAILURE,
    AFTER_SUCCESS,
    ASK_BEFORE,
    BEHAVIOUR,
    BUNDLE,
    CALL,
    COMPOSITES,
    CONSTANT,
    COUNT,
    DECIDING,
    END,
    FINISH,
    IF_BEFORE,
    IF_FAILURE,
    IF_SUCCESS,
    IMMEDIATE,
    INITIALISE,
    NODE,
    ON_FAILURE,
    ON_SUCCESS,
    ORDERED,
    PARALLEL,
    POST,
    REACTIVE,
    RUN,
    SLICE,
    STATEFUL,
    SUBTREE,
    TERMINATE,
    TEST,
    UID,
    UPDATE,
    WHILE,
    WRAPPER,
    F,
    Part,
    S,
    Variant,
)
from tree_gardener.generated.syntax import Statements, call, do, give, leave, let, load, number, when

FIXED: Final = (
    *("IDLE", "RUNNING", "SUCCESS", "FAILURE", "PY_SUCCESS", "PY_FAILURE", "PY_RUNNING", "RAISED"),
    *("UNTICKED", "REST", "RECOVER", "FLUSH", "TOUCHED", "RESULTS", "CURRENT", "CLOCK", "TREE"),
    *("UNCHANGED", "EPOCH"),
)
"""The parameters that regions share; those that a region does not use are left out."""
FIRST_LINE: Final = 2
"""The line of the first value. Line 1 is that of the function."""
ATTRIBUTES: Final = frozenset(
    (
        *("failure", "is_doubtful", "is_over", "is_true", "marks", "reported", "running", "skips", "slowest"),
        *("status", "success", "ticks"),
    ),
)
VARIABLES: Final = frozenset(("duration", "error", "kept", "result", "returned", "start"))
"""The variables, except ``ticks0``, ``ticks1`` … for the nodes whose children are called."""

OTHER: Final = {S: F, F: S}
MARK_OF: Final = {S: 0, F: 1}
"""The index of a result's mark in `Node.marks`."""

_RESULT_OF: Final = {IF_SUCCESS: S, AFTER_SUCCESS: S, IF_FAILURE: F, AFTER_FAILURE: F}
"""The result after which the value of a letter is called."""


class Meaning(NamedTuple):
    """The meaning of a line.

    Attributes:
        part: the part whose value is called there.
        letter: which of its values.
        pending: the results of nodes before it that are not reported yet, each as the position of the node
            and the index of the mark.
    """

    part: Part
    letter: str
    pending: tuple[tuple[int, int], ...]


class Writer:
    """Writes the function of one region."""

    def __init__(self, variant: Variant) -> None:
        self.variant = variant
        self.used: set[str] = set()
        self.is_pending = False

    def function(self, root: Part) -> ast.Module:
        """Returns a module with the function."""
        body: Statements = [let("start", number(0))] if self.variant.times else []
        body += self.parallel(root) if root.kind is PARALLEL else self.root(root)
        recover = call(self.fixed("RECOVER"), load("kept"), *self.time_of_start())
        raised = self.fixed("RAISED")
        guarded = [syntax.caught(body, raised, [let("kept", load("error"))]), give(recover)]
        return syntax.module("tick", self.parameters(), guarded)

    def parameters(self) -> list[str]:
        """Returns the names of the parameters that the function uses, in order."""
        own = sorted((name for name in self.used if name not in FIXED), key=lambda name: int(name[1:]))
        return [*(name for name in FIXED if name in self.used), *own]

    def fixed(self, name: str) -> ast.Name:
        """Returns a read of a parameter that regions share."""
        self.used.add(name)
        return load(name)

    def value(self, part: Part, letter: str) -> ast.Name:
        """Returns a read of a value of a part."""
        return self.fixed(f"c{part.place(letter)}")

    def attribute(self, part: Part, name: str) -> ast.Attribute:
        """Returns a read of an attribute of a part's node."""
        return syntax.attribute(self.value(part, NODE), name)

    def set_status(self, part: Part, status: ast.expr, letter: str = NODE) -> ast.stmt:
        """Returns the assignment of a status to the node or the behaviour of a part."""
        return syntax.put(self.value(part, letter), "status", status)

    def called(self, part: Part, letter: str, *arguments: ast.expr) -> ast.Call:
        """Returns a call of a value, on the value's line."""
        return call(self.value(part, letter), *arguments, line=FIRST_LINE + part.place(letter))

    def rest(self, part: Part, letter: str, returned: ast.expr) -> ast.Call:
        """Returns the call that continues outside of the function."""
        line = number(FIRST_LINE + part.place(letter))
        return call(self.fixed("REST"), line, returned, *self.time_of_start())

    def time_of_start(self) -> list[ast.expr]:
        """Returns the argument with the time at which the last leaf started, for a function that measures."""
        return [load("start")] if self.variant.times else []

    def root(self, root: Part) -> Statements:
        """Returns the statements of a region, or of a slice of it."""
        if not root.is_slice:
            return [*self.composite(root, 0), *self.unmark(), give(load("result"))]
        block = self.block(root, root.results, 0)
        return [*self.ticks(root, 0), block, *self.close(root), *self.unmark(), give()]

    def close(self, root: Part) -> Statements:
        """Returns the end of a node by its own method, where children behind the last one may be RUNNING."""
        ended = syntax.other(load("result"), self.fixed(root.results[0]))
        closing = call(self.value(root, FINISH), load("result"))
        return [when(ended, [*self.unmark(), give(closing)])]

    def composite(self, part: Part, level: int) -> Statements:
        """Returns the statements that tick a composite; `result` is SUCCESS or FAILURE afterwards."""
        body = [*self.begin(part, level), *self.ticks(part, level)]
        passes = (S, F) if part.kind in (WRAPPER, SUBTREE) else part.results
        body.append(self.block(part, passes, level))
        if part.kind is WRAPPER:
            body += self.changed(part)
        if FINISH in part.has:
            body += self.close(part)
        for child in part.children:
            if child.kind is BUNDLE:
                continue
            body.append(self.set_status(child, self.fixed("IDLE")))
            if child.kind is CALL and self.variant.is_observed:
                # The resets of other children were reported before this start: they were IDLE then.
                reported = syntax.other(self.attribute(child, "reported"), self.fixed("IDLE"))
                body.append(when(reported, [do(call(self.fixed("TOUCHED"), self.value(child, NODE)))]))
        body.append(self.set_status(part, load("result")))
        return [*body, *self.by_result(self.mark(part, S), self.mark(part, F))]

    def begin(self, part: Part, level: int) -> Statements:
        """Returns the statements that make a composite RUNNING.

        It is reported as touched only where the function is left before the composite is done.
        """
        begin = [self.set_status(part, self.fixed("RUNNING"))]
        if part.kind is ORDERED:
            idle = syntax.same(self.attribute(part, "status"), self.fixed("IDLE"))
            return [when(idle, [syntax.put(self.value(part, NODE), "skips", number(0))]), *begin]
        if level > 0 or part.kind is WRAPPER:
            return begin
        status = self.attribute(part, "status")
        if part.kind is SUBTREE:
            return [when(syntax.same(status, self.fixed("IDLE")), begin)]
        return [when(syntax.other(status, self.fixed("RUNNING")), begin)]

    def block(self, part: Part, results: tuple[str, str], level: int) -> ast.stmt:
        """Returns a loop that ticks the children once; it is left early at a child that ends the node."""
        goes, _ = results
        body: Statements = []
        for child in part.children:
            body += self.child(child, goes, level, is_careful=part.kind is REACTIVE)
            self.is_pending = child.is_bundled
        return syntax.once([*body, let("result", self.fixed(goes)), leave()])

    def changed(self, part: Part) -> Statements:
        """Returns the statements that give a decorator its result for that of its child."""
        for_success, for_failure = part.results
        if for_success == for_failure:
            return [let("result", self.fixed(for_success))]
        test = syntax.same(load("result"), self.fixed(S))
        return [when(test, *([let("result", self.fixed(each))] for each in (for_success, for_failure)))]

    def parallel(self, root: Part) -> Statements:
        """Returns the statements for a slice of a ParallelAll whose children are RUNNING."""
        body: Statements = []
        for child in root.children:
            unticked = self.in_parallel(self.rest(child, NODE, self.fixed("UNTICKED")))
            if child.kind is CALL:
                body += [*self.unmark(), *unticked]
                continue
            other = syntax.other(load("returned"), self.fixed("PY_RUNNING"))
            rest = self.rest(child, UPDATE, load("returned"))
            usual = [*self.count(child, "running"), *self.time(child)]
            running = [
                *self.begin_leaf(child),
                let("returned", self.called(child, UPDATE)),
                when(other, self.in_parallel(rest), usual),
            ]
            is_running = syntax.same(self.attribute(child, "status"), self.fixed("RUNNING"))
            body.append(when(is_running, running, unticked))
        return [*body, *self.unmark(), give()]

    def in_parallel(self, rest: ast.Call) -> Statements:
        """Returns the call that continues with a child outside of the function.

        If nodes ask a debugger, it may tick the other children, too.
        """
        return [when(rest, [give(self.fixed("RUNNING"))])] if self.variant.asks else [do(rest)]

    def child(self, part: Part, goes: str, level: int, *, is_careful: bool) -> Statements:
        """Returns the statements that tick a child.

        They leave the loop with the `result` of the child if it is not `goes`. With `is_careful`, the child
        may be RUNNING; otherwise it is IDLE, since its parent starts.
        """
        if part.kind is BUNDLE:
            return [do(call(self.fixed("RESULTS"), self.value(part, NODE)))]
        if part.kind is CALL:
            return self.called_child(part, goes, level)
        body: Statements = []
        if is_careful:
            busy = syntax.other(self.attribute(part, "status"), self.fixed("IDLE"))
            body.append(when(busy, [give(self.rest(part, NODE, self.fixed("UNTICKED")))]))
        body += self.asked_before(part)
        if part.kind not in COMPOSITES:
            return [*body, *self.begin_leaf(part), *self.before(part), *self.leaf(part, goes)]
        if part.is_guarded:
            body += [*self.unmark(), *self.before(part)]
        body += self.composite(part, level + 1)
        if part.is_guarded:
            body += self.unmark()
        body += self.by_result(self.after(part, S), self.after(part, F))
        return [*body, when(syntax.other(load("result"), self.fixed(goes)), [leave()])]

    def called_child(self, part: Part, goes: str, level: int) -> Statements:
        """Returns the statements that tick a child by a call."""
        ticked = syntax.item(load(f"ticks{level}"), number(part.position))
        other = syntax.other(load("result"), self.fixed(goes))
        ends = syntax.same(load("result"), self.fixed(OTHER[goes]))
        rest = give(self.rest(part, NODE, load("result")))
        is_over = syntax.attribute(self.fixed("EPOCH"), "is_over") if self.variant.asks else None
        return [
            *self.unmark(),
            let("result", call(ticked)),
            *([when(is_over, [rest])] if is_over is not None else []),
            when(other, [when(ends, [leave()], [rest])]),
        ]

    def leaf(self, part: Part, goes: str) -> Statements:
        """Returns the statements that tick a leaf."""
        ends = OTHER[goes]
        if part.kind is CONSTANT:
            return self.ended(part, part.results[0], goes)
        if part.kind is RUN:
            return [do(self.called(part, UPDATE)), *self.ended(part, S, goes)]
        if part.kind is TEST:
            test: ast.expr = self.called(part, UPDATE)
            missed = test if goes == F else syntax.negated(test)
            return [when(missed, self.ended(part, ends, goes)), *self.ended(part, goes, goes)]
        returned = load("returned")
        ending = syntax.same(returned, self.fixed(f"PY_{ends}"))
        rest = give(self.rest(part, UPDATE, returned))
        unusual = [when(ending, self.ended(part, ends, goes)), rest]
        return [
            *self.initialised(part),
            let("returned", self.called(part, UPDATE)),
            when(syntax.other(returned, self.fixed(f"PY_{goes}")), unusual),
            *self.ended(part, goes, goes),
        ]

    def initialised(self, part: Part) -> Statements:
        """Returns the call of `initialise`, if the class has its own."""
        if INITIALISE not in part.has:
            return []
        initialise = do(self.called(part, INITIALISE))
        if part.kind is not IMMEDIATE:
            return [initialise]
        return [when(syntax.other(self.attribute(part, "status"), self.fixed("RUNNING")), [initialise])]

    def ended(self, part: Part, status: str, goes: str) -> Statements:
        """Returns the statements that give a leaf its result, and leave the loop if it is not `goes`."""
        body: Statements = []
        if part.kind in (STATEFUL, IMMEDIATE):
            if TERMINATE in part.has:
                body.append(do(self.called(part, TERMINATE, load("returned"))))
            body.append(self.set_status(part, load("returned"), BEHAVIOUR))
        body.append(self.set_status(part, self.fixed(status)))
        if status != goes and self.is_pending:
            body.append(do(call(self.fixed("FLUSH"), number(FIRST_LINE + part.place(NODE)))))
        if status != goes or not part.is_bundled:
            body += self.mark(part, status)
        body += self.after(part, status)
        if status != goes:
            body += [let("result", self.fixed(status)), leave()]
        return body

    def before(self, part: Part) -> Statements:
        """Returns the tests of a node's conditions; one that decides leaves the function."""
        body: Statements = []
        for letter in (*DECIDING, WHILE):
            if letter in part.has:
                test: ast.expr = self.called(part, letter)
                decides = syntax.negated(test) if letter == WHILE else test
                body.append(when(decides, [give(self.rest(part, letter, self.fixed("UNTICKED")))]))
        return body

    def after(self, part: Part, status: str) -> Statements:
        """Returns the calls of a node's post-conditions, its time if it is a leaf, and its count."""
        own = ON_SUCCESS if status == S else ON_FAILURE
        calls = [do(self.called(part, letter)) for letter in (own, POST) if letter in part.has]
        time = [] if part.kind in COMPOSITES else self.time(part)
        asked = [*self.held(part, status), *self.asked_after(part, status)]
        return [*calls, *time, *asked, *self.count(part, status.lower())]

    def held(self, part: Part, status: str) -> Statements:
        """Returns the way out for a leaf within whose tick the tree was held."""
        if not self.variant.can_hold(part.kind):
            return []
        is_over = syntax.attribute(self.fixed("EPOCH"), "is_over")
        return [when(is_over, [give(self.rest(part, NODE, self.fixed(status)))])]

    def asked_before(self, part: Part) -> Statements:
        """Returns the question to a debugger before a node's tick."""
        if IF_BEFORE in part.has:
            return self.tested(part, IF_BEFORE)
        if ASK_BEFORE not in part.has:
            return []
        rest = give(self.rest(part, ASK_BEFORE, self.fixed("UNTICKED")))
        return [*self.unmark(), when(self.called(part, ASK_BEFORE), [rest])]

    def asked_after(self, part: Part, status: str) -> Statements:
        """Returns the question to a debugger after a node's result."""
        tested, letter = (IF_SUCCESS, AFTER_SUCCESS) if status == S else (IF_FAILURE, AFTER_FAILURE)
        if tested in part.has:
            return self.tested(part, tested)
        if letter not in part.has:
            return []
        asked = let("returned", self.called(part, letter))
        changed = syntax.other(load("returned"), self.fixed("UNCHANGED"))
        return [*self.unmark(), asked, when(changed, [give(self.rest(part, letter, load("returned")))])]

    def tested(self, part: Part, letter: str) -> Statements:
        """Returns the way out for a node at which a condition of its breakpoints is true."""
        test = self.value(part, letter)
        line = FIRST_LINE + part.place(letter)
        is_true = call(
            syntax.at(syntax.attribute(test, "is_true"), line), line=line
        )  # both have it in errors
        leaving = when(is_true, [give(self.rest(part, letter, self.fixed("UNTICKED")))])
        return [when(syntax.attribute(test, "is_doubtful"), [leaving])]

    def count(self, part: Part, result: str) -> Statements:
        """Returns the count of a result."""
        return [syntax.count(self.value(part, COUNT), result)] if COUNT in part.has else []

    def mark(self, part: Part, status: str) -> Statements:
        """Returns the report of a result to the observers, unless it is in a bundle."""
        if not self.variant.is_observed:
            return []
        if part.kind in COMPOSITES and status == part.results[0]:
            if part.is_bundled:
                return []
            if END in part.has:
                return [do(call(self.fixed("RESULTS"), self.value(part, END)))]
        mark = syntax.item(self.attribute(part, "marks"), number(MARK_OF[status]))
        return [do(call(self.fixed("RESULTS"), mark))]

    def by_result(self, succeeded: Statements, failed: Statements) -> Statements:
        """Returns a choice between two groups of statements by `result`."""
        if not succeeded and not failed:
            return []
        if not succeeded:
            return [when(syntax.other(load("result"), self.fixed(S)), failed)]
        return [when(syntax.same(load("result"), self.fixed(S)), succeeded, failed)]

    def ticks(self, part: Part, level: int) -> Statements:
        """Returns the look-up of the functions that tick the children that are called."""
        if not any(child.kind is CALL for child in part.children):
            return []
        ticks: ast.expr = self.attribute(part, "ticks")
        return [let(f"ticks{level}", syntax.item(ticks, self.value(part, SLICE)) if part.is_slice else ticks)]

    def begin_leaf(self, part: Part) -> Statements:
        """Returns the statements before a leaf: the mark of the action in progress, and the time."""
        body: Statements = []
        if UID in part.has:
            body.append(syntax.put_first(self.fixed("CURRENT"), self.value(part, UID)))
        if self.variant.times:
            body.append(let("start", call(self.fixed("CLOCK"))))
        return body

    def unmark(self) -> Statements:
        """Returns the statement that removes the mark of the action in progress."""
        return [syntax.put_first(self.fixed("CURRENT"), number(0))] if self.variant.marks else []

    def time(self, part: Part) -> Statements:
        """Returns the measurement of a leaf, and the note if it was the slowest."""
        if not self.variant.times:
            return []
        slowest = syntax.attribute(self.fixed("TREE"), "slowest")
        note = syntax.pair(load("duration"), self.value(part, UID))
        return [
            let("duration", syntax.difference(call(self.fixed("CLOCK")), load("start"))),
            when(
                syntax.greater(load("duration"), syntax.item(slowest, number(0))),
                [syntax.put(self.fixed("TREE"), "slowest", note)],
            ),
        ]


def meanings(root: Part) -> Iterator[tuple[int, Meaning]]:
    """Yields each line of a shape with its meaning."""
    yield from _meanings(root, [], "")


def _meanings(part: Part, pending: list[tuple[int, int]], goes: str) -> Iterator[tuple[int, Meaning]]:
    """Yields the lines of a part.

    Args:
        part: the part.
        pending: what waits before it, and afterwards what waits behind it.
        goes: the result after which the node above continues.
    """
    for offset, letter in enumerate(part.has):
        if letter not in _RESULT_OF:
            yield FIRST_LINE + part.first + offset, Meaning(part, letter, tuple(pending))
    child_goes = S if part.kind in (WRAPPER, SUBTREE) else part.results[0]
    for child in part.children:
        yield from _meanings(child, pending, child_goes)
    if part.is_bundled:
        pending.append((part.first, MARK_OF[goes]))
    else:
        pending.clear()
    for offset, letter in enumerate(part.has):
        if letter in _RESULT_OF:  # after another result, all that waited has been reported
            waiting = tuple(pending) if _RESULT_OF[letter] == goes else ()
            yield FIRST_LINE + part.first + offset, Meaning(part, letter, waiting)
