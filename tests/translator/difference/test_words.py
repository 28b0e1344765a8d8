"""The operations in words."""

from __future__ import annotations

import pytest

from tests.shared.make_differences import OLDER, changed
from translator.difference.projects import Version, compare_versions
from translator.difference.words import lines, shown


def said(newer, older=OLDER):
    versions = [Version("", {each["id"]: each} if each else {}) for each in (older, newer)]
    return [line.strip() for line in lines(compare_versions(*versions))]


@pytest.mark.parametrize(
    ("newer", "line"),
    [
        (changed(a={"ports": {"speed": "0.3", "gone": "x"}}), "≠ Forward [a]: speed: “0.2” → “0.3”"),
        (changed(c={"name": "right"}), "≠ right (Turn) [c]: renamed: “left” → “right”"),
        (
            changed(r={"children": ["a", "b", "c"]}, s=None, e=None, f=None),
            "− rescue (Fallback) [s]: deleted from Sequence [r], with 2 nodes below",
        ),
        (
            changed(r={"children": ["n", "a", "b", "c", "s"]}, n={"type": "Talk"}),
            "+ Talk [n]: inserted in Sequence [r]",
        ),
        (
            changed(r={"children": ["a", "b", "w", "s"]}, w={"type": "Repeat", "children": ["c"]}),
            "+ Repeat [w]: put around left (Turn) [c]",
        ),
        (
            changed(r={"children": ["a", "d", "c", "s"]}, b=None),
            "− Inverter [b]: taken away from around IsNear [d]",
        ),
        (
            changed(r={"children": ["a", "b", "s"]}, s={"children": ["e", "c", "f"]}),
            "⇄ left (Turn) [c]: moved from Sequence [r] to rescue (Fallback) [s]",
        ),
        (changed(r={"children": ["b", "c", "s", "a"]}), "⇅ Forward [a]: reordered from place 1 to 4"),
        ({**OLDER, "attributes": {"_x": "1"}}, "≠ attributes._x: (none) → “1”"),
    ],
)
def test_a_line_for_each_operation(newer, line):
    assert said(newer) == ["≠ tree MainTree changed", line]


def test_whole_trees_and_files_are_a_line():
    assert said(None) == ["− tree MainTree removed, 9 nodes"]
    assert said(OLDER, None) == ["+ tree MainTree added, 9 nodes"]
    found = compare_versions(Version("", {}, {"a.py": b"1"}), Version("", {}, {"a.py": b"2"}))
    assert list(lines(found)) == ["≠ a.py changed"]


def test_foreign_text_moves_no_cursor():
    assert shown("a\x1b[2Jb\nc") == "a [2Jb c"
    assert len(shown("x" * 500)) == 60
