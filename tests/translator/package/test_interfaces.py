"""The names in the README of a package."""

from __future__ import annotations

from translator.endpoints import Endpoint
from translator.package.interfaces import (
    absolute_names,
    example_name,
    interface_rows,
    parameter_rows,
    unknown_names,
)


def endpoint(name: str, kind: str = "publisher", **more: object) -> Endpoint:
    values = {"path": "actions/Go.py", "line": 3, "type": "std_msgs/msg/String", "known": True}
    return Endpoint(**{**values, "kind": kind, "name": name, **more})  # type: ignore[arg-type]


def test_only_names_that_a_namespace_leaves_alone_are_absolute() -> None:
    assert absolute_names([endpoint("/scan"), endpoint("near"), endpoint("/tf"), endpoint("/")]) == ["/scan"]


def test_a_row_names_all_users_of_a_topic() -> None:
    opened = [endpoint("/scan"), endpoint("/scan", path="launch/extra.py")]
    assert interface_rows(opened) == [("/scan", "std_msgs/msg/String", "publishes", "Go, launch/extra.py")]


def test_the_example_is_a_name_of_an_action() -> None:
    assert example_name([endpoint("/a", path="launch/x.py"), endpoint("/b")]) == "/b"
    assert example_name([]) == ""


def test_names_that_are_made_while_it_runs_are_listed_with_their_line() -> None:
    [sentence] = unknown_names([endpoint("f'{x}'", known=False)])
    assert sentence.startswith("actions/Go.py, line 3: publishes")


def test_parameters_are_rows_of_their_own() -> None:
    assert parameter_rows([endpoint("speed", "parameter", type="0.5")]) == [("speed", "0.5", "Go")]
