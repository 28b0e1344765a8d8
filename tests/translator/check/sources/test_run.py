"""One list for page, project and file; and whether what it says is so."""

from __future__ import annotations

import ast
import random
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any
from unittest.mock import MagicMock

import pytest

from executor.application import compat
from tests.translator.check.sources.cases import BASE, UPDATE
from translator import check, inspect_action
from translator.check.sources import source_findings
from tree_gardener import LoadError, TickError, Tree
from tree_gardener.actions import load_actions

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).parents[4]
FOLDERS = [*sorted((ROOT / "examples").glob("*/actions")), ROOT / "backend/catalog/behaviours/actions"]
BAD_INIT = f"{BASE}    def __init__(self, name, speed): ...\n{UPDATE}"


LISTED = ("NameError", "UnboundLocalError", "ImportError", "ModuleNotFoundError", "TG602", "TG604", "TG613")
"""What a run says of the mistakes that the check knows; an attribute that is set too late is another."""


def errors(project: Any) -> list[tuple[str, str, int | None]]:
    return [(item.code, item.severity.value, item.place.line) for item in check(project)]


def test_what_surely_stops_the_run_is_an_error_only_where_it_is_reached(make_project: Any) -> None:
    call = {"n1": {"type": "A"}}
    leaf = {"n1": {"type": "AlwaysSuccess"}}
    assert ("BT0645", "error", 4) in errors(make_project(call, actions={"A": BAD_INIT}))
    # A tree that nothing calls is loaded, but never made.
    beside = make_project(leaf, trees={"Other": call}, actions={"A": BAD_INIT})
    assert ("BT0645", "warning", 4) in errors(beside)
    wrong = f"{BASE}    x = foo\n{UPDATE}"
    assert ("BT0640", "error", 4) in errors(make_project(leaf, trees={"Other": call}, actions={"A": wrong}))
    assert ("BT0640", "warning", 4) in errors(make_project(leaf, actions={"A": wrong}))


def test_modules_that_actions_import_are_checked(make_project: Any) -> None:
    source = f"from helper import twice\n{BASE}{UPDATE}"
    files = {"actions/helper.py": b"import no_such_package\ntwice = foo\n"}
    found = check(make_project({"n1": {"type": "A"}}, actions={"A": source}, files=files))
    assert [(item.code, item.place.file, item.place.line, item.is_error) for item in found] == [
        ("BT0640", "actions/helper.py", 2, True),
        ("BT0642", "actions/helper.py", 1, True),
    ]


def test_a_wrong_kind_is_an_error_and_the_last_one_counts(make_project: Any) -> None:
    call = {"n1": {"type": "A"}}
    wrong = f"{BASE}    NODE_KIND = 'Conditon'\n{UPDATE}"
    assert ("BT0606", "error", 4) in errors(make_project(call, actions={"A": wrong}))
    unused = make_project({"n1": {"type": "AlwaysSuccess"}}, actions={"A": wrong})
    assert ("BT0606", "warning", 4) in errors(unused)
    twice = f"{BASE}    NODE_KIND = 'Condition'\n    NODE_KIND = 'SyncAction'\n{UPDATE}"
    project = make_project(call, actions={"A": twice})
    assert ("BT0648", "warning", 4) in errors(project)
    assert project.actions["A"].kind == "action"
    read = f"{BASE}    NODE_KIND = make()\n{UPDATE}"
    assert [item[0] for item in errors(make_project(call, actions={"A": read}))] == ["BT0647", "BT0640"]


def test_a_source_without_its_project_has_unknown_neighbours() -> None:
    source = f"import no_such_package\nfrom actions.missing import x\n{BASE}    y = foo\n{UPDATE}"
    found = source_findings(inspect_action(source, "actions/A.py"))
    assert [item.code for item in found] == ["BT0640"]


@pytest.mark.parametrize("source", ["def", "\x00", "(" * 5000, "x = " + "-" * 50_000 + "1", "x" * 3_000_000])
def test_what_cannot_be_read_is_reported_once(source: str) -> None:
    assert len(source_findings(inspect_action(source, "actions/A.py"), {})) == 1


def mutants(seed: int, count: int) -> Iterator[tuple[str, dict[str, str]]]:
    """Yields sources of actions with one change, and the name of the changed one."""
    chance = random.Random(seed)  # noqa: S311 - no secret
    for _ in range(count):
        folder = chance.choice(FOLDERS)
        sources = {path.stem: path.read_text() for path in sorted(folder.glob("*.py"))}
        name = chance.choice(sorted(sources))
        tree = ast.parse(sources[name])
        names = [node for node in ast.walk(tree) if isinstance(node, ast.Name | ast.Attribute | ast.alias)]
        bodies: list[list[ast.stmt]] = [
            body for node in ast.walk(tree) if isinstance(body := getattr(node, "body", None), list)
        ]
        body = chance.choice([tree.body, *bodies])
        first, second = chance.randrange(len(body)), chance.randrange(len(body))
        match chance.choice(("remove", "swap", "rename")):
            case "remove":
                body[first] = ast.Pass()
            case "swap":
                body[first], body[second] = body[second], body[first]
            case _:
                node = chance.choice(names)
                field = {ast.Name: "id", ast.Attribute: "attr", ast.alias: "name"}[type(node)]
                setattr(node, field, f"{getattr(node, field)}x")
        sources[name] = ast.unparse(ast.fix_missing_locations(tree))
        try:
            compile(sources[name], name, "exec")
        except SyntaxError:
            continue
        yield name, sources


@pytest.fixture
def _modules_as_before() -> Iterator[None]:
    before, path = dict(sys.modules), list(sys.path)
    compat.install()
    yield
    load_actions({})
    sys.path[:] = path
    for name in sys.modules.keys() - before.keys():
        if name in {"cv_bridge", "tree_tools", "actions"}:
            del sys.modules[name]


@pytest.mark.usefixtures("_modules_as_before")
def test_an_error_is_refused_and_what_has_no_finding_is_loaded_and_made() -> None:
    seen = {True: 0, False: 0}
    for name, sources in mutants(40, 400):
        files = {f"actions/{each}.py": text.encode() for each, text in sources.items()}
        found = source_findings(inspect_action(sources[name], f"actions/{name}.py"), files)
        has_error, why = any(item.is_error for item in found), ""
        text = f"<root BTCPP_format='4'><BehaviorTree ID='M'><{name}/></BehaviorTree></root>"
        try:
            classes = load_actions(sources, only=[name])
            Tree.from_xml(text, classes).setup(node=MagicMock())
        except (LoadError, TickError) as error:
            why = str(error)
        if "TG3" in why or "port" in why:  # the tree of this test gives no port a value
            continue
        seen[has_error] += 1
        if has_error:
            assert why, (sources[name], found)
        elif not found:
            assert not any(word in why for word in LISTED), (sources[name], why)
    assert min(seen.values()) > 40
