"""The effect of a change set on files, without a database."""

from __future__ import annotations

import pytest

from backend.core.problems import InvalidInputError
from backend.projects.storage.changes import Content, Existing, FileChange, plan

ONE = Content.of(b"one")
TWO = Content.of(b"two")


def existing(*rows):
    return {path: Existing(path, revision, ONE.sha256, 3) for path, revision in rows}


def test_a_new_file_is_written():
    result = plan({}, [FileChange("a", 0, ONE)])
    assert [(w.path, w.sha256) for w in result.written] == [("a", ONE.sha256)]


def test_a_file_that_must_not_exist_and_does_is_a_conflict():
    result = plan(existing(("a", 3)), [FileChange("a", 0, TWO)])
    assert [(c.path, c.theirs.revision) for c in result.conflicts] == [("a", 3)]


@pytest.mark.parametrize(("base", "conflicts"), [(2, True), (3, False), (9, False)])
def test_a_base_is_stale_when_the_file_is_newer(base, conflicts):
    assert bool(plan(existing(("a", 3)), [FileChange("a", base, TWO)]).conflicts) is conflicts


def test_saving_what_is_there_is_neither_a_conflict_nor_a_change():
    assert plan(existing(("a", 3)), [FileChange("a", 1, ONE)]).is_empty


def test_one_conflict_keeps_the_whole_change_from_happening():
    result = plan(existing(("a", 3)), [FileChange("b", 0, ONE), FileChange("a", 1, TWO)])
    assert result.is_empty
    assert len(result.conflicts) == 1


def test_writing_a_file_that_is_gone_is_a_conflict_but_deleting_it_is_done():
    assert plan({}, [FileChange("a", 2, ONE)]).conflicts[0].theirs is None
    assert plan({}, [FileChange("a", 2, delete=True)]).is_empty


def test_a_stale_deletion_is_a_conflict():
    assert plan(existing(("a", 3)), [FileChange("a", 2, delete=True)]).conflicts


def test_a_rename_keeps_the_content_or_takes_a_new_one():
    kept = plan(existing(("a", 1)), [FileChange("a", 1, rename_to="b")])
    assert kept.removed == ("a",)
    assert [(w.path, w.sha256, w.content, w.renamed_from) for w in kept.written] == [
        ("b", ONE.sha256, None, "a")
    ]
    edited = plan(existing(("a", 1)), [FileChange("a", 1, TWO, rename_to="b")])
    assert edited.written[0].content is TWO


def test_two_files_can_swap_their_names():
    result = plan(
        existing(("a", 1), ("b", 1)), [FileChange("a", 1, rename_to="b"), FileChange("b", 1, rename_to="a")]
    )
    assert {w.path: w.renamed_from for w in result.written} == {"b": "a", "a": "b"}
    assert result.removed == ()


def test_renaming_onto_a_file_is_a_conflict_and_changing_case_is_none():
    assert plan(existing(("a", 1), ("b", 2)), [FileChange("a", 1, rename_to="b")]).conflicts[0].path == "b"
    assert plan(existing(("a", 1), ("b", 2)), [FileChange("a", 1, rename_to="B")]).conflicts
    assert not plan(existing(("a", 1)), [FileChange("a", 1, rename_to="A")]).conflicts


@pytest.mark.parametrize(
    "wanted",
    [
        [FileChange("a", 0, ONE), FileChange("a", 0, TWO)],
        [FileChange("a", 0, ONE), FileChange("A", 0, TWO)],
        [FileChange("a", 0, ONE), FileChange("a/b", 0, TWO)],
        [FileChange("a", 0)],
        [FileChange("a", 0, ONE, delete=True)],
        [FileChange("a", 0, ONE, rename_to="b")],
    ],
)
def test_requests_that_contradict_themselves(wanted):
    with pytest.raises(InvalidInputError):
        plan({}, wanted)


def test_a_file_cannot_be_where_another_has_its_folder():
    with pytest.raises(InvalidInputError, match="is a file"):
        plan(existing(("a/b", 1)), [FileChange("A", 0, ONE)])
