"""The workflow of `docs/how-to/test-in-ci.md`: its commands are run as they stand there."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs" / "how-to" / "test-in-ci.md"
WRITER = ROOT / "frontend" / "src" / "model" / "evaluation" / "workflow.ts"
PROGRAM = "bt-studio/.venv/bin/bt-studio"


@pytest.fixture
def project(tmp_path):
    shutil.copytree(ROOT / "examples" / "laser_bump_and_go", tmp_path / "project")
    return tmp_path / "project"


def steps():
    [text] = re.findall(r"```yaml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    return yaml.safe_load(text)["jobs"]["trees"]["steps"]


def status(command, folder):
    program, *arguments = shlex.split(command)
    assert program == PROGRAM
    done = subprocess.run(
        [sys.executable, "-m", "backend.cli.main", *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode


def commands():
    return [step["run"] for step in steps() if step.get("run", "").startswith(PROGRAM)]


def test_its_commands_pass_for_an_example_and_fail_for_a_changed_tree(project):
    check, test, _ = commands()
    assert [status(check, project.parent), status(test, project.parent)] == [0, 0]
    tree = project / "trees" / "MainTree.json"
    tree.write_text(tree.read_text().replace('"ReactiveSequence"', '"Sequence"'))
    assert status(test, project.parent) == 1
    suite = ET.parse(project.parent / "tests.xml").getroot()[0]  # noqa: S314 - our own file
    assert suite.get("failures") != "0"
    tree.write_text(tree.read_text().replace('"Turn"', '"Nowhere"'))
    assert status(check, project.parent) == 1


@pytest.mark.simulation
def test_its_gate_decides(project):
    """Two short runs cannot show a rate of 95 %, but all of them succeed."""
    *_, evaluate = commands()
    assert "--runs 60 --gate 'success>=0.95'" in evaluate
    file = project / "evaluations" / "room.yaml"
    file.write_text(file.read_text().replace("duration_s: 60", "duration_s: 2"))
    few = evaluate.replace("--runs 60", "--runs 2")
    assert status(few, project.parent) == 1
    suite = ET.parse(project.parent / "room.xml").getroot()[0]  # noqa: S314 - our own file
    assert [case.get("name") for case in suite if len(case)] == ["success>=0.95"]
    shutil.rmtree(project.parent / "results")
    assert status(few.replace("success>=", "rate(success)>="), project.parent) == 0


def test_it_keeps_what_its_commands_write():
    [kept] = [step["with"]["path"].split() for step in steps() if "upload" in step.get("uses", "")]
    options = ("--junit", "--coverage", "--report")
    written = [
        words[words.index(option) + 1]
        for words in map(shlex.split, commands())
        for option in options
        if option in words
    ]
    assert kept == written


def test_the_page_writes_the_same_file():
    """`workflow.ts` writes it, but for the words of a person around it."""
    source = WRITER.read_text(encoding="utf-8")
    for command in commands():
        words = command.removeprefix(PROGRAM).replace(" room ", " ${name} ")
        assert words.replace("room.xml", "${name}.xml").replace("results/room", "results/${name}") in source
