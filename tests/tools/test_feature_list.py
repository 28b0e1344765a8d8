"""The list of steps in the browser's tests names only steps that exist."""

from __future__ import annotations

import ast
import re
from pathlib import Path

E2E = Path(__file__).resolve().parents[1] / "e2e"
STEP = re.compile(r"`(\w+)::(\w+)`")


def functions() -> set[tuple[str, str]]:
    return {
        (file.stem, node.name)
        for file in E2E.glob("*.py")
        for node in ast.parse(file.read_text(encoding="utf-8")).body
        if isinstance(node, ast.FunctionDef)
    }


def test_every_step_that_is_named_exists_and_every_file_of_tests_has_one():
    named = set(STEP.findall((E2E / "README.md").read_text(encoding="utf-8")))
    exist = functions()
    assert named <= exist, sorted(named - exist)
    files = {file for file, name in exist if name.startswith("test_")}
    assert files <= {file for file, _ in named}
