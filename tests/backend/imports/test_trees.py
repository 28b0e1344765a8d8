"""A Python file with a tree of py_trees is imported as a project."""

from __future__ import annotations

import io
import json
from concurrent.futures import Future
from typing import Any

import pytest

from backend.accounts.models import User
from backend.core.problems import InvalidInputError
from backend.core.processes.stops import Stop
from backend.core.scratch import scratch
from backend.imports import trees
from backend.imports.errors import ImportRefusedError
from backend.projects.documents import python_trees
from backend.projects.documents.python_trees import Made, Python
from backend.projects.errors import CheckFailedError, QuotaExceededError

TREE = b"""import py_trees

def create_root():
    return py_trees.composites.Sequence("both", memory=True, children=[py_trees.behaviours.Success("a")])
"""
OTHER = b"\n\ndef other_tree():\n    return py_trees.behaviours.Failure('f')\n"


def sent(api: Any, data: bytes, more: str = "") -> Any:
    address = f"/api/v1/projects/import?filename=robot.py{more}"
    return api.client.generic("POST", address, data=data, content_type="application/octet-stream")


def test_a_tree_comes_in_as_a_project_of_blocks(api: Any) -> None:
    made = sent(api, TREE, "&order=ask")
    assert made.status_code == 201, made.content
    project = made.json()
    texts = {file["path"]: file["content"] for file in project["files"]}
    assert {"Sequence", "AlwaysSuccess"} <= {
        node["type"] for node in json.loads(texts["trees/MainTree.json"])["nodes"].values()
    }
    assert (project["one_block"], project["proposal"]) == ("", None)


def test_what_was_made_waits_in_a_file_that_is_removed_with_the_answer(api: Any) -> None:
    before = scratch().used
    answer = b'{"files": [{"path": "project.json", "base64": "e30="}], "one_block": "why"}'
    made = trees.make(PYTHON, Stop(), lambda *_: answer)
    assert (made.files["project.json"].data, made.one_block) == (b"{}", "why")
    assert scratch().used == before + 2
    python_trees.read_by(lambda *_: finished(made))
    try:
        assert sent(api, TREE).status_code == 201
    finally:
        python_trees.read_by(trees.read)
    assert scratch().used == before


def finished(made: Made) -> Future[Made]:
    work: Future[Made] = Future()
    work.set_result(made)
    return work


def test_several_trees_are_choices_and_one_is_taken(api: Any) -> None:
    refused = sent(api, TREE + OTHER)
    assert refused.status_code == 422
    found = refused.json()["diagnostics"]
    assert [item["values"]["choice"] for item in found] == ["create_root", "other_tree"]
    assert sent(api, TREE + OTHER, "&main=other_tree").status_code == 201


def test_what_fails_is_said_with_file_and_line(api: Any) -> None:
    refused = sent(api, b"import py_trees\nnone\n")
    assert refused.status_code == 422
    [found] = refused.json()["diagnostics"]
    assert (found["code"], found["file"], found["line"]) == ("BT0928", "robot.py", 2)
    assert "NameError" in found["message"]
    assert "robot.py:2" in refused.json()["detail"]


PYTHON = Python(io.BytesIO(TREE), "robot.py", "")


@pytest.mark.parametrize(
    ("answer", "error"),
    [
        (b"", ImportRefusedError),
        (b'{"files": [{"path": "../x", "base64": ""}]}', InvalidInputError),
        (b'{"no_tree": {"file": "a.py", "line": 3, "message": "no", "choices": []}}', CheckFailedError),
        (b'{"one_block": "' + b"x" * 20_001 + b'"}', ImportRefusedError),
        (b'{"no_tree": {"file": "a.py", "line": 3, "message": "\xff", "choices": []}}', ImportRefusedError),
        (b'{"no_tree": {"file": "", "line": 3, "message": "", "choices": ["\\ud800"]}}', ImportRefusedError),
    ],
)
def test_the_answer_of_the_child_is_not_trusted(answer: bytes, error: type[Exception]) -> None:
    with pytest.raises(error):
        trees.make(PYTHON, Stop(), lambda *_: answer)


def test_a_file_that_is_too_large_is_refused() -> None:
    with pytest.raises(QuotaExceededError, match="at most"):
        trees.read(User(pk=1), Python(io.BytesIO(b"#" * ((4 << 20) + 1)), "robot.py", ""), Stop())
