"""Evaluates scripts: each expression becomes a closure once, which then runs on a blackboard.

The rules are those of BehaviorTree.CPP 4.10; those of single operators are in `operators` and `assignments`.
"""

import functools
from collections.abc import Callable
from typing import Any, Final

from tree_gardener.blackboard import EMPTY, Entry
from tree_gardener.deep import call_deep
from tree_gardener.errors import ScriptError
from tree_gardener.script.assignments import assign, no_target, target_of
from tree_gardener.script.environment import Environment
from tree_gardener.script.operators import (
    EXACT,
    TOLERANCE,
    TWO_TO_63,
    combine,
    compared,
    decision,
    prefixed,
)
from tree_gardener.script.parser import parse
from tree_gardener.script.syntax import (
    Assignment,
    Binary,
    Comparison,
    Conditional,
    Expression,
    Literal,
    Name,
    Program,
    Unary,
    depth,
    left_side,
)
from tree_gardener.values import ConversionError, as_number, to_bool

__all__ = [
    "EXACT",
    "TOLERANCE",
    "TWO_TO_63",
    "Environment",
    "Evaluator",
    "Script",
    "assign",
    "combine",
    "compared",
    "compile_script",
    "decision",
    "entry_of",
    "evaluate",
    "no_target",
    "prefixed",
    "target_of",
    "truth",
]

Evaluator = Callable[[Environment], Any]
_SHALLOW: Final = 40
"""The depth that Python's limit of recursion surely permits, also within a deep tree."""


class Script:
    """A compiled script."""

    __slots__ = ("program", "run")

    def __init__(self, program: Program) -> None:
        self.program = program
        levels = depth(program)
        if levels <= _SHALLOW:
            self.run: Evaluator = self._made()
            return
        run = call_deep(self._made, levels)
        self.run = lambda environment: call_deep(lambda: run(environment), levels)

    def _made(self) -> Evaluator:
        return _sequence([_compile(statement) for statement in self.program.statements])

    @property
    def text(self) -> str:
        """The source."""
        return self.program.text

    def test(self, environment: Environment) -> bool:
        """Runs the script as a condition.

        Raises:
            ScriptError: the script cannot be evaluated, or its value is neither true nor false.
        """
        return truth(self.program, self.run(environment))


@functools.lru_cache(maxsize=4096)
def compile_script(text: str) -> Script:
    """Parses and compiles a script.

    Raises:
        ScriptError: the script cannot be parsed.
    """
    return Script(parse(text))


def truth(program: Program, value: Any) -> bool:
    """Returns the value of a script as true or false.

    Raises:
        ScriptError: the value is neither.
    """
    span = (0, len(program.text))
    if value is EMPTY:
        raise ScriptError(span, "the condition has no value yet")
    try:
        return to_bool(value)
    except ConversionError as error:
        hint = "compare it: x == 1, x > 0" if as_number(value) is not None else "compare it: x == 'text'"
        raise ScriptError(span, str(error), hint) from None


def _sequence(statements: list[Evaluator]) -> Evaluator:
    if len(statements) == 1:
        return statements[0]
    *first, last = statements

    def run(environment: Environment) -> Any:
        for statement in first:
            statement(environment)
        return last(environment)

    return run


def evaluate(expression: Expression, environment: Environment) -> Any:
    """Evaluates one expression."""
    return _compile(expression)(environment)


def _compile(expression: Expression) -> Evaluator:
    return _COMPILERS[type(expression)](expression)


def _literal(expression: Literal) -> Evaluator:
    value = expression.value
    return lambda _environment: value


def _name(expression: Name) -> Evaluator:
    name = expression.name

    def run(environment: Environment) -> Any:
        constant = environment.enums.get(name)
        if constant is not None:
            return float(constant)
        return entry_of(environment, expression).value

    return run


def entry_of(environment: Environment, expression: Name) -> Entry:
    """Returns the entry that a name means, after all remappings."""
    entry = environment.board.find(expression.name)
    if entry is None:
        raise ScriptError(
            expression.span, f"there is no entry '{expression.name}'", "create it with := first"
        )
    return entry


def _unary(expression: Unary) -> Evaluator:
    prefixes = [expression]
    while isinstance(prefixes[-1].operand, Unary):
        prefixes.append(prefixes[-1].operand)
    operand = _compile(prefixes[-1].operand)

    def run(environment: Environment) -> Any:
        value = operand(environment)
        for prefix in reversed(prefixes):
            value = prefixed(prefix, value)
        return value

    return run


def _binary(expression: Binary) -> Evaluator:
    operand, chain = left_side(expression)
    first = _compile(operand)
    steps = [(each, _compile(each.right)) for each in chain]

    def run(environment: Environment) -> Any:
        value = first(environment)
        for each, right in steps:
            value = combine(each, value, right(environment))
        return value

    return run


def _comparison(expression: Comparison) -> Evaluator:
    first = _compile(expression.first)
    rest = [(symbol, _compile(right)) for symbol, right in expression.rest]

    def run(environment: Environment) -> float:
        left = first(environment)
        for symbol, evaluate in rest:
            right = evaluate(environment)
            if not compared(environment, expression, symbol, left, right):
                return 0.0
            left = right
        return 1.0

    return run


def _conditional(expression: Conditional) -> Evaluator:
    condition = _compile(expression.condition)
    then, otherwise = _compile(expression.then), _compile(expression.otherwise)

    def run(environment: Environment) -> Any:
        chosen = decision(expression, condition(environment))
        return then(environment) if chosen else otherwise(environment)

    return run


def _assignment(expression: Assignment) -> Evaluator:
    value = _compile(expression.value)
    if not isinstance(expression.target, Name):

        def fail(_environment: Environment) -> Any:
            raise no_target(expression)

        return fail

    def run(environment: Environment) -> Any:
        entry = target_of(environment, expression)
        return assign(environment, expression, entry, value(environment))

    return run


_COMPILERS: Final[dict[type, Callable[[Any], Evaluator]]] = {
    Literal: _literal,
    Name: _name,
    Unary: _unary,
    Binary: _binary,
    Comparison: _comparison,
    Conditional: _conditional,
    Assignment: _assignment,
}
