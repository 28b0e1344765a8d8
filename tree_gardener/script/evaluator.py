"""Evaluates scripts: each expression becomes a closure once, which then runs on a blackboard.

The rules are those of BehaviorTree.CPP 4.10: all arithmetic is in doubles, ``&&`` and ``||`` evaluate both
sides, ``==`` has a tolerance, and an assignment keeps the type of an existing entry.
"""

import functools
import math
import operator
from collections.abc import Callable, Mapping
from typing import Any, Final

from tree_gardener.blackboard import EMPTY, Blackboard, Entry
from tree_gardener.errors import ScriptError
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
    Span,
    Unary,
)
from tree_gardener.values import (
    ANY,
    INT64,
    ConversionError,
    as_number,
    format_number,
    parse_double,
    to_bool,
    type_name_of,
)

TOLERANCE: Final = 1.1920928955078125e-07  # FLT_EPSILON, for == and != only
EXACT: Final = 2**53  # from here on BehaviorTree.CPP makes no doubles of integers
TWO_TO_63: Final = 2.0**63


class Environment:
    """The environment of a script: a scope of the blackboard, the constants, and the uid that writes."""

    __slots__ = ("board", "enums", "writer")

    def __init__(self, board: Blackboard, enums: Mapping[str, int], writer: int = 0) -> None:
        self.board = board
        self.enums = enums
        self.writer = writer


Evaluator = Callable[[Environment], Any]


class Script:
    """A compiled script."""

    __slots__ = ("program", "run")

    def __init__(self, program: Program) -> None:
        self.program = program
        self.run: Evaluator = _sequence([_compile(statement) for statement in program.statements])

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
    operand = _compile(expression.operand)
    return lambda environment: prefixed(expression, operand(environment))


def prefixed(expression: Unary, value: Any) -> float:
    """Applies a prefix to a value."""
    try:
        return _PREFIX[expression.operator](_number(value, expression))
    except ConversionError as error:
        raise ScriptError(expression.span, str(error)) from None


def _number(value: Any, expression: Expression) -> float:
    number = as_number(value)
    if number is None:
        raise ScriptError(expression.span, f"a number is needed, not {_kind(value)}")
    return _real(number, expression.span)


def _real(number: float, span: Span) -> float:
    """Returns a number as the double that scripts compute with."""
    if isinstance(number, int) and abs(number) >= EXACT:
        hint = f"scripts compute with integers below {EXACT}"
        raise ScriptError(span, f"{number} is too large to compute with", hint)
    return float(number)


def _kind(value: Any) -> str:
    return "an entry without a value" if value is EMPTY else f"a value of type {type_name_of(value)}"


def _complement(value: float) -> float:
    if value < -TWO_TO_63 or value > TWO_TO_63:
        raise ConversionError(f"'~' works on integers of 64 bits, not on {format_number(value)}")
    # NaN, and doubles from 2^63 on, become the smallest integer, as x86's conversion does.
    return float(~int(value if value < TWO_TO_63 else -TWO_TO_63))


_PREFIX: Final[dict[str, Callable[[float], float]]] = {
    "-": lambda value: -value,
    "~": _complement,
    "!": lambda value: 0.0 if value else 1.0,
}


def _divide(left: float, right: float) -> float:
    if right:
        return float(left) / float(right)
    if not left or math.isnan(left):
        return left if left else -math.nan  # the sign that x86 gives NaN, which its text shows
    return math.copysign(math.inf, left) * math.copysign(1.0, right)


_ARITHMETIC: Final[dict[str, Callable[[float, float], float]]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": _divide,
}
_BITS: Final[dict[str, Callable[[int, int], int]]] = {
    "&": operator.and_,
    "|": operator.or_,
    "^": operator.xor,
}


def _binary(expression: Binary) -> Evaluator:
    left, right = _compile(expression.left), _compile(expression.right)

    def run(environment: Environment) -> Any:
        first = left(environment)
        return combine(expression, first, right(environment))

    return run


def combine(expression: Binary, left: Any, right: Any) -> Any:
    """Applies an operator to the values of its sides."""
    return _COMBINE[expression.operator](expression.span, left, right)


def _arithmetic(symbol: str, span: Span, left: Any, right: Any) -> Any:
    a, b = as_number(left), as_number(right)
    if a is not None and b is not None:
        return _ARITHMETIC[symbol](_real(a, span), _real(b, span))
    if symbol == "+" and isinstance(left, str) and isinstance(right, str):
        return left + right
    raise ScriptError(
        span,
        f"'{symbol}' does not work on {_kind(left)} and {_kind(right)}",
        "join strings and numbers with '..'" if symbol == "+" else "",
    )


def _join(span: Span, left: Any, right: Any) -> Any:
    a, b = as_number(left), as_number(right)
    if (a is None and not isinstance(left, str)) or (b is None and not isinstance(right, str)):
        raise ScriptError(span, f"'..' does not join {_kind(left)} and {_kind(right)}")
    if a is not None and b is not None:
        return EMPTY  # BehaviorTree.CPP leaves the value uninitialised
    return (left if a is None else format_number(a)) + (right if b is None else format_number(b))


def _bits(symbol: str, span: Span, left: Any, right: Any) -> float:
    a, b = as_number(left), as_number(right)
    if a is None or b is None:
        raise ScriptError(span, f"'{symbol}' does not work on {_kind(left)} and {_kind(right)}")
    if not all(
        number.is_integer() and -TWO_TO_63 <= number < TWO_TO_63
        for number in (_real(a, span), _real(b, span))
    ):
        raise ScriptError(span, f"'{symbol}' works on integers only, of 64 bits")
    return float(_BITS[symbol](int(a), int(b)))


def _logic(symbol: str, span: Span, left: Any, right: Any) -> float:
    if as_number(left) is None or as_number(right) is None:
        raise ScriptError(span, f"'{symbol}' does not work on {_kind(left)} and {_kind(right)}")
    try:
        a, b = to_bool(left), to_bool(right)
    except ConversionError as error:
        raise ScriptError(span, f"'{symbol}': {error}", "compare it: x > 0") from None
    return float(a and b) if symbol == "&&" else float(a or b)


_COMBINE: Final[dict[str, Callable[[Span, Any, Any], Any]]] = {
    "..": _join,
    **{symbol: functools.partial(_arithmetic, symbol) for symbol in "+-*/"},
    **{symbol: functools.partial(_bits, symbol) for symbol in "&|^"},
    **{symbol: functools.partial(_logic, symbol) for symbol in ("&&", "||")},
}


def _equal(left: Any, right: Any) -> bool:
    if isinstance(left, str):
        return bool(left == right)
    return bool(abs(left - right) <= TOLERANCE)  # so that infinity is not even equal to itself


_COMPARE: Final[dict[str, Callable[[Any, Any], bool]]] = {
    "==": _equal,
    "!=": lambda left, right: not _equal(left, right),
    # Tested by the opposite, as in BehaviorTree.CPP: NaN is less and greater than all.
    "<": lambda left, right: not left >= right,
    ">": lambda left, right: not left <= right,
    "<=": lambda left, right: not left > right,
    ">=": lambda left, right: not left < right,
}


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


def compared(environment: Environment, expression: Comparison, symbol: str, left: Any, right: Any) -> bool:
    """Compares one pair of a chain."""
    return _COMPARE[symbol](*_comparable(left, right, environment, expression.span))


def _comparable(left: Any, right: Any, environment: Environment, span: Span) -> tuple[Any, Any]:
    if isinstance(left, str) and isinstance(right, str):
        return left, right
    a, b = as_number(left), as_number(right)
    if a is None and b is not None and isinstance(left, str):
        a = _text_to_number(left, environment, span)
    elif b is None and a is not None and isinstance(right, str):
        b = _text_to_number(right, environment, span)
    if a is None or b is None:
        raise ScriptError(span, f"{_kind(left)} cannot be compared with {_kind(right)}")
    return _real(a, span), _real(b, span)


def _text_to_number(text: str, environment: Environment, span: Span) -> float:
    if text in ("true", "false"):
        return 1.0 if text == "true" else 0.0
    if text in environment.enums:
        return float(environment.enums[text])
    try:
        return parse_double(text)
    except ConversionError as error:
        raise ScriptError(span, str(error)) from None


def _conditional(expression: Conditional) -> Evaluator:
    condition = _compile(expression.condition)
    then, otherwise = _compile(expression.then), _compile(expression.otherwise)

    def run(environment: Environment) -> Any:
        chosen = decision(expression, condition(environment))
        return then(environment) if chosen else otherwise(environment)

    return run


def decision(expression: Conditional, value: Any) -> float:
    """Returns the number that decides between the branches; 0 selects the second one."""
    span = expression.condition.span
    number = as_number(value)
    if number is None:
        if not isinstance(value, str):
            raise ScriptError(span, f"a number is needed, not {_kind(value)}")
        try:
            number = parse_double(value)
        except ConversionError as error:
            raise ScriptError(span, str(error)) from None
    return _real(number, span)


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


def no_target(expression: Assignment) -> ScriptError:
    """Returns the error of an assignment to something that is not an entry."""
    return ScriptError(
        expression.target.span, "only a blackboard entry can be assigned to", "compare with =="
    )


def target_of(environment: Environment, expression: Assignment) -> Entry:
    """Returns the entry that is assigned to, which exists before the right side is evaluated."""
    target = expression.target
    assert isinstance(target, Name)
    entry = environment.board.find(target.name)
    if entry is None:
        if expression.operator != ":=":
            raise ScriptError(target.span, f"there is no entry '{target.name}'", "create it with :=")
        entry = environment.board.create(target.name, None)
    return entry


def assign(environment: Environment, expression: Assignment, entry: Entry, right: Any) -> Any:
    """Assigns a value to an entry, and returns the value that was stored."""
    span, symbol = expression.span, expression.operator
    if right is EMPTY:
        assert isinstance(expression.target, Name)
        hint = "'..' gives no value for two numbers" if isinstance(expression.value, Binary) else ""
        message = f"there is no value to assign to '{expression.target.name}'"
        raise ScriptError(expression.value.span, message, hint)
    if symbol in (":=", "="):
        result = _assigned(entry, right, environment, span)
    else:
        result = _compound(entry, symbol[0], right, span)
    entry.write(result, environment.writer)
    return result


def _assigned(entry: Entry, value: Any, environment: Environment, span: Span) -> Any:
    """Returns the value that an entry gets when `value` is assigned to it."""
    old = entry.value
    if old is EMPTY and entry.type is None:
        return value
    if isinstance(value, str) and entry.type is ANY:
        hint = "write it from a node with a string port, or watch another entry"
        raise ScriptError(
            span, f"'{entry.key}' is watched or was copied to, and takes no string from a script", hint
        )
    if isinstance(value, str) and not isinstance(old, str):
        if not entry.is_strong:
            if as_number(old) is None:
                return value
            return _text_to_number(value, environment, span)
        assert entry.type is not None
        try:
            return entry.type.parse(value)
        except ConversionError as error:
            raise ScriptError(span, f"entry '{entry.key}' is of type {entry.type.name}: {error}") from None
    return _copied(entry, value, span)


def _copied(entry: Entry, value: Any, span: Span) -> Any:
    """Converts a value to the kind of number that the entry holds, as BT.CPP's ``Any::copyInto``."""
    old = entry.value
    if old is EMPTY or type(old) is type(value):
        return value
    target, number = as_number(old), as_number(value)
    if target is None and number is None and not isinstance(old, str):
        return value
    if target is None or number is None:
        raise ScriptError(
            span,
            f"{_kind(value)} cannot be assigned to '{entry.key}', which is {_kind(old)}",
            "use another entry",
        )
    if isinstance(target, float):
        return _real(number, span)
    if isinstance(number, float) and not (number.is_integer() and INT64[0] <= number <= INT64[1]):
        raise ScriptError(
            span, f"{format_number(number)} cannot be assigned to '{entry.key}', which holds an integer", ""
        )
    whole = int(number)
    return bool(whole) if isinstance(old, bool) and whole in (0, 1) else whole


def _compound(entry: Entry, symbol: str, value: Any, span: Span) -> Any:
    old, number = as_number(entry.value), as_number(value)
    if number is not None:
        if old is None:
            raise ScriptError(span, f"'{symbol}=' needs a number in '{entry.key}', not {_kind(entry.value)}")
        return _copied(entry, _ARITHMETIC[symbol](_real(old, span), _real(number, span)), span)
    if symbol != "+" or not isinstance(value, str) or not isinstance(entry.value, str):
        raise ScriptError(span, f"'{symbol}=' does not work on {_kind(entry.value)} and {_kind(value)}")
    return entry.value + value


_COMPILERS: Final[dict[type, Callable[[Any], Evaluator]]] = {
    Literal: _literal,
    Name: _name,
    Unary: _unary,
    Binary: _binary,
    Comparison: _comparison,
    Conditional: _conditional,
    Assignment: _assignment,
}
