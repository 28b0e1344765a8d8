"""Functions that compiled scripts call if their fast path does not apply.

Compiled code tests the exact types of its values first. Rare values and all errors are handled here, by the
evaluator's own functions; so both ways of running a script have the same rules and texts. The arguments of
each function are the environment and the part of the syntax tree that it handles.
"""

from typing import Any, Final

from tree_gardener.blackboard import Entry
from tree_gardener.script import assignments, evaluator, operators
from tree_gardener.script.environment import Environment
from tree_gardener.script.syntax import Assignment, Binary, Comparison, Conditional, Name, Program, Unary


def read(environment: Environment, name: Name) -> Entry:
    """Returns the entry that a name means, after all remappings."""
    return evaluator.entry_of(environment, name)


def unary(_environment: Environment, expression: Unary, value: Any) -> float:
    """Applies a prefix operator."""
    return operators.prefixed(expression, value)


def negation(_environment: Environment, expression: Unary, value: Any) -> bool:
    """Applies ``!``."""
    return operators.prefixed(expression, value) != 0.0


def binary(_environment: Environment, expression: Binary, left: Any, right: Any) -> Any:
    """Applies an operator with two sides."""
    return operators.combine(expression, left, right)


def logic(_environment: Environment, expression: Binary, left: Any, right: Any) -> bool:
    """Applies ``&&`` or ``||``."""
    return bool(operators.combine(expression, left, right))


def comparison(environment: Environment, expression: Comparison, symbol: str, left: Any, right: Any) -> bool:
    """Compares one pair of a chain."""
    return operators.compared(environment, expression, symbol, left, right)


def choice(_environment: Environment, expression: Conditional, value: Any) -> float:
    """Returns the number that decides between the branches."""
    return operators.decision(expression, value)


def target(environment: Environment, expression: Assignment) -> Entry:
    """Returns the entry to which a value is assigned; ``:=`` creates it."""
    return assignments.target_of(environment, expression)


def assign(environment: Environment, expression: Assignment, entry: Entry, value: Any) -> Any:
    """Assigns a value to an entry, and returns the value that was stored."""
    return assignments.assign(environment, expression, entry, value)


def refuse(_environment: Environment, expression: Assignment) -> Any:
    """Raises the error of an assignment to something that is not an entry."""
    raise assignments.no_target(expression)


def truth(_environment: Environment, program: Program, value: Any) -> bool:
    """Returns the value of a condition as true or false."""
    return evaluator.truth(program, value)


NAMES: Final = frozenset(
    (
        *("assign", "binary", "choice", "comparison", "logic", "negation"),
        *("read", "refuse", "target", "truth", "unary"),
    )
)
