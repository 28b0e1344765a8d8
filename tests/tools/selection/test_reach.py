"""Changes that touch a test that ran some functions: each rule has a change that it finds, or leaves out."""

from __future__ import annotations

import pytest

from tests.tools.selection.reach import Reach, Reached
from tests.tools.selection.units import differences, module_of

SOURCES = {
    "base.py": '''
"""The base."""
class Base:
    """A base."""
    def step(self):
        return self.limit()
    def limit(self):
        return 1
''',
    "product.py": '''
"""The product."""
from base import Base
from other import helper, spare
LIMIT = 2
SPARE = 3
TABLE = {"a": LIMIT}
class Robot(Base):
    """A robot."""
    wheels = 4
    def drive(self, far=1):
        """Drives."""
        return self.step() + LIMIT
    def park(self):
        return SPARE
def run(robot):
    return Robot().drive() + TABLE["a"] + getattr(robot, f"on_{robot}")()
def unused():
    return helper()
def cached():
    return 5
class Registered(Unknown):
    def ready(self):
        return 1
@app.command()
def command():
    return 2
''',
    "other.py": "def helper():\n    return 1\ndef spare():\n    return 2\n",
    "idle.py": "VALUE = LIMIT\nregister(VALUE)\n",
    "test_it.py": "from product import run, cached\ndef test_it():\n    assert run(1) + cached()\n",
}
RAN = {
    *(("product.py", name) for name in ("Robot.drive", "run")),
    *(("base.py", name) for name in ("Base.step", "Base.limit")),
    ("test_it.py", "test_it"),
}
KEPT = {("product.py", "cached"), ("other.py", "helper")}
LOADED = frozenset({"product.py", "base.py", "other.py", "idle.py"})


def reached(sources: dict[str, str]) -> Reached:
    reach = Reach({path: module_of(text) for path, text in sources.items()})
    return reach.of(RAN, KEPT, LOADED, "test_it.py")


def changed(path: str, old: str, new: str) -> dict[str, str]:
    assert old in SOURCES[path]
    return SOURCES | {path: SOURCES[path].replace(old, new, 1)}


CHANGES = [
    # Functions.
    ("a function that ran", "product.py", "Robot().drive()", "Robot().drive(2)", True),
    ("a function that did not run", "product.py", "return helper()", "return spare()", False),
    ("a method that ran", "product.py", "self.step() + LIMIT", "self.step()", True),
    ("a method that did not run", "product.py", "return SPARE", "return 7", False),
    ("an inherited method that ran", "base.py", "return 1", "return 2", True),
    ("the signature of a method that ran", "product.py", "far=1", "far=2", True),
    ("a function that ran is gone", "product.py", "def run(", "def walk(", True),
    ("what is kept of before and named", "product.py", "return 5", "return 6", True),
    ("what is kept of before and not named", "other.py", "return 1", "return 3", False),
    # Methods and functions that are new.
    ("a new function", "product.py", "def unused", "def fresh():\n    pass\ndef unused", False),
    (
        "a function with the name of a built-in one",
        "product.py",
        "class",
        "def getattr(): ...\nclass",
        True,
    ),
    (
        "a function with this name elsewhere",
        "base.py",
        "class",
        "def getattr(): ...\nclass",
        False,
    ),
    (
        "a function that an attribute may mean",
        "other.py",
        "def helper",
        "def drive(): ...\ndef helper",
        True,
    ),
    ("a constant with a used name elsewhere", "base.py", "class", "LIMIT = 9\nclass", False),
    ("a new method", "product.py", "    def park", "    def fresh(self):\n        pass\n    def park", False),
    (
        "a method that replaces one of the base",
        "product.py",
        "    def park",
        "    def limit(self):\n        return 3\n    def park",
        True,
    ),
    (
        "a special method",
        "product.py",
        "    def park",
        "    def __getattr__(self, n):\n        return 3\n    def park",
        True,
    ),
    (
        "a method of a class whose base is not known",
        "product.py",
        "    def ready",
        "    def fresh(self):\n        pass\n    def ready",
        True,
    ),
    (
        "a method that is asked for by the beginning of its name",
        "product.py",
        "    def park",
        "    def on_go(self):\n        pass\n    def park",
        True,
    ),
    # Constants, classes, imports, effects.
    ("a constant that is named", "product.py", "LIMIT = 2", "LIMIT = 3", True),
    ("a constant that a named one uses", "product.py", '{"a": LIMIT}', '{"a": 9}', True),
    ("a constant that only idle functions name", "product.py", "SPARE = 3", "SPARE = 4", False),
    ("a new constant", "product.py", "SPARE = 3", "SPARE = 3\nFRESH = 4", False),
    ("a field of a class", "product.py", "wheels = 4", "wheels = 5", True),
    ("the bases of a class", "product.py", "Robot(Base)", "Robot(Base, Mixin)", True),
    ("an import that is named", "product.py", "from base import", "from elsewhere import", True),
    ("an import that only idle functions name", "product.py", "helper, spare", "helper, spare, other", False),
    ("a new import under a used name", "product.py", "SPARE = 3", "from x import y as LIMIT", True),
    ("a statement with an effect", "idle.py", "register(VALUE)", "register(2)", True),
    ("a decorator that is not known", "product.py", "app.command()", "app.command('x')", True),
    ("the body of a function with such a decorator", "product.py", "return 2", "return 3", False),
    ("a new class whose base is not known", "other.py", "def helper", "class A(Un): ...\ndef helper", True),
    ("a new class", "other.py", "def helper", "class A: ...\ndef helper", False),
    # Texts and form.
    ("a comment", "product.py", "LIMIT = 2", "LIMIT = 2  # two", False),
    ("the form", "product.py", "return self.step() + LIMIT", "return (self.step()\n  + LIMIT)", False),
    ("the docstring of a function", "product.py", "Drives.", "Goes.", False),
    ("the docstring of a class", "product.py", "A robot.", "It.", False),
    ("the docstring of a module", "product.py", "The product.", "It.", False),
    ("the test", "test_it.py", "run(1)", "run(2)", True),
]


@pytest.mark.parametrize(
    ("path", "old", "new", "expected"), [row[1:] for row in CHANGES], ids=[row[0] for row in CHANGES]
)
def test_a_change_touches(path, old, new, expected):
    before, after = reached(SOURCES), reached(changed(path, old, new))
    assert (before.digest() != after.digest()) is expected
    # A replay of the change on the older tree says the same.
    reach = Reach({name: module_of(text) for name, text in SOURCES.items()})
    units = differences(module_of(SOURCES[path]), module_of(changed(path, old, new)[path]))
    found = path == "test_it.py" or any(
        reach.counts(before, path, unit) and (not has_only_docs or before.documented & {"", path})
        for unit, has_only_docs in units
    )
    assert found is expected


@pytest.mark.parametrize(
    ("reader", "of_others"),
    [("return cls.__doc__", True), ("return inspect.getdoc(cls)", True), ("return __doc__", False)],
)
def test_docstrings_count_where_code_reads_them(reader, of_others):
    sources = SOURCES | {"test_it.py": f"from base import Base\ndef test_it(cls):\n    {reader}\n"}
    before = reached(sources).digest()
    other = sources | {"base.py": sources["base.py"].replace("A base.", "It.")}
    assert (reached(other).digest() != before) is of_others


def test_the_docstring_of_a_module_counts_where_it_reads_it():
    sources = changed("product.py", "return Robot", "print(__doc__)\n    return Robot")
    other = sources | {"product.py": sources["product.py"].replace("The product.", "It.")}
    assert reached(sources).digest() != reached(other).digest()


def test_modules_that_are_read_by_convention_count_as_a_whole():
    reach = Reach({"a/settings.py": module_of("DEBUG = True\n"), "a/apps.py": module_of("A = 1\n")})
    found = reach.of((), (), frozenset({"a/settings.py", "a/apps.py"}), "test_x.py")
    assert {unit.name for _, unit in found.units} == {"DEBUG", "A"}


def test_hooks_of_pytest_count_with_their_bodies():
    source = "def pytest_collection_modifyitems(items):\n    items.sort()\n"
    sources = SOURCES | {"idle.py": source}
    other = sources | {"idle.py": source.replace("sort", "clear")}
    assert reached(sources).digest() != reached(other).digest()
