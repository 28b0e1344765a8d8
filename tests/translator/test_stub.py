"""The stub of an action that nobody has written."""

from __future__ import annotations

import ast

from translator import inspect_action
from translator.stub import can_be_class, stub_source


def test_a_stub_is_python_that_fails_until_it_is_written() -> None:
    source = stub_source("Drive", None, ["speed"])
    [cls] = [node for node in ast.parse(source).body if isinstance(node, ast.ClassDef)]
    assert cls.name == "Drive"
    assert "Status.FAILURE" in source
    assert inspect_action(source, "actions/Drive.py").diagnostics == ()


def test_only_names_of_classes_can_be_stubs() -> None:
    assert can_be_class("Drive")
    assert not can_be_class("drive-away")
    assert not can_be_class("class")
