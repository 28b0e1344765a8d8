"""The robots with macros of a project, as the simulator reads them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from executor.uploads.check import check
from tests.cli.typed import ROOT
from tests.executor.expansion.probes import probes, was_refused

if TYPE_CHECKING:
    from pathlib import Path


def test_an_error_has_the_file_of_the_project_and_its_line(tmp_path: Path) -> None:
    (tmp_path / "secret.yaml").write_text("word: hidden")
    burger = ROOT / "executor" / "robots" / "burger"
    project = tmp_path / "project"
    for name, text in (
        ("good", (burger / "burger.urdf").read_text()),
        ("bad", probes(tmp_path / "secret.yaml")[1]),
    ):
        folder = project / "robots" / name
        folder.mkdir(parents=True)
        config = (burger / "robot.yaml").read_text()
        (folder / "robot.yaml").write_text(re.sub(r"(?m)^urdf: .*$", "urdf: r.xacro", config))
        (folder / "r.xacro").write_text(text)
    coded = project / "robots" / "coded"
    coded.mkdir()
    (coded / "robot.yaml").write_bytes(b"name: a\nurdf: r\xff.xacro\n")
    (coded / "r.xacro").write_text("<robot/>")
    found, other = check(project)
    assert (found["file"], found["line"]) == ("robots/bad/r.xacro", 2)
    assert was_refused(found["message"])
    text = "the document is not UTF-8"
    assert other == {"file": "robots/coded/robot.yaml", "line": 2, "message": text}
