from __future__ import annotations

import pytest

from translator.action_returns import returned_statuses, returns_of

HEAD = "import py_trees\nclass A(py_trees.behaviour.Behaviour):\n    def update(self):\n        "


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("return py_trees.common.Status.RUNNING", "RUNNING"),
        ("if x:\n            return Status.SUCCESS\n        return Status.FAILURE", "FAILURE SUCCESS"),
        ("return Status.SUCCESS if x else Status.RUNNING", "RUNNING SUCCESS"),
        ("return self.result()", ""),
        ("if x:\n            return self.result\n        return Status.SUCCESS", ""),
        ("return Status.SUCCESS if x else y", ""),
        ("def inner():\n            return 3\n        return Status.SUCCESS", "SUCCESS"),
        ("return Mine.SUCCESS", ""),
        ("return", ""),
        ("pass", ""),
    ],
)
def test_the_results_of_update(body, expected):
    assert " ".join(sorted(returned_statuses(HEAD + body, "A"))) == expected


@pytest.mark.parametrize(
    "source", ["", "class A(", "class B:\n    def update(self): return Status.SUCCESS", "x" * 9]
)
def test_other_sources_say_nothing(source):
    assert returned_statuses(source, "A") == frozenset()


CLASS = "import py_trees\nclass A(py_trees.behaviour.Behaviour):\n"


@pytest.mark.parametrize(
    ("declaration", "known", "problem"),
    [
        ("RETURNS = {'SUCCESS', 'RUNNING'}", "RUNNING SUCCESS", ""),
        ("RETURNS = (Status.FAILURE,)", "FAILURE", ""),
        ("RETURNS: ClassVar = frozenset({'SKIPPED'})", "SKIPPED", ""),
        ("RETURNS = {'DONE'}", "", "'DONE' is no result"),
        ("RETURNS = results()", "", "it is no set of results"),
        ("RETURNS = []", "", "it is no set of results"),
    ],
)
def test_results_that_a_class_states(declaration, known, problem):
    source = f"{CLASS}    {declaration}\n    def update(self):\n        return self.x()\n"
    found = returns_of(source, "A")
    assert " ".join(sorted(found.known)) == known
    assert (found.problem, found.declared, found.line) == (problem, not problem, 3)


def test_a_declaration_that_leaves_out_what_is_plain_to_see_is_not_used():
    source = f"{CLASS}    RETURNS = {{'SUCCESS'}}\n    def update(self):\n        return Status.RUNNING\n"
    found = returns_of(source, "A")
    assert found.problem == "update returns RUNNING too"
    assert found.known == {"RUNNING"}


@pytest.mark.parametrize("line", ["@wrapped", "update = wrap(update)", "NODE_KIND = 'SyncAction'"])
def test_what_changes_update(line):
    body = "    def update(self):\n        return Status.SUCCESS\n"
    before = f"    {line}\n{body}"
    after = f"{body}    {line}\n"
    found = returns_of(CLASS + (after if line.startswith("update") else before), "A")
    assert found.named == {"SUCCESS"}
    assert found.known == ({"SUCCESS"} if "KIND" in line else frozenset())
    assert found.is_sync == ("KIND" in line)


def test_what_was_read_is_kept_by_the_hash_of_the_source():
    source = f"{CLASS}    def update(self):\n        return Status.SUCCESS\n"
    again = "".join(list(source))
    assert again is not source
    assert returns_of(source, "A") is returns_of(again, "A")
    assert returns_of(source + "\n", "A") is not returns_of(source, "A")
