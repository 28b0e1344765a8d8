"""A Pratt parser for scripts.

The levels, tightest first: prefix ``- ~ !``; ``* /``; ``+ - ..``; ``&``; ``| ^``; comparisons, which chain;
``&&``; ``||``; ``? :``; assignments, which group to the right. ``;`` between statements may be left out.
"""

import functools
from typing import Final, NoReturn

from tree_gardener.deep import call_deep
from tree_gardener.errors import ScriptError
from tree_gardener.script.lexer import Token, tokenize
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
)
from tree_gardener.values import INT64, ConversionError, checked_double

ASSIGNMENTS: Final = frozenset((":=", "=", "+=", "-=", "*=", "/="))
COMPARISONS: Final = frozenset(("==", "!=", "<", ">", "<=", ">="))
_NESTING: Final = ASSIGNMENTS | {"(", "?"}
PREFIXES: Final = frozenset("-~!")

_ASSIGNMENT, _TERNARY, _COMPARISON = 1, 2, 5
_BINARY: Final = {
    "||": 3,
    "&&": 4,
    "|": 6,
    "^": 6,
    "&": 7,
    "+": 8,
    "-": 8,
    "..": 8,
    "*": 9,
    "/": 9,
}

MAX_CHARACTERS: Final = 20_000
"""The length of a script, as in `limits.json` of the translator; longer ones are refused."""
MAX_NESTING: Final = 250
"""The deepest nesting of parentheses, choices and assignments, and the longest row of prefixes."""
_LEVELS: Final = 3 * MAX_NESTING
"""The levels for which the stack needs room: each nesting may have all levels of operators."""
_FLAT: Final = 10


@functools.lru_cache(maxsize=4096)
def parse(text: str) -> Program:
    """Parses a script.

    Raises:
        ScriptError: the script cannot be parsed; the error has the span, the reason and a hint.
    """
    if len(text) > MAX_CHARACTERS:
        hint = "split it into several nodes"
        raise ScriptError((0, 0), f"the script is longer than {MAX_CHARACTERS} characters", hint)
    parser = _Parser(text)
    opening = sum(token.text in _NESTING for token in parser.tokens)
    return parser.program() if opening <= _FLAT else call_deep(parser.program, _LEVELS)


class _Parser:
    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens = tokenize(text)
        self.index = 0
        self.nesting = 0

    @property
    def token(self) -> Token:
        return self.tokens[self.index]

    def program(self) -> Program:
        if self.token.kind == "end":
            raise ScriptError(
                (0, len(self.text)), "the script is empty", "write an expression such as x := 1"
            )
        statements = []
        while self.token.kind != "end":
            statements.append(self.expression(_ASSIGNMENT))
            while self.token.text == ";":
                self.index += 1
        return Program(self.text, tuple(statements))

    def nested(self, level: int) -> Expression:
        """Reads an expression within another one, other than the right side of an operator."""
        self.nesting += 1
        if self.nesting > MAX_NESTING:
            self.fail("the script is nested too deeply", "split it into several statements")
        inner = self.expression(level)
        self.nesting -= 1
        return inner

    def expression(self, level: int) -> Expression:
        left = self.operand()
        while True:
            extended = self.extend(left, level)
            if extended is None:
                return left
            left = extended

    def extend(self, left: Expression, level: int) -> Expression | None:
        """Continues an expression with the next operator, unless that binds less tightly than `level`."""
        operator = self.token.text if self.token.kind == "operator" else ""
        if operator in _BINARY and _BINARY[operator] >= level:
            self.index += 1
            right = self.expression(_BINARY[operator] + 1)
            return Binary((left.span[0], right.span[1]), operator, left, right)
        if operator in COMPARISONS and level <= _COMPARISON:
            return self.comparison(left)
        if operator == "?" and level <= _TERNARY:
            return self.conditional(left)
        if operator in ASSIGNMENTS and level <= _ASSIGNMENT:
            self.index += 1
            right = self.nested(_ASSIGNMENT)
            return Assignment((left.span[0], right.span[1]), operator, left, right)
        return None

    def comparison(self, first: Expression) -> Expression:
        rest = []
        while self.token.kind == "operator" and self.token.text in COMPARISONS:
            operator = self.token.text
            self.index += 1
            rest.append((operator, self.expression(_COMPARISON + 1)))
        return Comparison((first.span[0], rest[-1][1].span[1]), first, tuple(rest))

    def conditional(self, condition: Expression) -> Expression:
        self.index += 1
        then = self.nested(_ASSIGNMENT)
        if self.token.text != ":" or self.token.kind != "operator":
            self.fail("':' is missing after '?'", "a choice is written: condition ? value : other value")
        self.index += 1
        otherwise = self.nested(_TERNARY)
        return Conditional((condition.span[0], otherwise.span[1]), condition, then, otherwise)

    def operand(self) -> Expression:
        token = self.token
        if token.kind == "operator" and token.text in PREFIXES:
            return self.prefixed()
        if token.kind == "operator" and token.text == "(":
            return self.group()
        if token.kind in ("operator", "end"):
            self.fail(
                f"a value is expected {'before ' + repr(token.text) if token.text else 'at the end'}",
                "assign with :=, compare with =="
                if token.text in ASSIGNMENTS | COMPARISONS
                else "finish the expression, or leave out the last operator",
            )
        self.index += 1
        return _atom(token)

    def prefixed(self) -> Expression:
        """Reads prefixes in a loop, since recursion would overflow with a long row of them."""
        prefixes = []
        while self.token.kind == "operator" and self.token.text in PREFIXES:
            prefixes.append(self.token)
            self.index += 1
        if len(prefixes) > MAX_NESTING:
            self.fail("the script is nested too deeply", "leave out some of the prefixes")
        operand = self.operand()
        for token in reversed(prefixes):
            operand = Unary((token.start, operand.span[1]), token.text, operand)
        return operand

    def group(self) -> Expression:
        self.index += 1
        inner = self.nested(_ASSIGNMENT)
        if self.token.text != ")" or self.token.kind != "operator":
            self.fail("')' is missing", "close every '('")
        self.index += 1
        return inner

    def fail(self, message: str, hint: str = "") -> NoReturn:
        raise ScriptError((self.token.start, self.token.end), message, hint)


def _atom(token: Token) -> Expression:
    span = (token.start, token.end)
    if token.kind == "integer":
        is_hex = token.text[:2] in ("0x", "0X")
        number = int(token.text, 16 if is_hex else 10)
        # An integer that does not fit reads as 0 in BehaviorTree.CPP.
        return Literal(span, number if number <= INT64[1] else 0)
    if token.kind == "real":
        try:
            return Literal(span, checked_double(token.text))
        except ConversionError:
            hint = "numbers go from 4.9e-324 to 1.8e308"
            raise ScriptError(span, f"'{token.text}' is outside of what a number can be", hint) from None
    if token.kind == "string":
        return Literal(span, token.text[1:-1])
    if token.text in ("true", "false"):
        return Literal(span, 1.0 if token.text == "true" else 0.0)
    return Name(span, token.text)
