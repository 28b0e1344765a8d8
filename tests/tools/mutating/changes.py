"""The changes of a line of Python: another operator, constant, condition or result, and a call left out."""

from __future__ import annotations

import ast
import io
import itertools
import tokenize
from typing import Final, NamedTuple

OTHER: Final = {
    "==": "!=",
    "!=": "==",
    "<": ">=",
    ">=": "<",
    ">": "<=",
    "<=": ">",
    "is": "is not",
    "in": "not in",
    "and": "or",
    "or": "and",
    "+": "-",
    "-": "+",
    "*": "/",
    "//": "*",
}
"""What each operator becomes; `is not` and `not in` have two tokens and are left alone."""
TYPES_ONLY: Final = "TYPE_CHECKING"


class Mutant(NamedTuple):
    """A source with one change; `line` counts from 1, `path` is relative to the repository."""

    path: str
    line: int
    before: str
    after: str
    source: str


class Change(NamedTuple):
    """A text of a line and what it becomes; `line` counts from 1, `column` from 0."""

    line: int
    column: int
    old: str
    new: str


def changed(path: str, source: str, change: Change) -> Mutant | None:
    """Returns a source with a change; None where it is no Python any more."""
    lines = source.splitlines(keepends=True)
    text = lines[change.line - 1]
    after = text[: change.column] + change.new + text[change.column + len(change.old) :]
    whole = "".join([*lines[: change.line - 1], after, *lines[change.line :]])
    try:
        ast.parse(whole)
    except SyntaxError:
        return None
    return Mutant(path, change.line, text.strip(), after.strip(), whole)


def changes_of(source: str) -> list[Change]:
    """Returns every change of a source, in its order."""
    finder = _Finder(source)
    finder.visit(ast.parse(source))
    found = set(finder.found)
    for token in finder.tokens:
        if token.string in OTHER and token.start in finder.operators:
            found.add(Change(*token.start, token.string, OTHER[token.string]))
    return sorted(found)


class _Finder(ast.NodeVisitor):
    """Collects changes, and the places of operators that are not those of types."""

    def __init__(self, source: str) -> None:
        self.found: list[Change] = []
        self.operators: set[tuple[int, int]] = set()
        self._lines = source.splitlines()
        self.tokens = list(tokenize.generate_tokens(io.StringIO(source).readline))

    def visit_If(self, node: ast.If) -> None:
        if not (isinstance(node.test, ast.Name) and node.test.id == TYPES_ONLY):
            self._negate(node.test)
            self.generic_visit(node)

    def visit_While(self, node: ast.While) -> None:
        self._negate(node.test)
        self.generic_visit(node)

    def visit_IfExp(self, node: ast.IfExp) -> None:
        self._negate(node.test)
        self.generic_visit(node)

    def visit_Return(self, node: ast.Return) -> None:
        value = node.value
        if value is not None and not (isinstance(value, ast.Constant) and value.value in (None, True, False)):
            self._replace(value, "None")
        self.generic_visit(node)

    def visit_Expr(self, node: ast.Expr) -> None:
        if isinstance(node.value, ast.Constant):  # a docstring
            return
        if isinstance(node.value, ast.Call):
            self._replace(node, "pass")
        self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> None:
        match node.value:
            case bool():
                self._replace(node, str(not node.value))
            case int():
                self._replace(node, str(node.value + 1))
            case str() if node.value and node.end_lineno == node.lineno:
                text = self._text(node)
                if text[:1] in "\"'" and not text.startswith(('"""', "'''")) and text[-1:] == text[:1]:
                    self._replace(node, f"{text[:-1]} changed{text[-1]}")
            case _:
                pass

    def visit_Compare(self, node: ast.Compare) -> None:
        self._between([node.left, *node.comparators])
        self.generic_visit(node)

    def visit_BoolOp(self, node: ast.BoolOp) -> None:
        self._between(node.values)
        self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> None:
        if not any(_is_text(side) for side in (node.left, node.right)):
            self._between([node.left, node.right])
        self.generic_visit(node)

    def visit_JoinedStr(self, node: ast.JoinedStr) -> None:
        """Leaves formatted texts alone: in Python 3.11 their parts have no places."""

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value is not None:
            self.visit(node.value)

    def visit_arg(self, node: ast.arg) -> None:
        """Leaves types alone."""

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        self._visit_function(node)

    def visit_AsyncFunctionDef(self, node: ast.AsyncFunctionDef) -> None:
        self._visit_function(node)

    def _visit_function(self, node: ast.FunctionDef | ast.AsyncFunctionDef) -> None:
        """Leaves decorators and types alone."""
        self.visit(node.args)
        for statement in node.body:
            self.visit(statement)

    def visit_Assign(self, node: ast.Assign) -> None:
        if not any(isinstance(target, ast.Name) and target.id == "__all__" for target in node.targets):
            self.visit(node.value)

    def _between(self, operands: list[ast.expr]) -> None:
        for left, right in itertools.pairwise(operands):
            begin, end = (left.end_lineno, left.end_col_offset), (right.lineno, right.col_offset)
            self.operators |= {
                (row, column)
                for row, column in (token.start for token in self.tokens)
                if begin <= (row, self._bytes(row, column)) < end
            }

    def _negate(self, test: ast.expr) -> None:
        if test.lineno == test.end_lineno:
            text = self._text(test)
            self.found.append(Change(*self._place(test), text, f"(not ({text}))"))

    def _replace(self, node: ast.expr | ast.Expr, new: str) -> None:
        if node.lineno == node.end_lineno:
            self.found.append(Change(*self._place(node), self._text(node), new))

    def _text(self, node: ast.expr | ast.Expr) -> str:
        line = self._lines[node.lineno - 1].encode()
        return line[node.col_offset : node.end_col_offset].decode()

    def _place(self, node: ast.expr | ast.Expr) -> tuple[int, int]:
        return node.lineno, len(self._lines[node.lineno - 1].encode()[: node.col_offset].decode())

    def _bytes(self, row: int, column: int) -> int:
        return len(self._lines[row - 1][:column].encode()) if row <= len(self._lines) else column


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.JoinedStr) or (isinstance(node, ast.Constant) and isinstance(node.value, str))
