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


def test_its_commands_pass_for_an_example_and_fail_for_a_changed_tree(project):
    check, test = [step["run"] for step in steps() if step.get("run", "").startswith(PROGRAM)]
    assert [status(check, project.parent), status(test, project.parent)] == [0, 0]
    tree = project / "trees" / "MainTree.json"
    tree.write_text(tree.read_text().replace('"ReactiveSequence"', '"Sequence"'))
    assert status(test, project.parent) == 1
    suite = ET.parse(project.parent / "tests.xml").getroot()[0]  # noqa: S314 - our own file
    assert suite.get("failures") != "0"
    tree.write_text(tree.read_text().replace('"Turn"', '"Nowhere"'))
    assert status(check, project.parent) == 1


def test_it_keeps_what_its_commands_write():
    [kept] = [step["with"]["path"].split() for step in steps() if "upload" in step.get("uses", "")]
    written = shlex.split(next(step["run"] for step in steps() if " test " in step.get("run", "")))
    assert kept == [written[written.index(option) + 1] for option in ("--junit", "--coverage")]
