"""Modules are taken apart into units."""

from __future__ import annotations

import ast
import struct

import pytest

from tests.tools.measuring.executed import path_hash
from tests.tools.selection.units import Kind, is_keeper, keepers, module_of

SOURCE = """
import a.b
from c import d as e
if TYPE_CHECKING:
    import types_only
if X:
    import sometimes
X: Final = 1
Y = call_of_ours()
class A:
    @property
    def size(self):
        def inner():
            return 1
        return inner()
    class B:
        def deep(self):
            import lazy
print(1)
"""


def test_units_and_their_kinds():
    found = {(str(unit.kind), unit.qualified) for unit in module_of(SOURCE).units}
    assert found == {
        *(("name", name) for name in ("a", "e", "X", "A", "A.B")),
        *(("effect", name) for name in ("Y", "")),
        *((kind, name) for kind in ("method", "body") for name in ("A.size", "A.B.deep")),
    }


def test_a_line_belongs_to_the_outermost_function():
    module = module_of(SOURCE)
    assert module.function_at(11) == "A.size"  # the decorator, where Python says that it begins
    assert module.function_at(13) == "A.size"
    assert module.function_at(17) == "A.B.deep"
    assert module.function_at(8) is None


def test_imports_outside_of_functions_load_modules_with_the_packages_above():
    found = module_of(SOURCE).imports
    assert {"a/b.py", "a/__init__.py", "c.py", "c/d.py", "sometimes.py"} <= found
    assert not found & {"types_only.py", "lazy.py"}


def test_what_is_no_python_is_one_unit():
    (unit,) = module_of("def (:").units
    assert unit.kind is Kind.EFFECT


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("@cache\ndef f(): ...", True),
        ("@lru_cache(maxsize=1)\ndef f(): ...", True),
        ("def f():\n    global x\n    x = 1", True),
        ("def f(self):\n    if self._a is None:\n        self._a = 1", True),
        ("def f(key):\n    if key not in _CACHE:\n        _CACHE[key] = 1", True),
        ("def f(self):\n    self._a = 1", False),
        ("def f(a):\n    if a:\n        a = 1", False),
    ],
)
def test_functions_whose_results_outlive_them(source, expected):
    assert is_keeper(ast.parse(source).body[0]) is expected


def test_keepers_are_written_with_the_lines_at_which_python_sees_them(tmp_path):
    (tmp_path / "a.py").write_text("\n@cache\ndef f(): ...\n")
    (tmp_path / "broken.py").write_text("def (")
    assert keepers(tmp_path, ["a.py", "broken.py", "b.md"]) == struct.pack("<Q", path_hash("a.py") << 32 | 2)
