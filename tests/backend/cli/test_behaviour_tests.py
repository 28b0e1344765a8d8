"""`bt-studio test`: what it prints and writes, and its exit statuses."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from backend.cli.behaviour_tests import junit_xml, run_tests
from backend.cli.shared.errors import CliError
from tree_gardener.errors import Diagnostic
from tree_gardener.testing import Failure, Result

ROOT = Path(__file__).resolve().parents[3]
FILE = "tests/bump_and_go.test.yaml"


@pytest.fixture
def project(tmp_path):
    shutil.copytree(ROOT / "examples" / "laser_bump_and_go", tmp_path / "project")
    return tmp_path / "project"


def test_an_example_passes_and_is_covered(project, capsys, tmp_path):
    run_tests(str(project), junit=tmp_path / "j.xml", coverage=tmp_path / "c.json")
    out = capsys.readouterr().out
    assert f"passed  {FILE}:4: drives ahead while the way is free" in out
    assert "3 passed, 0 failed, 124 ticks" in out
    assert "100% of the trees covered" in out
    [suite] = ET.fromstring((tmp_path / "j.xml").read_bytes())  # noqa: S314 - our own
    assert (suite.get("tests"), suite.get("failures"), len(suite)) == ("3", "0", 3)
    coverage = json.loads((tmp_path / "c.json").read_text())
    assert coverage["share"] == 1.0
    assert len(coverage["tests"]) == 3
    assert coverage["tests"][0]["reached"]["MainTree"]["n6"] == ["RUNNING", "ticked"]


def test_a_failure_names_everything_and_ends_with_status_1(project, capsys, tmp_path):
    tree = project / "trees" / "MainTree.json"
    tree.write_text(tree.read_text().replace('"ReactiveSequence"', '"Sequence"'))
    with pytest.raises(CliError) as ended:
        run_tests(str(project), "does not drive", junit=tmp_path / "j.xml")
    assert ended.value.status == 1
    out = capsys.readouterr().out
    assert "FAILED  tests/bump_and_go.test.yaml:14: turns while something is near" in out
    assert f"{FILE}:22: tick 6 (0.25 s): 'Turn::5' [MainTree n5]: status after the tick" in out
    assert "wanted RUNNING, got IDLE" in out
    assert "bump and go RUNNING > keep clear" in out
    [case] = ET.fromstring((tmp_path / "j.xml").read_bytes())[0]  # noqa: S314 - our own
    assert "tick 6" in case[0].get("message")


def test_json_holds_all_of_it(project, capsys):
    (project / "tests" / "wrong.test.yaml").write_text("format: x\n")
    with pytest.raises(CliError):
        run_tests(str(project), as_json=True)
    document = json.loads(capsys.readouterr().out)
    assert (document["passed"], document["failed"]) == (3, 0)
    assert document["problems"][0]["file"] == "tests/wrong.test.yaml"


def test_a_file_that_cannot_be_read_is_said_with_its_line(project):
    (project / "tests" / "wrong.test.yaml").write_text("format: bt-studio/test\nversion: 2\ntests: []\n")
    with pytest.raises(CliError, match=r"tests/wrong\.test\.yaml:2:1: TG901 the version is not 1"):
        run_tests(str(project))


def test_no_test_at_all_is_a_bad_argument(project):
    with pytest.raises(CliError, match="no test has 'nothing'") as ended:
        run_tests(str(project), "nothing")
    assert ended.value.status == 2
    shutil.rmtree(project / "tests")
    with pytest.raises(CliError, match="there are no tests"):
        run_tests(str(project))


def test_a_project_with_errors_is_not_tested(project):
    (project / "trees" / "MainTree.json").write_text("{}")
    with pytest.raises(CliError, match="BT0"):
        run_tests(str(project))


def test_a_real_leaf_runs_in_another_process(project, capsys):
    (project / "actions" / "Turn.py").write_text(
        "import os\nimport py_trees\n\n\nclass Turn(py_trees.behaviour.Behaviour):\n"
        "    def update(self):\n        os._exit(3)\n"
    )
    text = "    doubles: {CheckObstacle: SUCCESS, Turn: real, Forward: RUNNING}\n    ticks: 1\n"
    (project / FILE).write_text(
        "format: bt-studio/test\nversion: 1\ntests:\n  - name: hostile\n"
        f"{text}    expect: [{{at: 1, root: RUNNING}}]\n"
    )
    with pytest.raises(CliError):
        run_tests(str(project))
    assert "the process of the test ended before its result" in capsys.readouterr().out


def test_junit_takes_any_text():
    result = Result("a\x00<b>", "f", 1, "T", (Failure("x\x1b]]>&"),))
    problem = Diagnostic("TG900", "bad\x07", file="g")
    root = ET.fromstring(junit_xml([result], [problem]))  # noqa: S314 - our own
    assert root[0].get("errors") == "1"
    assert root[0][0].get("name") == "a\ufffd<b>"
    assert root[0][0][0].get("message") == "x\ufffd]]>&"
