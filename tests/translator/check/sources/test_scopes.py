"""Which names a module binds and uses, and when each use runs."""

from __future__ import annotations

import ast

import pytest

from translator.check.sources.scopes import Scopes


@pytest.mark.parametrize(
    ("source", "moment"),
    [
        ("x", "LOAD"),
        ("class A:\n    y = x", "LOAD"),
        ("if x: pass", "LOAD"),
        ("if True: x", "LOAD"),
        ("if y: x", "LATER"),
        ("y and x", "LATER"),
        ("x if y else z", "LATER"),
        ("1 < 2 < x", "LATER"),
        ("for y in z: x", "LATER"),
        ("for y in x: pass", "LOAD"),
        ("while y: x", "LATER"),
        ("with y: x", "LATER"),
        ("try: x\nfinally: pass", "LOAD"),
        ("try: x\nexcept OSError: pass", "LOAD"),
        ("try: pass\nexcept OSError: x", "LATER"),
        ("def f(): x", "LATER"),
        ("def f(y=x): pass", "LOAD"),
        ("lambda: x", "LATER"),
        ("lambda y=x: y", "LOAD"),
        ("[y for y in x]", "LOAD"),
        ("{y: x for y in z}", "LATER"),
        ("match x:\n    case 1: pass", "LOAD"),
        ("x += 1", "LOAD"),
        ("y = x.z", "LOAD"),
        ("x.z = y", "LOAD"),
        ("if y:\n    raise z\nx", "LATER"),
    ],
)
def test_when_a_use_runs(source: str, moment: str) -> None:
    (use,) = [use for use in Scopes(ast.parse(source)).uses if use.name == "x"]
    assert use.moment.name == moment


@pytest.mark.parametrize(
    "source",
    [
        "if False: x",
        "if not True: x",
        "if TYPE_CHECKING: x",
        "if __name__ == '__main__': x",
        "if __name__ != '__main__': pass\nelse: x",
        "try: x\nexcept Exception: pass",
        "try: x\nexcept (OSError, NameError): pass",
        "raise y\nx",
        "x = 1",
        "del x",
    ],
)
def test_what_never_runs_or_may_fail_is_no_use(source: str) -> None:
    assert [use for use in Scopes(ast.parse(source)).uses if use.name == "x"] == []


def test_imports_are_tried_inner_or_neither() -> None:
    source = (
        "import a\ntry:\n    import b\nfinally:\n    pass\ndef f():\n    import c\nclass C:\n    import d\n"
    )
    found = Scopes(ast.parse(source)).imports
    assert [(each.is_tried, each.is_inner) for each in found] == [
        (False, False),
        (True, False),
        (False, True),
        (False, False),
    ]


def test_names_of_a_class_are_not_those_of_its_methods() -> None:
    scopes = Scopes(ast.parse("class A:\n    x = 1\n    y = x\n    def f(self): x\n"))
    assert [(use.moment.name, scopes.knows(use)) for use in scopes.uses if use.name == "x"] == [
        ("LOAD", True),
        ("LATER", False),
    ]


def test_what_is_kept_of_a_source_is_small() -> None:
    scopes = Scopes(ast.parse("import a\ndef f(): pass\nclass C: pass\n"))
    bound = [binding.statement for each in scopes.bindings.values() for binding in each]
    assert [type(each) for each in bound] == [ast.Import, type(None), type(None)]
