"""Differences of two states of a project."""

from __future__ import annotations

from backend.workers.differences import MAX_LINES, diff


def test_files_are_added_changed_and_removed() -> None:
    found = diff({"a": "1\n", "b": "1\n"}, {"b": "2\n", "c": "1"})
    assert [(entry["path"], entry["change"]) for entry in found] == [
        ("a", "removed"),
        ("b", "changed"),
        ("c", "added"),
    ]
    assert found[1]["diff"].endswith("-1\n+2\n")
    assert found[2]["diff"].startswith("--- /dev/null")
    assert found[2]["diff"].endswith("No newline at end of file\n")


def test_what_is_no_text_or_too_long_is_only_named() -> None:
    long = "x\n" * (MAX_LINES + 1)
    assert [entry["diff"] for entry in diff({"a": None, "b": long}, {"a": None, "b": ""})] == [None, None]
