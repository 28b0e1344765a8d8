"""The calls of the engine that a method does not take, and ends of `update` without a status."""

from __future__ import annotations

import ast

import pytest

from tests.translator.check.sources.cases import BASE, FIRST, HEAD, UPDATE, found_in
from translator.check.sources.methods import falls


@pytest.mark.parametrize(
    ("method", "severity"),
    [
        ("__init__(self, name, speed)", "error"),
        ("__init__(self, name, *, speed)", "error"),
        ("__init__(self)", "error"),
        ("__init__(self, ports, name)", "error"),
        ("setup(self, timeout)", "error"),
        ("setup(self, node, timeout)", "error"),
        ("setup(self, node, /)", "error"),
        ("setup()", "error"),
        ("initialise(self, x)", "warning"),
        ("terminate(self)", "warning"),
        ("shutdown(self, x)", "warning"),
    ],
)
def test_a_method_that_the_engine_cannot_call(method: str, severity: str) -> None:
    source = f"{BASE}    def {method}:\n        pass\n{UPDATE}"
    assert found_in(source) == [("BT0645", severity, FIRST)]


@pytest.mark.parametrize(
    "method",
    [
        "__init__(self, name)",
        "__init__(self, name, ports=None)",
        "__init__(self, name, ports)",
        "__init__(self, name, speed=1, *, ports)",
        "__init__(self, *args, **kwargs)",
        "setup(self)",
        "setup(self, node)",
        "setup(self, *, node=None, other=1)",
        "setup(self, **kwargs)",
        "setup(self, timeout=1, **kwargs)",
        "terminate(self, new_status)",
        "terminate(self, *_)",
        "shutdown(self)",
    ],
)
def test_a_method_that_the_engine_can_call(method: str) -> None:
    assert found_in(f"{BASE}    def {method}:\n        pass\n{UPDATE}") == []


@pytest.mark.parametrize(
    "source",
    [
        f"{HEAD}from py_trees.decorators import Decorator\nclass A(Decorator):\n"
        f"    def __init__(self, name, child):\n        super().__init__(name, child)\n{UPDATE}",
        f"from lib import Base\n{HEAD}class A(Base):\n    def __init__(self, name, speed): ...\n{UPDATE}",
        f"{HEAD}from tree_gardener import LoopNode\nclass A(LoopNode):\n"
        "    def __init__(self, name, x): ...\n",
    ],
)
def test_classes_that_the_engine_makes_otherwise(source: str) -> None:
    assert [each for each in found_in(source, {"lib.py": b""}) if each[0] == "BT0645"] == []


def test_the_method_of_a_base_in_the_file_counts() -> None:
    base = f"{HEAD}class B(py_trees.behaviour.Behaviour):\n    def __init__(self, name, x): ...\n"
    assert found_in(f"{base}class A(B):\n{UPDATE}") == [("BT0645", "error", 4)]
    assert found_in(f"{base}class A(B):\n    def __init__(self, name): ...\n{UPDATE}") == []


@pytest.mark.parametrize(
    ("body", "line"),
    [
        ("pass", 0),
        ("if self.x:\n            return Status.SUCCESS", 0),
        ("for _ in ():\n            return Status.SUCCESS", 0),
        ("while self.x:\n            return Status.SUCCESS", 0),
        ("try:\n            return Status.SUCCESS\n        except OSError:\n            pass", 0),
        ("match self.x:\n            case 1:\n                return Status.SUCCESS", 0),
        ("return", 1),
        ("return None", 1),
        ("yield Status.SUCCESS", 0),
    ],
)
def test_an_update_that_can_end_without_a_status(body: str, line: int) -> None:
    found = found_in(f"{BASE}    def update(self):\n        {body}\n")
    assert found == [("BT0646", "warning", FIRST + line)]


@pytest.mark.parametrize(
    ("body", "can"),
    [
        ("raise ValueError", False),
        ("while True:\n    pass", False),
        ("while True:\n    break", True),
        ("while True:\n    for x in ():\n        break", False),
        ("while True:\n    for x in ():\n        pass\n    else:\n        break", True),
        ("if x:\n    return 1\nelse:\n    return 2", False),
        ("try:\n    return 1\nfinally:\n    print()", False),
        ("try:\n    print()\nfinally:\n    return 1", False),
        ("try:\n    print()\nexcept OSError:\n    return 1\nelse:\n    return 2", False),
        ("with x:\n    return 1", False),
        ("match x:\n    case 1:\n        return 1\n    case _:\n        return 2", False),
        ("assert False", False),
        ("sys.exit(1)", False),
        ("print()", True),
    ],
)
def test_whether_control_can_reach_the_end(body: str, can: bool) -> None:
    module = ast.parse("def f():\n" + "".join(f"    {line}\n" for line in body.splitlines()))
    (function,) = module.body
    assert isinstance(function, ast.FunctionDef)
    assert falls(function.body) is can
