"""The basis of generated scripts: variables, parameters and statements."""

import ast
import contextlib
import dataclasses
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Final

from tree_gardener import values
from tree_gardener.script import remedies
from tree_gardener.script.environment import Environment
from tree_gardener.script.operators import EXACT, TOLERANCE

ATTRIBUTES: Final = frozenset(("board", "journal", "sequence", "type", "value"))

REAL, TRUTH, TEXT, ANY = "real", "truth", "text", "any"
"""The known type of a value: exactly a float; a Python bool for 1.0 or 0.0; exactly a str; unknown."""

FIXED: Final[Mapping[str, Any]] = {
    "TYPE": type,
    "FLOAT": float,
    "INT": int,
    "BOOL": bool,
    "STR": str,
    "WATCHED": values.ANY,
    "NONE": None,
    "TRUE": True,
    "FALSE": False,
    "ZERO": 0.0,
    "ONE": 1.0,
    "STEP": 1,
    "LOW": -EXACT,
    "HIGH": EXACT,
    "BELOW": -TOLERANCE,
    "ABOVE": TOLERANCE,
    **{name.upper(): function for name, function in vars(remedies).items() if name in remedies.NAMES},
}
BOUND: Final[Mapping[str, Callable[[Environment], Any]]] = {
    "ENVIRONMENT": lambda environment: environment,
    "WRITER": lambda environment: environment.writer,
    "LOCAL": lambda environment: environment.board.entries.get,
    "GLOBAL": lambda environment: environment.board.root.entries.get,
}


@dataclasses.dataclass(frozen=True)
class Value:
    """A value that the code has computed, in a variable or a parameter."""

    name: str
    kind: str
    is_constant: bool = False


class Writer:
    """Collects the statements of one function.

    Attributes:
        parameters: name and value of each parameter, in the order of the function's defaults; a value in
            `BOUND` is made for each environment.
    """

    def __init__(self) -> None:
        self.parameters: dict[str, Any] = {}
        self.body: list[ast.stmt] = []
        self.variables = 0

    def fixed(self, name: str) -> ast.Name:
        """Returns a read of a parameter that all scripts have."""
        self.parameters.setdefault(name, FIXED.get(name))
        return load(name)

    def constant(self, value: Any) -> str:
        """Makes a parameter for a value; returns its name."""
        name = f"c{len(self.parameters)}"
        self.parameters[name] = value
        return name

    def call(self, remedy: Callable[..., Any], *arguments: Any) -> ast.Call:
        """Returns a call of a remedy; each argument is the name of a variable, or a part of the script."""
        names = [part if isinstance(part, str) else self.constant(part) for part in arguments]
        values = [self.fixed("ENVIRONMENT"), *map(load, names)]
        return call(self.fixed(remedy.__name__.upper()), *values)

    def set(self, value: ast.expr, name: str = "") -> str:
        """Adds an assignment to a variable, a new one unless `name` is given; returns its name."""
        if not name:
            name = f"t{self.variables}"
            self.variables += 1
        self.body.append(ast.Assign([ast.Name(name, ast.Store())], value))
        return name

    @contextlib.contextmanager
    def block(self) -> Iterator[list[ast.stmt]]:
        """Collects the statements of the context in a separate list, and yields the list."""
        outer, self.body = self.body, []
        try:
            yield self.body
        finally:
            self.body = outer

    def either(self, test: ast.expr, then: ast.expr, otherwise: ast.expr) -> str:
        """Adds the assignment of one of two values to a new variable; returns its name."""
        return self.set(ast.IfExp(test, then, otherwise))

    def has_type(self, name: str, kind: str) -> ast.expr:
        """Returns a test of the exact type of a variable."""
        return compare(call(self.fixed("TYPE"), load(name)), ast.Is, self.fixed(kind))

    def is_number(self, name: str) -> ast.expr:
        """Returns a test for a float, or for an integer that a double holds exactly."""
        kind = self.set(call(self.fixed("TYPE"), load(name)))
        is_real, is_integer = (compare(load(kind), ast.Is, self.fixed(each)) for each in ("FLOAT", "INT"))
        return either(is_real, both(is_integer, self.is_small(name)))

    def is_small(self, name: str) -> ast.expr:
        """Returns a test that a number is smaller than those that a double rounds."""
        return ast.Compare(self.fixed("LOW"), [ast.Lt(), ast.Lt()], [load(name), self.fixed("HIGH")])

    def known(self, value: Any) -> Value:
        """Returns the value of a constant of the script."""
        kind = REAL if type(value) is float else TEXT if type(value) is str else ANY
        return Value(self.constant(value), kind, is_constant=True)

    def raw(self, value: Value) -> str:
        """Returns the variable that holds the value in the form of the evaluator."""
        if value.kind is not TRUTH:
            return value.name
        return self.either(load(value.name), self.fixed("ONE"), self.fixed("ZERO"))

    def numeric(self, value: Value) -> Value:
        """Converts a value to a float, if that is known to be possible."""
        if value.kind is TRUTH:
            return Value(self.raw(value), REAL)
        if value.is_constant and type(number := self.parameters[value.name]) is int and abs(number) < EXACT:
            return Value(self.constant(float(number)), REAL, is_constant=True)
        return value

    def numbers(self, *values: Value) -> ast.expr | None:
        """Returns a test that all values are numbers; None if that is known."""
        tests = [self.is_number(value.name) for value in values if value.kind is not REAL]
        return both(*tests) if tests else None

    def fill(self, entry: str, value: str) -> None:
        """Adds the statements of `Entry.write`, without the call."""

        def attribute(owner: ast.expr, name: str, context: ast.expr_context) -> ast.Attribute:
            return ast.Attribute(owner, name, context)

        self.body.append(ast.Assign([attribute(load(entry), "value", ast.Store())], load(value)))
        count = attribute(load(entry), "sequence", ast.Store())
        self.body.append(ast.AugAssign(count, ast.Add(), self.fixed("STEP")))
        board = attribute(load(entry), "board", ast.Load())
        journal = self.set(attribute(board, "journal", ast.Load()))
        report = ast.Expr(call(load(journal), load(entry), self.fixed("WRITER")))
        self.body.append(ast.If(compare(load(journal), ast.IsNot, self.fixed("NONE")), [report], []))


def load(name: str) -> ast.Name:
    """Returns a read of a variable."""
    return ast.Name(name, ast.Load())


def call(function: ast.expr, *arguments: ast.expr) -> ast.Call:
    """Returns a call of a function."""
    return ast.Call(function, list(arguments), [])


def compare(left: ast.expr, operator: type[ast.cmpop], right: ast.expr) -> ast.Compare:
    """Returns a comparison of two values."""
    return ast.Compare(left, [operator()], [right])


def both(*tests: ast.expr) -> ast.expr:
    """Returns the expression `a and b and …`."""
    return tests[0] if len(tests) == 1 else ast.BoolOp(ast.And(), list(tests))


def either(*tests: ast.expr) -> ast.expr:
    """Returns the expression `a or b or …`."""
    return ast.BoolOp(ast.Or(), list(tests))
