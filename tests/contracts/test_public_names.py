"""Names on which users, stored files and other programs rely do not change."""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys

import pytest

from tests.contracts.public_names import GONE, NEW, ROOT, Names, gone, new, read


@pytest.fixture(scope="module")
def found() -> Names:
    """The names in the code, collected in a process of its own, without this machine's settings."""
    environment = {key: value for key, value in os.environ.items() if not key.startswith("BT_STUDIO_")}
    done = subprocess.run(
        [sys.executable, "-m", "tests.contracts.public_names", "--print"],
        cwd=ROOT, env=environment, check=True, capture_output=True, text=True,
    )  # fmt: skip
    names: Names = json.loads(done.stdout)
    return names


def test_no_public_name_is_removed_or_renamed(found):
    assert gone(read(), found) == [], GONE


def test_every_public_name_is_in_the_list(found):
    assert new(read(), found) == [], NEW


def test_no_kind_of_name_is_empty(found):
    assert [kind for kind, names in found.items() if not names] == []


def test_every_entry_point_is_a_module(found):
    modules = [name.partition(":")[0] for name in found["entry points"]]
    assert [name for name in modules if importlib.util.find_spec(name) is None] == []


def test_a_missing_name_is_reported_with_its_kind():
    stored = {"cookies": ["a", "b"], "tabs": ["c"]}
    assert gone(stored, {"cookies": ["b", "d"]}) == ["cookies: a", "tabs: c"]
    assert new(stored, {"cookies": ["b", "d"]}) == ["cookies: d"]
