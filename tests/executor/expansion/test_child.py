"""The child reads a job, seals itself, and answers on standard output."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import TYPE_CHECKING, Any

from executor.expansion.child import ANSWER_BYTES, MEMORY_BYTES, SECONDS

if TYPE_CHECKING:
    from pathlib import Path

SEALED = """
import sys, pathlib, socket
from executor.expansion.child import seal
seal([pathlib.Path(sys.argv[1])])
print(open(sys.argv[1] + "/inside").read())
for attempt in (lambda: open(sys.argv[2]), socket.socket, lambda: open(sys.argv[1] + "/new", "w")):
    try:
        attempt()
    except OSError as error:
        print(error.strerror)
"""


def answer(file: Path) -> dict[str, Any]:
    job = {"file": str(file), "places": [["here", str(file.parent)]], "installed": [], "arguments": {}}
    done = subprocess.run(
        [sys.executable, "-m", "executor.expansion"],
        input=json.dumps(job).encode(),
        stdout=subprocess.PIPE,
        check=True,
    )
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def test_it_answers_with_the_document_or_with_the_place_of_an_error(tmp_path: Path) -> None:
    file = tmp_path / "a.xacro"
    file.write_text('<robot name="${1 + 1}"/>')
    found = answer(file)
    assert '<robot name="2"/>' in found["text"]
    assert found["files"] == [str(file)]
    file.write_text('<robot>\n<link name="${b}"/></robot>')
    assert answer(file) == {
        "error": "name 'b' is not defined when evaluating expression 'b'",
        "file": str(file),
        "line": 2,
    }
    assert (MEMORY_BYTES >> 20, SECONDS, ANSWER_BYTES >> 20) == (512, 10, 16)


def test_a_sealed_process_reads_its_folders_and_opens_no_socket(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "inside").write_text("seen")
    (tmp_path / "out").write_text("not seen")
    done = subprocess.run(
        [sys.executable, "-c", SEALED, str(tmp_path / "in"), str(tmp_path / "out")],
        capture_output=True,
        text=True,
        check=True,
    )
    refused = "a robot file may not do that"
    assert done.stdout.splitlines() == ["seen", "it lies outside of the project", refused, refused]
