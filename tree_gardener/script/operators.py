"""The operators of scripts on values: prefixes, arithmetic, bits, logic, comparisons and ``? :``.

All arithmetic is in doubles, ``&&`` and ``||`` evaluate both sides, and ``==`` has a tolerance, as in
BehaviorTree.CPP 4.10.
"""

import functools
import math
import operator
from collections.abc import Callable
from typing import Any, Final

from tree_gardener.blackboard import EMPTY
from tree_gardener.errors import ScriptError
from tree_gardener.script.environment import Environment
from tree_gardener.script.syntax import Binary, Comparison, Conditional, Expression, Span, Unary
from tree_gardener.values import (
    ConversionError,
    as_number,
    format_number,
    parse_double,
    to_bool,
    value_words,
)

TOLERANCE: Final = 1.1920928955078125e-07  # FLT_EPSILON, for == and != only
EXACT: Final = 2**53  # from here on BehaviorTree.CPP makes no doubles of integers
TWO_TO_63: Final = 2.0**63


def prefixed(expression: Unary, value: Any) -> float:
    """Applies a prefix to a value."""
    try:
        return _PREFIX[expression.operator](_number(value, expression))
    except ConversionError as error:
        raise ScriptError(expression.span, str(error)) from None


def _number(value: Any, expression: Expression) -> float:
    number = as_number(value)
    if number is None:
        raise ScriptError(expression.span, f"a number is needed, not {kind_of(value)}")
    return real(number, expression.span)


def real(number: float, span: Span) -> float:
    """Returns a number as the double that scripts compute with."""
    if isinstance(number, int) and abs(number) >= EXACT:
        hint = f"scripts compute with whole numbers below {EXACT}"
        raise ScriptError(span, f"{number} is too large to compute with", hint)
    return float(number)


def kind_of(value: Any) -> str:
    """Describes the type of a value in messages."""
    return "an entry without a value" if value is EMPTY else value_words(value)


def _complement(value: float) -> float:
    if value < -TWO_TO_63 or value > TWO_TO_63:
        raise ConversionError(f"'~' works on whole numbers of 64 bits, not on {format_number(value)}")
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


ARITHMETIC: Final[dict[str, Callable[[float, float], float]]] = {
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


def combine(expression: Binary, left: Any, right: Any) -> Any:
    """Applies an operator to the values of its sides."""
    return _COMBINE[expression.operator](expression.span, left, right)


def _arithmetic(symbol: str, span: Span, left: Any, right: Any) -> Any:
    a, b = as_number(left), as_number(right)
    if a is not None and b is not None:
        return ARITHMETIC[symbol](real(a, span), real(b, span))
    if symbol == "+" and isinstance(left, str) and isinstance(right, str):
        return left + right
    raise ScriptError(
        span,
        f"'{symbol}' does not work on {kind_of(left)} and {kind_of(right)}",
        "join strings and numbers with '..'" if symbol == "+" else "",
    )


def _join(span: Span, left: Any, right: Any) -> Any:
    a, b = as_number(left), as_number(right)
    if (a is None and not isinstance(left, str)) or (b is None and not isinstance(right, str)):
        raise ScriptError(span, f"'..' does not join {kind_of(left)} and {kind_of(right)}")
    if a is not None and b is not None:
        return EMPTY  # BehaviorTree.CPP leaves the value uninitialised
    return (left if a is None else format_number(a)) + (right if b is None else format_number(b))


def _bits(symbol: str, span: Span, left: Any, right: Any) -> float:
    a, b = as_number(left), as_number(right)
    if a is None or b is None:
        raise ScriptError(span, f"'{symbol}' does not work on {kind_of(left)} and {kind_of(right)}")
    if not all(
        number.is_integer() and -TWO_TO_63 <= number < TWO_TO_63 for number in (real(a, span), real(b, span))
    ):
        raise ScriptError(span, f"'{symbol}' works on whole numbers only, of 64 bits")
    return float(_BITS[symbol](int(a), int(b)))


def _logic(symbol: str, span: Span, left: Any, right: Any) -> float:
    if as_number(left) is None or as_number(right) is None:
        raise ScriptError(span, f"'{symbol}' does not work on {kind_of(left)} and {kind_of(right)}")
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


def compared(environment: Environment, expression: Comparison, symbol: str, left: Any, right: Any) -> bool:
    """Compares one pair of a chain."""
    return _COMPARE[symbol](*_comparable(left, right, environment, expression.span))


def _comparable(left: Any, right: Any, environment: Environment, span: Span) -> tuple[Any, Any]:
    if isinstance(left, str) and isinstance(right, str):
        return left, right
    a, b = as_number(left), as_number(right)
    if a is None and b is not None and isinstance(left, str):
        a = text_to_number(left, environment, span)
    elif b is None and a is not None and isinstance(right, str):
        b = text_to_number(right, environment, span)
    if a is None or b is None:
        raise ScriptError(span, f"{kind_of(left)} cannot be compared with {kind_of(right)}")
    return real(a, span), real(b, span)


def text_to_number(text: str, environment: Environment, span: Span) -> float:
    """Returns the number that a text means: a constant's, or one that is written out."""
    if text in ("true", "false"):
        return 1.0 if text == "true" else 0.0
    if text in environment.enums:
        return float(environment.enums[text])
    try:
        return parse_double(text)
    except ConversionError as error:
        raise ScriptError(span, str(error)) from None


def decision(expression: Conditional, value: Any) -> float:
    """Returns the number that decides between the branches; 0 selects the second one."""
    span = expression.condition.span
    number = as_number(value)
    if number is None:
        if not isinstance(value, str):
            raise ScriptError(span, f"a number is needed, not {kind_of(value)}")
        try:
            number = parse_double(value)
        except ConversionError as error:
            raise ScriptError(span, str(error)) from None
    return real(number, span)
