"""The versions that `diff` compares."""

from __future__ import annotations

import pytest

from backend.cli.comparing.versions import open_version
from backend.cli.new import new
from backend.cli.shared.errors import CliError
from tests.translator.conftest import EXAMPLES, ROOT
from translator import TranslatorError

EXAMPLE = ROOT / "examples" / EXAMPLES[0]
XML = '<root BTCPP_format="4"><BehaviorTree ID="T"><Foo speed="1"/></BehaviorTree></root>'


def test_a_project_a_diagram_and_an_xml_file(tmp_path):
    project = open_version(str(EXAMPLE))
    assert "actions/Forward.py" in project.files
    assert project.ids is None
    diagram = open_version(str(EXAMPLE / "trees/MainTree.json"))
    assert (diagram.trees, diagram.files) == ({"MainTree": project.trees["MainTree"]}, {})
    (tmp_path / "t.xml").write_text(XML)
    assert open_version(str(tmp_path / "t.xml")).ids == frozenset()


def test_a_revision_of_a_stored_project(stored_place):
    new("Rover", template="laser_bump_and_go")
    assert open_version("Rover@1").trees.keys() == {"MainTree"}
    with pytest.raises(CliError, match="no revision 99"):
        open_version("Rover@99")


def test_what_cannot_be_read_is_said(tmp_path, stored_place):
    (tmp_path / "bad.json").write_text("[]")
    with pytest.raises(TranslatorError):
        open_version(str(tmp_path / "bad.json"))
    with pytest.raises(CliError, match="no such file"):
        open_version(str(tmp_path / "none.xml"))
