"""Each kind of syntax has its line, and Python's own form."""

from __future__ import annotations

import ast

import pytest

from tree_gardener.generated import syntax
from tree_gardener.generated.syntax import call, do, give, leave, let, load, number, when

LINES = [
    (let("a", call(load("f"), load("b"), line=7)), "a = f(b)", 7),
    (do(call(syntax.attribute(load("a"), "b"), line=3)), "a.b()", 3),
    (syntax.put(load("a"), "b", number(1)), "a.b = 1", 1),
    (syntax.put_first(load("a"), load("b")), "a[0] = b", 1),
    (syntax.count(load("a"), "b"), "a.b += 1", 1),
    (give(syntax.item(load("a"), number(2))), "return a[2]", 1),
    (give(), "return", 1),
    (let("a", syntax.difference(load("b"), load("c"))), "a = b - c", 1),
    (let("a", syntax.pair(load("b"), load("c"))), "a = (b, c)", 1),
    (when(syntax.same(load("a"), load("b")), [leave()]), "if a is b:\n    break", 1),
    (
        when(syntax.other(load("a"), load("b")), [leave()], [give()]),
        "if a is not b:\n    break\nelse:\n    return",
        1,
    ),
    (when(syntax.greater(load("a"), load("b")), [leave()]), "if a > b:\n    break", 1),
    (when(syntax.negated(call(load("a"), line=4)), [leave()]), "if not a():\n    break", 1),
    (syntax.once([leave()]), "while True:\n    break", 1),
    (
        syntax.caught([leave()], load("a"), [let("b", load("error"))]),
        "try:\n    break\nexcept a as error:\n    b = error",
        1,
    ),
]


@pytest.mark.parametrize(("statement", "text", "line"), LINES, ids=[text for _, text, _ in LINES])
def test_a_statement_has_its_form_and_line(statement: ast.stmt, text: str, line: int) -> None:
    assert ast.unparse(statement) == text
    assert statement.lineno == statement.end_lineno == line
    for node in ast.walk(statement):
        assert type(node) in syntax.NODES
        if isinstance(node, (ast.expr, ast.stmt, ast.ExceptHandler)):
            assert node.lineno >= 1
            assert node.col_offset == node.end_col_offset == 0


def test_a_module_compiles_and_an_exception_has_the_line_of_its_call() -> None:
    body = [do(call(load("a"), line=5)), do(call(load("b"), line=9)), give(load("b"))]
    module = syntax.module("tick", ["a", "b"], body)
    assert {type(node) for node in ast.walk(module)} <= syntax.NODES
    names: dict[str, object] = {}
    exec(compile(module, "<tick>", "exec"), names)  # noqa: S102 - the module that was made above
    tick = names["tick"]
    assert callable(tick)
    with pytest.raises(ZeroDivisionError) as caught:
        tick(list, lambda: 1 / 0)
    assert caught.traceback[1].lineno + 1 == 9
