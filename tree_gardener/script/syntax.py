"""The syntax tree of a script. Each node has the span of its text."""

import dataclasses
from collections.abc import Iterator

Span = tuple[int, int]


@dataclasses.dataclass(frozen=True)
class Expression:
    """The base of all expressions."""

    span: Span


@dataclasses.dataclass(frozen=True)
class Literal(Expression):
    """A number or a string; ``true`` and ``false`` are 1.0 and 0.0."""

    value: int | float | str


@dataclasses.dataclass(frozen=True)
class Name(Expression):
    """An enum constant or a blackboard entry."""

    name: str


@dataclasses.dataclass(frozen=True)
class Unary(Expression):
    """``-x``, ``~x`` or ``!x``."""

    operator: str
    operand: Expression


@dataclasses.dataclass(frozen=True)
class Binary(Expression):
    """Arithmetic, bits, logic, or joining of strings."""

    operator: str
    left: Expression
    right: Expression


@dataclasses.dataclass(frozen=True)
class Comparison(Expression):
    """``a < b < c``: each neighbouring pair must hold."""

    first: Expression
    rest: tuple[tuple[str, Expression], ...]


@dataclasses.dataclass(frozen=True)
class Conditional(Expression):
    """``condition ? then : otherwise``."""

    condition: Expression
    then: Expression
    otherwise: Expression


@dataclasses.dataclass(frozen=True)
class Assignment(Expression):
    """``target := value`` and similar operators; whether the target is a name is tested only when it runs."""

    operator: str
    target: Expression
    value: Expression


@dataclasses.dataclass(frozen=True)
class Program:
    """A whole script: the value of its last statement is its value."""

    text: str
    statements: tuple[Expression, ...]


def walk(expression: Expression) -> Iterator[Expression]:
    """Yields the expression and all its parts, in the order of the text."""
    waiting = [expression]
    while waiting:
        each = waiting.pop()
        yield each
        waiting.extend(reversed(parts(each)))


def left_side(expression: Binary) -> tuple[Expression, list[Binary]]:
    """Returns the first operand of a chain of operators, and the operators in the order of the text."""
    first: Expression = expression
    chain = []
    while isinstance(first, Binary):
        chain.append(first)
        first = first.left
    return first, chain[::-1]


def depth(program: Program) -> int:
    """Returns the depth to which the evaluator's functions call each other."""
    deepest = 0
    waiting = [(statement, 1) for statement in program.statements]
    while waiting:
        each, level = waiting.pop()
        deepest = max(deepest, level)
        if isinstance(each, Binary):
            first, chain = left_side(each)
            waiting += [(first, level + 1), *((operator.right, level + 1) for operator in chain)]
        else:
            waiting += [(part, level + (not isinstance(each, Unary))) for part in parts(each)]
    return deepest


def parts(expression: Expression) -> tuple[Expression, ...]:
    """Returns the expressions that an expression consists of."""
    if isinstance(expression, Unary):
        return (expression.operand,)
    if isinstance(expression, Binary):
        return (expression.left, expression.right)
    if isinstance(expression, Comparison):
        return (expression.first, *(right for _, right in expression.rest))
    if isinstance(expression, Conditional):
        return (expression.condition, expression.then, expression.otherwise)
    if isinstance(expression, Assignment):
        return (expression.target, expression.value)
    return ()


def names_written(program: Program) -> list[Name]:
    """Returns the names that the script assigns to."""
    return [
        part.target
        for statement in program.statements
        for part in walk(statement)
        if isinstance(part, Assignment) and isinstance(part.target, Name)
    ]


def names_read(program: Program) -> list[Name]:
    """Returns the names whose value the script needs, without names that it only creates by ``:=``."""
    created = {
        id(part.target)
        for statement in program.statements
        for part in walk(statement)
        if isinstance(part, Assignment) and part.operator == ":="
    }
    return [
        part
        for statement in program.statements
        for part in walk(statement)
        if isinstance(part, Name) and id(part) not in created
    ]
