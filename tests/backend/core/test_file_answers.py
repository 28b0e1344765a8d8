"""Answers that lie in a file."""

from __future__ import annotations

import io

import pytest

from backend.core.file_answers import PART, FileAnswer


def test_the_file_is_sent_from_its_beginning_in_parts() -> None:
    data = b"x" * (PART + 5)
    file = io.BytesIO(data)
    file.seek(3)
    answer = FileAnswer(file)
    assert answer.headers["Content-Length"] == str(len(data))
    assert b"".join(answer) == data


@pytest.mark.django_db  # the end of an answer looks at the connections of its process
def test_a_file_that_was_taken_belongs_to_its_taker() -> None:
    file = io.BytesIO(b"x")
    answer = FileAnswer(file)
    assert answer.take() is file
    answer.close()
    assert not file.closed


@pytest.mark.django_db  # the end of an answer looks at the connections of its process
def test_a_file_that_nobody_took_is_closed_with_the_answer() -> None:
    file = io.BytesIO(b"x")
    FileAnswer(file).close()
    assert file.closed
