"""The behaviour tests of the examples and of the library; that they see faults; and what coverage counts."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from translator import load, to_ros2_package
from translator.archive import read_folder
from translator.behaviour_tests import leaf_model, paths_of_tests, to_job
from tree_gardener.testing import leaf_models
from tree_gardener.testing.job import Job

ROOT = Path(__file__).resolve().parents[2]
PROJECTS = ("examples/laser_bump_and_go", "examples/visual_follow_person", "backend/catalog/behaviours")
BY_HAND = {  # from the picture of *bump and go*, by a person
    "n1": {"ticked", "RUNNING"},
    "n2": {"ticked", "RUNNING", "SUCCESS", "branch 2 taken", "branch 2 not taken"},
    "n3": {"ticked", "SUCCESS", "FAILURE"},
    "n4": {"ticked", "SUCCESS", "FAILURE"},
    "n5": {"ticked", "RUNNING", "halted while RUNNING"},
    "n6": {"ticked", "RUNNING", "halted while RUNNING"},
}


def project(path="examples/laser_bump_and_go", **changes):
    files = dict(read_folder(ROOT / path))
    for name, (old, new) in changes.items():
        at = f"trees/{name}.json"
        assert old in files[at].decode()
        files[at] = files[at].replace(old.encode(), new.encode())
    return load(files)


def run(of):
    document, problems = to_job(of)
    job = Job.from_json(document)
    suite = job.suite()
    cases, wrong = job.cases(suite)
    assert [*problems, *wrong] == []
    results = [suite.run(case) for case in cases]
    coverage = suite.coverage(sorted({case.tree for case in cases}))
    for result in results:
        coverage.add_seen(result.seen)
    return results, coverage


@pytest.mark.parametrize("path", PROJECTS)
def test_the_tests_of_examples_and_library_pass_and_cover_their_trees(path):
    results, coverage = run(project(path))
    assert [str(failure) for result in results for failure in result.failures] == []
    assert coverage.missing() == []
    assert coverage.share == 1


def test_every_behaviour_of_the_library_is_tested():
    of = project("backend/catalog/behaviours")
    results, _ = run(of)
    assert {result.tree for result in results} == set(of.trees)


def test_the_coverage_of_bump_and_go_is_the_list_made_by_hand():
    _, coverage = run(project())
    (items,) = coverage.wanted.values()
    assert {node: set(found) for node, found in items.items()} == BY_HAND


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"ReactiveSequence"', '"Sequence"'),
        ('"ReactiveFallback"', '"Fallback"'),
        ('"ReactiveFallback"', '"ReactiveSequence"'),
        ('"Inverter"', '"ForceSuccess"'),
        ('"children": ["n2", "n6"]', '"children": ["n6", "n2"]'),
        ('"children": ["n3", "n5"]', '"children": ["n5", "n3"]'),
    ],
)
def test_a_seeded_fault_in_bump_and_go_is_caught(old, new):
    results, _ = run(project(MainTree=(old, new)))
    assert any(not result.passed for result in results)


def test_a_branch_that_no_test_reaches_is_seen_by_coverage():
    new = '"children": ["n3", "n5", "n7"]},\n    "n7": {"type": "AlwaysSuccess"}'
    results, coverage = run(project(MainTree=('"children": ["n3", "n5"]}', new)))
    assert all(result.passed for result in results)
    assert coverage.share < 1
    assert ("MainTree", "n2", "branch 2 not taken") not in coverage.missing()


def test_yaml_that_cannot_be_read_is_a_problem_with_its_line():
    of = load(
        {**read_folder(ROOT / PROJECTS[0]), "tests/x.test.yaml": b"a: &x 1\nb: *x\n", "tests/notes.md": b"x"}
    )
    assert paths_of_tests(of.files) == ["tests/bump_and_go.test.yaml", "tests/x.test.yaml"]
    _, [problem] = to_job(of)
    assert str(problem).startswith("tests/x.test.yaml:2:4: TG900 aliases")


def test_sources_travel_only_if_python_may_run():
    assert to_job(project())[0]["sources"] is None
    assert set(to_job(project(), real=True)[0]["sources"]) == {"CheckObstacle", "Forward", "Turn"}


def test_the_model_of_a_leaf_is_read_from_its_syntax_tree():
    model = leaf_model(project().actions["CheckObstacle"])
    assert (model["kind"], model["open"], model["returns"]) == ("Condition", False, ["FAILURE", "SUCCESS"])
    assert ["input", "obs_dist", "double", "1.0"] in model["ports"]
    assert leaf_models({"CheckObstacle": model})["CheckObstacle"].to_json()["returns"] == model["returns"]
    files = read_folder(ROOT / PROJECTS[0])
    source = files["actions/Turn.py"].replace(
        b"    INPUT_PORTS", b'    NODE_KIND = "SyncAction"\n    INPUT_PORTS'
    )
    assert leaf_model(load({**files, "actions/Turn.py": source}).actions["Turn"])["kind"] == "SyncAction"


def test_a_package_carries_its_tests(tmp_path):
    package = to_ros2_package(project())
    name = package.name
    assert b"<test_depend>python3-pytest</test_depend>" in package.files[f"{name}/package.xml"]
    assert b"extras_require={'test': ['pytest']}" in package.files[f"{name}/setup.py"]
    document = json.loads(package.files[f"{name}/test/behaviour_tests.json"])
    assert (document["xml"], document["sources"]) == ("", None)
    for path, raw in package.files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_bytes(raw)
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        "--rootdir",
        tmp_path,
        f"{name}/test",
    ]
    environment = {"PYTHONPATH": str(tmp_path / "tree_gardener"), "PATH": "/usr/bin:/bin"}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert "4 passed" in done.stdout, done.stdout + done.stderr
    broken = (tmp_path / name / "trees" / f"{name}.xml").read_text().replace("ReactiveSequence", "Sequence")
    (tmp_path / name / "trees" / f"{name}.xml").write_text(broken)
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "wanted" in done.stdout


def test_a_package_without_tests_asks_for_no_pytest():
    files = {
        path: raw for path, raw in read_folder(ROOT / PROJECTS[0]).items() if not path.startswith("tests/")
    }
    package = to_ros2_package(load(files))
    assert b"pytest" not in package.files[f"{package.name}/package.xml"]
    assert not any("/test/" in path and path.startswith(package.name) for path in package.files)


WAY_IS_FREE = {  # what its first test reaches, by hand
    "n1": {"ticked", "RUNNING"},
    "n2": {"ticked", "SUCCESS", "branch 2 not taken"},
    "n3": {"ticked", "SUCCESS"},
    "n4": {"ticked", "FAILURE"},
    "n6": {"ticked", "RUNNING"},
}


def test_a_test_of_bump_and_go_reaches_what_was_listed_by_hand():
    job = Job.from_json(to_job(project())[0])
    suite = job.suite()
    seen = suite.run(job.cases(suite)[0][0]).seen["MainTree"]
    assert {node: set(items) for node, items in seen.items()} == WAY_IS_FREE


def test_a_package_with_tests_has_a_workflow_that_installs_what_it_needs():
    files = dict(read_folder(ROOT / PROJECTS[0]))
    steps = workflow_of(files)
    assert not any("pip install" in step for step in steps)
    steps = workflow_of({**files, "requirements.txt": b"numpy\n"})
    assert any(step.endswith("-r src/laser_bump_and_go/requirements.txt") for step in steps)
    untested = {path: raw for path, raw in files.items() if not path.startswith("tests/")}
    assert not any(path.startswith(".github") for path in to_ros2_package(load(untested)).files)


def workflow_of(files):
    package = to_ros2_package(load(files))
    [job] = yaml.safe_load(package.files[f".github/workflows/{package.name}.yml"])["jobs"].values()
    return [step["run"] for step in job["steps"] if "run" in step]
