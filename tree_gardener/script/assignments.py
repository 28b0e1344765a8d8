"""Assignments of scripts: an existing entry keeps its type, as in BehaviorTree.CPP 4.10."""

from typing import Any

from tree_gardener.blackboard import EMPTY, Entry
from tree_gardener.errors import ScriptError
from tree_gardener.script.environment import Environment
from tree_gardener.script.operators import ARITHMETIC, kind_of, real, text_to_number
from tree_gardener.script.syntax import Assignment, Binary, Name, Span
from tree_gardener.type_words import type_words
from tree_gardener.values import ANY, INT64, ConversionError, as_number, format_number


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
            return text_to_number(value, environment, span)
        assert entry.type is not None
        try:
            return entry.type.parse(value)
        except ConversionError as error:
            held = type_words(entry.type.name)
            raise ScriptError(span, f"entry '{entry.key}' holds {held}: {error}") from None
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
            f"{kind_of(value)} cannot be assigned to '{entry.key}', which is {kind_of(old)}",
            "use another entry",
        )
    if isinstance(target, float):
        return real(number, span)
    if isinstance(number, float) and not (number.is_integer() and INT64[0] <= number <= INT64[1]):
        raise ScriptError(
            span,
            f"{format_number(number)} does not fit into '{entry.key}', which holds a whole number",
            "",
        )
    whole = int(number)
    return bool(whole) if isinstance(old, bool) and whole in (0, 1) else whole


def _compound(entry: Entry, symbol: str, value: Any, span: Span) -> Any:
    old, number = as_number(entry.value), as_number(value)
    if number is not None:
        if old is None:
            raise ScriptError(
                span, f"'{symbol}=' needs a number in '{entry.key}', not {kind_of(entry.value)}"
            )
        return _copied(entry, ARITHMETIC[symbol](real(old, span), real(number, span)), span)
    if symbol != "+" or not isinstance(value, str) or not isinstance(entry.value, str):
        raise ScriptError(span, f"'{symbol}=' does not work on {kind_of(entry.value)} and {kind_of(value)}")
    return entry.value + value
