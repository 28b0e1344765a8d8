"""Generates Python syntax from a script: one function with a fast path for each step.

The syntax is built of `ast` nodes, and nothing of the script's text gets into it. Variables are ``t0``,
``t1`` …; keys, literals, enum constants and everything else from the document are parameters ``c0``, ``c1``
… whose defaults are bound by position. The attributes that the code reads are `ATTRIBUTES` of `writer`.

A step computes directly if the exact types of its values permit it; otherwise it calls a function of
`remedies`. So the evaluator handles rare values and all errors.
"""

import ast
import contextlib
from collections.abc import Callable, Mapping
from typing import Any, Final

from tree_gardener.blackboard import Blackboard
from tree_gardener.errors import ScriptError
from tree_gardener.script import remedies
from tree_gardener.script.environment import Environment
from tree_gardener.script.evaluator import evaluate
from tree_gardener.script.operators import EXACT
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
    parts,
)
from tree_gardener.script.writer import (
    ANY,
    REAL,
    TEXT,
    TRUTH,
    Value,
    Writer,
    both,
    call,
    compare,
    either,
    load,
)

MAX_PARTS: Final = 400
MAX_DEPTH: Final = 40
"""The deepest nesting of compiled scripts. Deeper or longer scripts are left to the evaluator."""
_OPERATORS: Final[dict[str, type[ast.operator]]] = {
    "+": ast.Add,
    "-": ast.Sub,
    "*": ast.Mult,
    "/": ast.Div,
}
_OPPOSITES: Final[dict[str, type[ast.cmpop]]] = {"<": ast.GtE, ">": ast.LtE, "<=": ast.Gt, ">=": ast.Lt}


class TooLargeError(Exception):
    """The script is left to the evaluator."""


def check_size(program: Program) -> None:
    """Refuses a script that may be too large for Python's compiler; uses no recursion itself.

    Raises:
        TooLargeError: the script has too many parts, or they are nested too deeply.
    """
    count = 0
    waiting = [(statement, 1) for statement in program.statements]
    while waiting:
        expression, depth = waiting.pop()
        count += 1
        if count > MAX_PARTS or depth > MAX_DEPTH:
            raise TooLargeError
        waiting += [(part, depth + 1) for part in parts(expression)]


class Generator(Writer):
    """Makes the function of one script."""

    def __init__(self, program: Program, enums: Mapping[str, int]) -> None:
        super().__init__()
        self.program = program
        self.enums = enums
        self.folding = Environment(Blackboard(), enums)

    def function(self, *, is_condition: bool) -> ast.Module:
        """Returns a module with the function; a condition returns true or false."""
        check_size(self.program)
        value = [self.value(statement) for statement in self.program.statements][-1]
        if is_condition:
            self.give_truth(value)
        else:
            self.body.append(ast.Return(load(self.raw(value))))
        arguments = ast.arguments(
            posonlyargs=[],
            args=[ast.arg(name) for name in self.parameters],
            kwonlyargs=[],
            kw_defaults=[],
            defaults=[],
        )
        function = ast.FunctionDef("script", arguments, self.body, decorator_list=[])
        module = ast.Module([function], type_ignores=[])
        return ast.fix_missing_locations(module)

    def value(self, expression: Expression) -> Value:
        """Adds the statements that compute an expression; returns its value."""
        if not isinstance(expression, (Literal, Name, Assignment)) and self.is_fixed(expression):
            # An expression that cannot be computed is an error only when it runs.
            with contextlib.suppress(ScriptError):
                return self.known(evaluate(expression, self.folding))
        return _WRITERS[type(expression)](self, expression)

    def literal(self, expression: Literal) -> Value:
        return self.known(expression.value)

    def is_fixed(self, expression: Expression) -> bool:
        """Returns whether an expression uses no entry."""
        if isinstance(expression, Name):
            return self.enums.get(expression.name) is not None
        return not isinstance(expression, Assignment) and all(map(self.is_fixed, parts(expression)))

    def name(self, expression: Name) -> Value:
        number = self.enums.get(expression.name)
        if number is not None:
            return self.known(float(number))
        found = either(self.local(expression.name), self.call(remedies.read, expression))
        return Value(self.set(ast.Attribute(found, "value", ast.Load())), ANY)

    def local(self, key: str) -> ast.expr:
        """Returns the look-up of an entry in the script's own scope, or for ``@`` in the root's scope."""
        is_global = key[:1] == "@"
        scope = self.fixed("GLOBAL" if is_global else "LOCAL")
        return call(scope, load(self.constant(key[1:] if is_global else key)))

    def unary(self, expression: Unary) -> Value:
        operand = self.value(expression.operand)
        name = operand.name
        if expression.operator == "!":
            inverse = ast.UnaryOp(ast.Not(), load(name))
            if operand.kind is TRUTH or operand.kind is REAL:
                return Value(self.set(inverse), TRUTH)
            test = either(self.has_type(name, "BOOL"), self.is_number(name))
            return Value(self.either(test, inverse, self.call(remedies.negation, expression, name)), TRUTH)
        name = self.raw(operand)
        remedy = self.call(remedies.unary, expression, name)
        if expression.operator == "~":
            return Value(self.set(remedy), REAL)
        negative = ast.UnaryOp(ast.USub(), load(name))
        return Value(self.either(self.has_type(name, "FLOAT"), negative, remedy), REAL)

    def binary(self, expression: Binary) -> Value:
        left = self.value(expression.left)
        right = self.value(expression.right)
        if expression.operator in _OPERATORS:
            return self.arithmetic(expression, left, right)
        if expression.operator in ("&&", "||"):
            return self.logic(expression, left, right)
        remedy = self.call(remedies.binary, expression, self.raw(left), self.raw(right))
        return (
            Value(self.set(remedy), REAL) if expression.operator != ".." else self.join(left, right, remedy)
        )

    def join(self, left: Value, right: Value, remedy: ast.expr) -> Value:
        """Adds the joining of texts, and of integers with texts; returns its value."""
        if TEXT not in (left.kind, right.kind):
            return Value(self.set(remedy), ANY)
        other = right if left.kind is TEXT else left
        if other.kind not in (TEXT, ANY):
            return Value(self.set(remedy), TEXT)
        sides = [
            load(side.name) if side.kind is TEXT else call(self.fixed("STR"), load(side.name))
            for side in (left, right)
        ]
        direct = ast.BinOp(sides[0], ast.Add(), sides[1])
        if other.kind is TEXT:
            return Value(self.set(direct), TEXT)
        test = either(self.has_type(other.name, "INT"), self.has_type(other.name, "STR"))
        return Value(self.either(test, direct, remedy), TEXT)

    def arithmetic(self, expression: Binary, left: Value, right: Value) -> Value:
        remedy = self.call(remedies.binary, expression, self.raw(left), self.raw(right))
        a, b = self.numeric(left), self.numeric(right)
        may_join = expression.operator == "+" and not (a.kind is REAL or b.kind is REAL)
        kind = ANY if may_join else REAL
        if TEXT in (a.kind, b.kind):
            return Value(self.set(remedy), kind)
        second: ast.expr = load(b.name)
        if a.kind is not REAL and b.kind is not REAL:  # two integers would stay integers
            second = ast.BinOp(second, ast.Mult(), self.fixed("ONE"))
        direct = ast.BinOp(load(a.name), _OPERATORS[expression.operator](), second)
        test = self.numbers(a, b)
        if expression.operator == "/":
            nonzero = compare(load(b.name), ast.NotEq, self.fixed("ZERO"))
            test = nonzero if test is None else both(test, nonzero)
        return Value(self.set(direct) if test is None else self.either(test, direct, remedy), kind)

    def logic(self, expression: Binary, left: Value, right: Value) -> Value:
        tests = [self.castable(value) for value in (left, right) if value.kind is not TRUTH]
        sides: list[ast.expr] = [
            load(value.name)
            if value.kind is TRUTH
            else compare(load(value.name), ast.NotEq, self.fixed("ZERO"))
            for value in (left, right)
        ]
        combined = ast.BoolOp(ast.And() if expression.operator == "&&" else ast.Or(), sides)
        if not tests:
            return Value(self.set(combined), TRUTH)
        remedy = self.call(remedies.logic, expression, self.raw(left), self.raw(right))
        return Value(self.either(both(*tests), combined, remedy), TRUTH)

    def castable(self, value: Value) -> ast.expr:
        """Returns a test for a bool, 0, 1, or a float that is not negative."""
        positive = compare(load(value.name), ast.GtE, self.fixed("ZERO"))
        if value.kind is REAL:
            return positive
        is_real = both(self.has_type(value.name, "FLOAT"), positive)
        bit = ast.Compare(self.fixed("ZERO"), [ast.LtE(), ast.LtE()], [load(value.name), self.fixed("ONE")])
        is_bit = both(self.has_type(value.name, "INT"), bit)
        return either(self.has_type(value.name, "BOOL"), is_real, is_bit)

    def comparison(self, expression: Comparison) -> Value:
        return Value(self.chain(expression, self.value(expression.first), 0), TRUTH)

    def chain(self, expression: Comparison, left: Value, index: int) -> str:
        """Adds the comparisons from one pair on; right sides after a false pair are not evaluated."""
        symbol, following = expression.rest[index]
        right = self.value(following)
        result = self.pair(expression, symbol, left, right)
        if index + 1 < len(expression.rest):
            with self.block() as rest:
                self.set(load(self.chain(expression, right, index + 1)), result)
            self.body.append(ast.If(load(result), rest, []))
        return result

    def pair(self, expression: Comparison, symbol: str, left: Value, right: Value) -> str:
        remedy = self.call(
            remedies.comparison, expression, self.constant(symbol), self.raw(left), self.raw(right)
        )
        a, b = self.numeric(left), self.numeric(right)
        first, second = load(a.name), load(b.name)
        if TEXT in (a.kind, b.kind):
            if symbol not in ("==", "!=") or REAL in (a.kind, b.kind):
                return self.set(remedy)
            tests = [self.has_type(value.name, "STR") for value in (a, b) if value.kind is not TEXT]
            same = compare(first, ast.Eq if symbol == "==" else ast.NotEq, second)
            return self.either(both(*tests), same, remedy) if tests else self.set(same)
        direct: ast.expr
        if symbol in _OPPOSITES:  # tested by the opposite, for NaN, as in the evaluator
            direct = ast.UnaryOp(ast.Not(), compare(first, _OPPOSITES[symbol], second))
        else:
            difference = ast.BinOp(first, ast.Sub(), second)
            direct = ast.Compare(
                self.fixed("BELOW"), [ast.LtE(), ast.LtE()], [difference, self.fixed("ABOVE")]
            )
            if symbol == "!=":
                direct = ast.UnaryOp(ast.Not(), direct)
        test = self.numbers(a, b)
        return self.set(direct) if test is None else self.either(test, direct, remedy)

    def conditional(self, expression: Conditional) -> Value:
        decision = self.value(expression.condition)
        chosen = decision.name
        if decision.kind not in (TRUTH, REAL):
            test = either(self.has_type(chosen, "BOOL"), self.is_number(chosen))
            remedy = self.call(remedies.choice, expression, chosen)
            chosen = self.either(test, load(chosen), remedy)
        with self.block() as then:
            first = self.value(expression.then)
        with self.block() as otherwise:
            second = self.value(expression.otherwise)
        kind = first.kind if first.kind is second.kind else ANY
        result = self.set(self.fixed("NONE"))
        for statements, value in ((then, first), (otherwise, second)):
            self.body, outer = statements, self.body
            self.set(load(value.name if kind is TRUTH else self.raw(value)), result)
            self.body = outer
        self.body.append(ast.If(load(chosen), then, otherwise))
        return Value(result, kind)

    def assignment(self, expression: Assignment) -> Value:
        if not isinstance(expression.target, Name):
            return Value(self.set(self.call(remedies.refuse, expression)), ANY)
        found = either(self.local(expression.target.name), self.call(remedies.target, expression))
        entry = self.set(found)
        counting = self.step(expression)
        if counting is None:
            return self.general(expression, entry)
        symbol, number = counting
        old = self.set(ast.Attribute(load(entry), "value", ast.Load()))
        result = self.set(load(old))
        with self.block() as rare:
            self.set(load(self.general(expression, entry).name), result)
        for exact in (int(number), number):
            step = ast.BinOp(load(old), _OPERATORS[symbol](), load(self.constant(exact)))
            rare = self.counted(entry, old, result, step, is_integer=type(exact) is int, otherwise=rare)
        self.body += rare
        return Value(result, ANY)

    def step(self, expression: Assignment) -> tuple[str, float] | None:
        """Returns operator and number of an assignment that counts, as ``n += 1`` and ``n := n + 1``.

        Else None.
        """
        symbol, value = expression.operator[0], expression.value
        if expression.operator in (":=", "="):
            if not isinstance(value, Binary) or not isinstance(value.left, Name):
                return None
            if value.left.name != getattr(expression.target, "name", None) or self.is_fixed(value.left):
                return None
            symbol, value = value.operator, value.right
        number = value.value if isinstance(value, Literal) else None
        is_whole = not isinstance(number, (str, type(None))) and number == int(number) and number < EXACT
        return (
            (symbol, float(number)) if symbol in ("+", "-", "*") and is_whole and number is not None else None
        )

    def counted(  # noqa: PLR0913 - all are parts of one statement
        self,
        entry: str,
        old: str,
        result: str,
        step: ast.expr,
        *,
        is_integer: bool,
        otherwise: list[ast.stmt],
    ) -> list[ast.stmt]:
        """Returns statements that step an entry of the step's type.

        Integers are stepped only if a double holds them exactly.
        """
        with self.block() as exact:
            self.fill(entry, result)
        with self.block() as then:
            self.set(step, result)
            if is_integer:
                bounded = both(self.is_small(old), self.is_small(result))
                self.body.append(ast.If(bounded, exact, otherwise))
            else:
                self.body += exact
        return [ast.If(self.has_type(old, "INT" if is_integer else "FLOAT"), then, otherwise)]

    def general(self, expression: Assignment, entry: str) -> Value:
        """Adds an assignment of any value to an entry; returns the assigned value."""
        value = self.value(expression.value)
        right = self.raw(value)
        if expression.operator in (":=", "="):
            return self.store(expression, entry, Value(right, value.kind, value.is_constant), right)
        number = self.numeric(value)
        if number.kind is not REAL or expression.operator == "/=":
            return Value(self.set(self.call(remedies.assign, expression, entry, right)), ANY)
        old = self.set(ast.Attribute(load(entry), "value", ast.Load()))
        direct = ast.BinOp(load(old), _OPERATORS[expression.operator[0]](), load(number.name))
        result = self.either(self.is_number(old), direct, self.fixed("NONE"))
        return self.store(expression, entry, Value(result, ANY), right)

    def store(self, expression: Assignment, entry: str, new: Value, right: str) -> Value:
        """Adds a write to an entry with a value of the same type, or an integer if the value is whole."""
        remedy = self.call(remedies.assign, expression, entry, right)
        old = self.set(ast.Attribute(load(entry), "value", ast.Load()))
        is_integer = new.is_constant and type(self.parameters[new.name]) is int
        same: ast.expr
        if new.kind is REAL or is_integer:
            same = self.has_type(old, "INT" if is_integer else "FLOAT")
        elif new.kind is TEXT:
            kind = ast.Attribute(load(entry), "type", ast.Load())
            same = both(self.has_type(old, "STR"), compare(kind, ast.IsNot, self.fixed("WATCHED")))
        else:
            kinds = [call(self.fixed("TYPE"), load(name)) for name in (old, new.name)]
            numeric = either(self.has_type(new.name, "FLOAT"), self.has_type(new.name, "INT"))
            same = both(compare(kinds[0], ast.Is, kinds[1]), numeric)
        result = self.set(load(new.name))
        with self.block() as kept:
            self.fill(entry, result)
        with self.block() as rare:
            self.set(remedy, result)
        if new.kind in (REAL, ANY) and not is_integer:
            rare = self.whole(entry, old, Value(result, new.kind), rare)
        self.body.append(ast.If(same, kept, rare))
        return Value(result, new.kind if new.kind is TEXT else ANY)

    def whole(self, entry: str, old: str, new: Value, otherwise: list[ast.stmt]) -> list[ast.stmt]:
        """Returns statements that write a whole number to an entry that holds an integer."""
        result = new.name
        with self.block() as then:
            number = self.set(call(self.fixed("INT"), load(result)))
            with self.block() as exact:
                self.set(load(number), result)
                self.fill(entry, result)
            self.body.append(ast.If(compare(load(number), ast.Eq, load(result)), exact, otherwise))
        is_real = [self.has_type(result, "FLOAT")] if new.kind is ANY else []
        test = both(self.has_type(old, "INT"), *is_real, self.is_small(result))
        return [ast.If(test, then, otherwise)]

    def give_truth(self, value: Value) -> None:
        """Adds the statement that returns the value of a condition."""
        name = value.name
        if value.kind is not TRUTH:
            remedy = self.call(remedies.truth, self.program, name)
            if value.kind is TEXT:
                name = self.set(remedy)
            else:
                cast = compare(load(name), ast.NotEq, self.fixed("ZERO"))
                rest = ast.IfExp(self.castable(value), cast, remedy)
                name = self.either(self.has_type(name, "BOOL"), load(name), rest)
        self.body.append(ast.Return(load(name)))


_WRITERS: Final[Mapping[type, Callable[[Generator, Any], Value]]] = {
    Literal: Generator.literal,
    Name: Generator.name,
    Unary: Generator.unary,
    Binary: Generator.binary,
    Comparison: Generator.comparison,
    Conditional: Generator.conditional,
    Assignment: Generator.assignment,
}
