"""Reading a recording in a child with limits."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from executor.recorder.summary.apart import main

ROOT = Path(__file__).parents[4]
SAMPLE = ROOT / "tests" / "executor" / "recorder" / "samples" / "v1.mcap"


def told(*arguments, source=None, cwd=ROOT):
    command = [sys.executable, "-m", "executor.recorder.summary", *map(str, arguments)]
    environment = {"PATH": os.environ["PATH"]}
    with (source or SAMPLE).open("rb") as file:
        done = subprocess.run(command, stdin=file, capture_output=True, check=True, cwd=cwd, env=environment)
    return json.loads(done.stdout)


def segment(folder, run, number, data=None):
    (folder / run).mkdir(exist_ok=True)
    (folder / run / f"{number:05d}.0.mcap").write_bytes(SAMPLE.read_bytes() if data is None else data)


def age(folder, *runs):
    for seconds, run in enumerate(runs):
        os.utime(folder / run, (1000 + seconds, 1000 + seconds))


def test_the_child_says_what_is_in_the_recording_at_its_standard_input():
    found = told("file", "f")
    assert (found["messages"], found["ticks"], found["result"]) == (325, 21, "running")
    assert found["picture"].startswith("/9j/")
    assert callable(main)


def test_it_finds_the_place_of_a_fault(tmp_path):
    (tmp_path / "f").write_bytes(b"no recording")
    found = told("file", "f", source=tmp_path / "f")
    assert (found["code"], found["place"]) == ("damaged", 0)
    assert "does not begin" in found["message"]


def test_the_newest_run_with_ticks_is_joined(tmp_path):
    runs = tmp_path / "runs"
    runs.mkdir()
    segment(runs, "a1", 0)
    segment(runs, "b2", 0)
    segment(runs, "b2", 1, SAMPLE.read_bytes()[:-3000])  # killed while it was written
    segment(runs, "c3", 0, b"")  # a run that has just begun
    age(runs, "a1", "b2", "c3")
    found = told("newest", runs, tmp_path / "out")
    assert (found["run"], found["messages"] > 325) == ("b2", True)
    assert (tmp_path / "out").stat().st_size > SAMPLE.stat().st_size


def test_links_and_folders_with_other_names_are_left_alone(tmp_path):
    runs = tmp_path / "runs"
    (runs / "a1").mkdir(parents=True)
    (runs / "a1" / "00000.0.mcap").symlink_to(SAMPLE)
    (runs / "not hex").mkdir()
    assert told("newest", runs, tmp_path / "out")["code"] == "not_recorded"


@pytest.mark.parametrize("name", ["file", "newest"])
def test_the_web_servers_image_has_all_that_the_child_needs(name, tmp_path):
    """The image has a part of the executor; the child runs with that part alone."""
    text = (ROOT / "docker" / "web.Dockerfile").read_text()
    sources = re.findall(r"^COPY (executor/(?!universes|robots)\S*) ", text, re.MULTILINE)
    for source in sources:
        for path in ROOT.glob(source):
            target = tmp_path / path.relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            if path.is_dir():
                shutil.copytree(path, target)
            else:
                shutil.copy(path, target)
    runs = tmp_path / "runs"
    runs.mkdir()
    segment(runs, "a1", 0)
    arguments = ("file", "f") if name == "file" else ("newest", runs, tmp_path / "out")
    assert told(*arguments, cwd=tmp_path)["ticks"] == 21
