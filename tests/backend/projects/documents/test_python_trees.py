"""The reader of Python files is that of a higher layer."""

from __future__ import annotations

import io
from concurrent.futures import Future

from backend.accounts.models import User
from backend.core.processes.stops import Stop
from backend.imports import trees
from backend.projects.documents import python_trees
from backend.projects.documents.python_trees import Made, Python


def test_the_last_reader_that_was_given_reads() -> None:
    made: Future[Made] = Future()
    asked = []

    def reader(user: User, python: Python, stop: Stop) -> Future[Made]:
        asked.append((user.pk, python.name, stop))
        return made

    stop = Stop()
    python_trees.read_by(reader)
    try:
        assert python_trees.read(User(pk=3), Python(io.BytesIO(), "a.py", ""), stop) is made
    finally:
        python_trees.read_by(trees.read)
    assert asked == [(3, "a.py", stop)]
