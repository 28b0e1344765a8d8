"""Names that nothing defines: an error where the module surely meets them, a warning elsewhere."""

from __future__ import annotations

import ast

import pytest

from tests.translator.check.sources.cases import BASE, FIRST, HEAD, UPDATE, found_in
from translator.check.sources.names import unknown_names
from translator.check.sources.scopes import Scopes


@pytest.mark.parametrize(
    ("source", "code", "severity", "line"),
    [
        (f"{BASE}    x = foo\n{UPDATE}", "BT0640", "error", FIRST),
        (f"{BASE}    def f(self, x: foo): ...\n{UPDATE}", "BT0640", "error", FIRST),
        (f"{BASE}    def f(self, x=foo): ...\n{UPDATE}", "BT0640", "error", FIRST),
        (f"foo.x = 1\n{BASE}{UPDATE}", "BT0640", "error", 1),
        (f"{BASE}    @foo\n    def f(self): ...\n{UPDATE}", "BT0640", "error", FIRST),
        (
            f"{BASE}    def __init__(self, name):\n        super().__init__(name)\n        foo()\n{UPDATE}",
            "BT0640",
            "error",
            FIRST + 2,
        ),
        (f"{BASE}    def setup(self, node):\n        self.x = foo\n{UPDATE}", "BT0640", "error", FIRST + 1),
        (f"{BASE}    def update(self):\n        return foo\n", "BT0640", "warning", FIRST + 1),
        (f"{BASE}    def update(self):\n        return Statuss.SUCCESS\n", "BT0640", "warning", FIRST + 1),
        (
            f"{BASE}    def setup(self, node):\n        if node:\n            return\n"
            f"        foo()\n{UPDATE}",
            "BT0640",
            "warning",
            FIRST + 3,
        ),
        (f"import sys\nif sys.argv:\n    foo()\n{BASE}{UPDATE}", "BT0640", "warning", 3),
        (f"X = [foo for _ in range(3)]\n{BASE}{UPDATE}", "BT0640", "warning", 1),
        (f"class A(Later):\n    pass\n{HEAD}class Later: ...\n", "BT0641", "error", 1),
        (f"X = Y\nY = 1\n{BASE}{UPDATE}", "BT0641", "error", 1),
        (
            f"{BASE}    def setup(self, node):\n        print(one)\n        one = 1\n{UPDATE}",
            "BT0641",
            "error",
            FIRST + 1,
        ),
        (f"{BASE}    x = 1\n    y = [x for _ in range(1)]\n{UPDATE}", "BT0640", "warning", FIRST + 1),
        (
            "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import numpy as np\n"
            f"{BASE}    def f(self, x: np.ndarray): ...\n{UPDATE}",
            "BT0640",
            "error",
            FIRST + 3,
        ),
    ],
)
def test_a_name_that_does_not_exist(source: str, code: str, severity: str, line: int) -> None:
    assert (code, severity, line) in found_in(source)


@pytest.mark.parametrize(
    "source",
    [
        f"{BASE}    x = __file__ + __name__\n{UPDATE}",
        f"try:\n    fast\nexcept NameError:\n    fast = None\n{BASE}{UPDATE}",
        f"from contextlib import suppress\nwith suppress(NameError):\n    fast\n{BASE}{UPDATE}",
        f"if __name__ == '__main__':\n    main()\n{BASE}{UPDATE}",
        f"from __future__ import annotations\n{BASE}    def f(self, x: foo) -> foo: ...\n{UPDATE}",
        f"{BASE}    def f(self):\n        x: foo = 1\n        return x\n{UPDATE}",
        f"from math import *\n{BASE}    x = sin(1)\n{UPDATE}",
        f"globals().update(foo=1)\nX = foo\n{BASE}{UPDATE}",
        f"{BASE}    def f(self):\n        return LATER\n{UPDATE}LATER = 1\n",
        f"{BASE}    def f(self):\n        global made\n        made = 1\n"
        f"    def g(self):\n        return made\n{UPDATE}",
        "def f(x):\n    match x:\n        case [a, *b] | {'k': a, **b}:\n            return a, b\n"
        f"{BASE}{UPDATE}",
        "def f():\n    x = 1\n    def g():\n        nonlocal x\n        x += 1\n    return g\n"
        f"{BASE}{UPDATE}",
        f"if (n := 3) > 2:\n    X = [m for k in range(n) if (m := k)]\n    Y = m\n{BASE}{UPDATE}",
        f"{BASE}    def f(self):\n        return __class__\n{UPDATE}",
        f"F = lambda x, *a, y=1, **k: (x, a, y, k)\n{BASE}{UPDATE}",
        "try:\n    pass\nexcept OSError as error:\n    print(error)\nfor i in ():\n    print(i)\n"
        f"{BASE}{UPDATE}",
    ],
)
def test_a_name_that_exists_or_may_exist(source: str) -> None:
    assert found_in(source) == []


def test_a_name_is_reported_once_as_an_error_and_once_as_a_warning() -> None:
    scopes = Scopes(ast.parse("X = foo\nY = foo\ndef f():\n    foo\ndef g():\n    foo\n"))
    assert [(each.line, each.moment.name) for each in unknown_names(scopes)] == [(1, "LOAD"), (4, "LATER")]
