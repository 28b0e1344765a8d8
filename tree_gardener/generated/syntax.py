"""The kinds of Python syntax in generated ticks, each with its line.

Statements and expressions are made with a line, 1 unless given, since `ast.fix_missing_locations` takes
longer than all the rest. The lines of calls tell later what raised an exception.
"""

import ast
from typing import Final, TypeVar

Statements = list[ast.stmt]
T = TypeVar("T", bound=ast.expr | ast.stmt | ast.ExceptHandler | ast.arg)

NODES: Final = frozenset(
    (
        *(ast.Module, ast.FunctionDef, ast.arguments, ast.arg, ast.Try, ast.ExceptHandler, ast.Return),
        *(ast.Assign, ast.AugAssign, ast.If, ast.While, ast.Break, ast.Expr, ast.Name, ast.Attribute),
        *(ast.Subscript, ast.Call, ast.Compare, ast.UnaryOp, ast.BinOp, ast.Tuple, ast.Constant, ast.Load),
        *(ast.Store, ast.Not, ast.Add, ast.Sub, ast.Gt, ast.Is, ast.IsNot),
    )
)
"""Every kind of node that is compiled."""

_LOAD, _STORE, _IS, _IS_NOT = ast.Load(), ast.Store(), ast.Is(), ast.IsNot()


def at(node: T, line: int = 1) -> T:
    """Puts a new node on a line."""
    node.lineno = node.end_lineno = line
    node.col_offset = node.end_col_offset = 0
    return node


def load(name: str) -> ast.Name:
    """Returns a read of a variable or parameter."""
    return at(ast.Name(name, _LOAD))


def number(value: int) -> ast.Constant:
    """Returns a number of the shape: a position, a line, 0 or 1."""
    return at(ast.Constant(value))


def attribute(owner: ast.expr, name: str) -> ast.Attribute:
    """Returns a read of an attribute."""
    return at(ast.Attribute(owner, name, _LOAD))


def item(owner: ast.expr, index: ast.expr) -> ast.Subscript:
    """Returns a read of an item."""
    return at(ast.Subscript(owner, index, _LOAD))


def call(function: ast.expr, *arguments: ast.expr, line: int = 1) -> ast.Call:
    """Returns a call."""
    return at(ast.Call(function, list(arguments), []), line)


def same(left: ast.expr, right: ast.expr) -> ast.Compare:
    """Returns a test for one object."""
    return at(ast.Compare(left, [_IS], [right]))


def other(left: ast.expr, right: ast.expr) -> ast.Compare:
    """Returns a test for two objects."""
    return at(ast.Compare(left, [_IS_NOT], [right]))


def greater(left: ast.expr, right: ast.expr) -> ast.Compare:
    """Returns a test of two numbers."""
    return at(ast.Compare(left, [ast.Gt()], [right]))


def difference(left: ast.expr, right: ast.expr) -> ast.BinOp:
    """Returns the difference of two numbers."""
    return at(ast.BinOp(left, ast.Sub(), right))


def pair(first: ast.expr, second: ast.expr) -> ast.Tuple:
    """Returns a tuple of two."""
    return at(ast.Tuple([first, second], _LOAD))


def negated(test: ast.expr) -> ast.UnaryOp:
    """Returns the opposite of a test."""
    return at(ast.UnaryOp(ast.Not(), test), test.lineno)


def when(test: ast.expr, then: Statements, otherwise: Statements | None = None) -> ast.stmt:
    """Returns a choice."""
    return at(ast.If(test, then, otherwise or []))


def let(name: str, value: ast.expr) -> ast.stmt:
    """Returns the assignment of a variable."""
    return at(ast.Assign([at(ast.Name(name, _STORE))], value), value.lineno)


def put(owner: ast.expr, name: str, value: ast.expr) -> ast.stmt:
    """Returns the assignment of an attribute."""
    return at(ast.Assign([at(ast.Attribute(owner, name, _STORE))], value))


def put_first(owner: ast.expr, value: ast.expr) -> ast.stmt:
    """Returns the assignment of a sequence's first item."""
    return at(ast.Assign([at(ast.Subscript(owner, number(0), _STORE))], value))


def count(owner: ast.expr, name: str) -> ast.stmt:
    """Returns the increase of an attribute by 1."""
    return at(ast.AugAssign(at(ast.Attribute(owner, name, _STORE)), ast.Add(), number(1)))


def do(value: ast.expr) -> ast.stmt:
    """Returns a call as a statement."""
    return at(ast.Expr(value), value.lineno)


def give(value: ast.expr | None = None) -> ast.stmt:
    """Returns the end of the function with a value."""
    return at(ast.Return(value))


def leave() -> ast.stmt:
    """Returns the end of the innermost loop."""
    return at(ast.Break())


def once(body: Statements) -> ast.stmt:
    """Returns a loop, which its body leaves in its first turn."""
    return at(ast.While(at(ast.Constant(value=True)), body, []))


def module(name: str, parameters: list[str], body: Statements) -> ast.Module:
    """Returns a module with one function."""
    arguments = ast.arguments(
        *([], [at(ast.arg(each)) for each in parameters]), kwonlyargs=[], kw_defaults=[], defaults=[]
    )
    function = ast.FunctionDef(name, arguments, body, decorator_list=[])
    return ast.Module([at(function)], type_ignores=[])


def caught(body: Statements, raised: ast.expr, handler: Statements) -> ast.stmt:
    """Returns a body whose exceptions of some classes are handled as ``error``."""
    return at(ast.Try(body, [at(ast.ExceptHandler(raised, "error", handler))], [], []))
