"""The table of what errors of actions do, and a project for each row."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Final

ROWS_FILE: Final = Path(__file__).with_name("rows.json")
MESSAGE: Final = "no arm"
EVALUATION: Final = """format: bt-studio/evaluation
version: 1
universe: walled_room
duration_s: 4
runs: 1
judge: {success: [{tree: SUCCESS}]}
"""
TEST: Final = """format: bt-studio/test
version: 1
tests:
  - name: it ends
    ticks: 20
    doubles: {Subject: real, Ends: real, Waits: real}
    expect: [{at: end, root: SUCCESS}]
"""
SUBJECT: Final = """import pathlib
import threading

import py_trees
from py_trees.common import Status

def note(word):
    with pathlib.Path("MARKS").open("a") as file:
        file.write(f"{word}\\n")


def fail(*_):
    raise ValueError("no arm")


def made_by_nobody(node):
    node.create_timer(0.05, fail)


class Subject(py_trees.behaviour.Behaviour):
    def setup(self, node=None, **_):
        self.node = node

    def fail_later(self):
        timer = self.node.create_timer(0.05, lambda: (self.node.destroy_timer(timer), fail()))

    def initialise(self):
        note("begin")
        self.ticks = 0
        BEGIN

    def update(self):
        self.ticks += 1
        UPDATE

    def terminate(self, new_status):
        note(f"terminate {new_status.name}")
        TERMINATE
"""
LEAF: Final = """import pathlib

import py_trees
from py_trees.common import Status


class NAME(py_trees.behaviour.Behaviour):
    def initialise(self):
        self.note("next")

    def note(self, word):
        if self.name == "Waits" and word == "next":
            return
        with pathlib.Path("MARKS").open("a") as file:
            file.write(f"{word}\\n")

    def update(self):
        return Status.RESULT

    def terminate(self, new_status):
        if self.name == "Waits":
            self.note(f"waits {new_status.name}")
"""
# By row: what begins, one line of `update`, one of `terminate`.
_CODE: Final = {
    "update": ("pass", "return Status.RUNNING if self.ticks < 3 else fail()", "pass"),
    "callback": ("self.fail_later()", "return Status.RUNNING", "pass"),
    "callback-idle": ("self.fail_later()", "return Status.SUCCESS", "pass"),
    "callback-unowned": (
        "threading.Thread(target=made_by_nobody, args=(self.node,)).start()",
        "return Status.RUNNING",
        "pass",
    ),
    "terminate": ("pass", "return Status.SUCCESS", "fail()"),
}


@dataclass(frozen=True)
class Row:
    """A row of the table."""

    row: str
    raises: str
    on_error: str
    what: str
    ends: str
    marks: list[str]

    def __str__(self) -> str:
        return f"{self.row}-{self.on_error}"

    @property
    def is_error(self) -> bool:
        return self.ends == "error"

    @property
    def line(self) -> int:
        """The line of *Subject* that raises."""
        return SUBJECT.splitlines().index('    raise ValueError("no arm")') + 1

    def sources(self, marks: Path) -> dict[str, str]:
        """The sources of the actions by name; what they do is noted in a file."""
        begin, update, terminate = _CODE[self.row]
        subject = SUBJECT.replace("BEGIN", begin).replace("UPDATE", update).replace("TERMINATE", terminate)
        ends, waits = (
            LEAF.replace("NAME", name).replace("RESULT", result)
            for name, result in (("Ends", "SUCCESS"), ("Waits", "RUNNING"))
        )
        found = {"Subject": subject, "Ends": ends, "Waits": waits}
        return {name: source.replace("MARKS", str(marks)) for name, source in found.items()}

    def xml(self) -> str:
        """The tree as XML."""
        first = "<Subject/>"
        if self.row == "callback-idle":
            first = f"<Sequence>{first}<Waits/></Sequence>"
        code = "".join(f'<Action name="{name}"/>' for name in ("Subject", "Ends", "Waits"))
        return (
            f'<root BTCPP_format="4"><BehaviorTree ID="Main"><Fallback>{first}<Ends/></Fallback>'
            f"</BehaviorTree><Code>{code}</Code></root>"
        )

    def project(self, folder: Path, marks: Path) -> Path:
        """Writes the project into a folder."""
        nodes = {
            "top": {"type": "Fallback", "children": ["first", "ends"]},
            "first": {"type": "Subject"},
            "ends": {"type": "Ends"},
        }
        if self.row == "callback-idle":
            nodes["first"] = {"type": "Sequence", "children": ["subject", "waits"]}
            nodes |= {"subject": {"type": "Subject"}, "waits": {"type": "Waits"}}
        settings = {
            "name": "errors",
            "main_tree": "Main",
            "universe": "walled_room",
            "on_error": self.on_error,
        }
        tree = {"format": "bt-studio/diagram", "version": 1, "id": "Main", "root": "top", "nodes": nodes}
        files = {
            "project.json": json.dumps(settings),
            "trees/Main.json": json.dumps(tree),
            "evaluations/main.yaml": EVALUATION,
            "tests/main.test.yaml": TEST,
            **{f"actions/{name}.py": source for name, source in self.sources(marks).items()},
        }
        for name, text in files.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return folder


def rows() -> list[Row]:
    """Returns the table."""
    return [Row(**row) for row in json.loads(ROWS_FILE.read_text())]


def marks_of(file: Path) -> list[str]:
    """Returns what the actions have noted."""
    return file.read_text().splitlines() if file.is_file() else []
