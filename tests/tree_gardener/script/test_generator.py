"""The parts of a script's code: own kinds of nodes, own names, and nothing of the script's text."""

from __future__ import annotations

import ast
import types

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tree_gardener.blackboard import Blackboard
from tree_gardener.errors import ScriptError
from tree_gardener.script import Environment, bind_run, compile_script, generated_source, parse
from tree_gardener.script.generator import MAX_DEPTH, MAX_PARTS, Generator, TooLargeError, check_size
from tree_gardener.script.writer import ATTRIBUTES, BOUND, FIXED

SCRIPTS = st.sampled_from(
    [
        "a > 5 && b == 'x'",
        "a := a + 1; b .. a",
        "!a ? ~b : -c",
        "a += 2; b *= a; c := 'x' .. a",
        "1 < a < 3 || a != b; 3 := 4",
        "a & 1 | b ^ 2; a / b - 1",
    ]
)
HOSTILE = [
    "__import__('os').system('true')",
    "'); __import__('os'); ('",
    "'\n\nimport os\n'",
    "'\x00'",
    "'\ud800'",
    '\'"""\'',
    "'{' + \"}\" == '\\\\'",
    "ENVIRONMENT + TYPE",
    "c1 := t0; t0 := c1",
    "__builtins__ := 1",
    "__class__ == None",
    "é := 1; é + 1",
    "lambda := eval",
]
NODES = {
    *(ast.Module, ast.FunctionDef, ast.arguments, ast.arg, ast.Return, ast.Assign, ast.AugAssign, ast.If),
    *(ast.Expr, ast.IfExp, ast.Name, ast.Attribute, ast.Call, ast.Compare, ast.BoolOp, ast.BinOp),
    *(ast.UnaryOp, ast.Load, ast.Store, ast.And, ast.Or, ast.Not, ast.USub, ast.Add, ast.Sub, ast.Mult),
    *(ast.Div, ast.Eq, ast.NotEq, ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Is, ast.IsNot),
}


def assert_harmless(module: ast.Module) -> None:
    for node in ast.walk(module):
        assert type(node) in NODES
        if isinstance(node, ast.Attribute):
            assert node.attr in ATTRIBUTES
        name = node.id if isinstance(node, ast.Name) else node.arg if isinstance(node, ast.arg) else "t0"
        assert name in FIXED or name in BOUND or (name[0] in "ct" and name[1:].isdecimal())


def assert_safe(text: str, enums: dict[str, int]) -> None:
    try:
        program = compile_script(text).program
    except ScriptError:
        return
    for is_condition in (False, True):
        generator = Generator(program, enums)
        module = generator.function(is_condition=is_condition)
        assert_harmless(module)
        assert not generator.body or all(
            isinstance(value, str) is False or name[0] == "c" for name, value in generator.parameters.items()
        )
    call = bind_run(text, Environment(Blackboard(), enums))
    assert isinstance(call, types.FunctionType)
    assert call.__globals__ == {"__builtins__": {}}
    assert not call.__code__.co_names or set(call.__code__.co_names) <= ATTRIBUTES
    constants = [part for part in call.__code__.co_consts if part is not None]
    assert constants == []


@pytest.mark.parametrize("text", HOSTILE)
def test_hostile_scripts_get_into_no_source(text: str) -> None:
    assert_safe(text, {"__import__": 1, "c0": 2, "TYPE": 3, "\x00": 4})


@given(SCRIPTS, st.text(alphabet="ab_'\"\n\x00\ud800(){}\\;.", max_size=12))
@settings(max_examples=150, deadline=None)
def test_random_literals_get_into_no_source(text: str, literal: str) -> None:
    assert_safe(f"x := '{literal}'; {text}", {"a": 1})


def test_the_source_can_be_looked_at() -> None:
    source = generated_source("secret > 41", is_condition=True)
    assert source.startswith("def script(")
    assert "secret" not in source
    assert "41" not in source


def test_the_bounds_need_no_recursion() -> None:
    check_size(parse("a" + " + a" * (MAX_DEPTH - 2)))
    for text in ("a" + " + a" * 4_000, "a; " * (MAX_PARTS + 1)):
        with pytest.raises(TooLargeError):
            check_size(parse(text))
