"""Launch files that BT Studio reads itself mean what the real `launch` makes of them."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from executor.launching.reader import read_launch_files
from executor.universes.document import DocumentError
from tests.ros_launch.conftest import of_launch

pytestmark = pytest.mark.timeout(600)

HERE = Path(__file__).parent
CASES = {case["name"]: case for case in json.loads((HERE / "cases.json").read_text())}
PACKAGE, PROGRAM = "talker_pkg", "talk"
CHILD = f'<node pkg="{PACKAGE}" exec="{PROGRAM}" name="kid" args="{{}}"/>'
BESIDE = {
    "inc/child.xml": f'<launch><arg name="v" default="child"/>{CHILD.format("$(var v)")}</launch>',
    "inc/push.xml": f'<launch><push_ros_namespace namespace="pushed"/>{CHILD.format("x")}</launch>',
    "inc/req.xml": f'<launch><arg name="r"/>{CHILD.format("$(var r)")}</launch>',
    "inc/child.yaml": "launch:\n- arg: {name: v, default: child}\n"
    f'- node: {{pkg: {PACKAGE}, exec: {PROGRAM}, name: kid, args: "$(var v)"}}\n',
}


def text_of(case):
    """Returns the file of a case; `<talk` and `TALK` stand for a node of the package."""
    if case["format"] == "xml":
        body = case["body"].replace("<talk", f'<node pkg="{PACKAGE}" exec="{PROGRAM}"')
        return f"<launch>{body.replace('.launch.', '.')}</launch>"
    body = case["body"]
    for between in (", ", "\n    "):
        body = body.replace(f"{{TALK{between}", f"{{pkg: {PACKAGE}, exec: {PROGRAM}{between}")
        body = body.replace(f"    TALK{between}", f"    pkg: {PACKAGE}\n    exec: {PROGRAM}{between}")
    body = body.replace("{TALK}", f"{{pkg: {PACKAGE}, exec: {PROGRAM}}}")
    return f"launch:\n{body.replace('.launch.', '.')}"


def described(words, files):
    """Returns what a command line says: program, arguments, rules of names, and typed parameters."""
    program, *rest = words
    arguments, rules, values, others = [], [], {}, []
    given = iter(rest)
    for word in given:
        if word == "--ros-args":
            break
        arguments.append(word)
    for word in given:
        if word == "-r":
            rules.append(next(given))
        elif word == "-p":
            name, _, text = next(given).partition(":=")
            values[name] = repr(yaml.safe_load(text))
        elif word == "--ros-args":
            continue
        elif word == "--params-file":
            for node in files[next(given)].values():
                values |= flat("", node["ros__parameters"])
        else:
            others.append(word)
    return Path(program).name, arguments, sorted(rules), values, others


def flat(before, values):
    found: dict[str, str] = {}
    for name, value in values.items():
        found |= flat(f"{before}{name}.", value) if isinstance(value, dict) else {before + name: repr(value)}
    return found


@pytest.fixture(scope="module")
def answers(workspace):
    """What `launch` would start for each case; null where it refuses the file."""
    prefix = workspace / "talker"
    for path in (f"lib/{PACKAGE}/{PROGRAM}", f"share/ament_index/resource_index/packages/{PACKAGE}"):
        (prefix / path).parent.mkdir(parents=True, exist_ok=True)
        (prefix / path).write_text("#!/bin/sh\n")
        (prefix / path).chmod(0o755)
    (prefix / "share" / PACKAGE).mkdir()
    for name, case in CASES.items():
        folder = workspace / "cases" / name / "launch"
        for path, text in {**BESIDE, f"m.launch.{case['format']}": text_of(case)}.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text)
    paths = [str(next(path.glob("launch/m.launch.*"))) for path in folders(workspace)]
    script = (
        f'source "{workspace}/install/setup.bash" && export AMENT_PREFIX_PATH="{prefix}:$AMENT_PREFIX_PATH"'
    )
    done = subprocess.run(
        ["bash", "-c", f'{script} && exec "$@"', "bash", sys.executable, str(HERE / "described.py")],
        input=json.dumps(paths),
        env=of_launch(workspace),
        capture_output=True,
        text=True,
        check=False,
    )
    found = [line for line in done.stdout.splitlines() if line.startswith("answer ")]
    assert found, done.stderr
    return dict(zip(CASES, json.loads(found[-1].removeprefix("answer ")), strict=True))


def folders(workspace):
    return [workspace / "cases" / name for name in CASES]


@pytest.mark.parametrize("name", CASES)
def test_a_launch_file_means_what_launch_makes_of_it(answers, workspace, monkeypatch, name):
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(workspace / "talker"))
    monkeypatch.setenv("HOME", str(workspace))
    try:
        plan = read_launch_files(workspace / "cases" / name)
        ours = [(described(node.command, {}), sorted(map(list, node.environment))) for node in plan.nodes]
    except DocumentError:
        ours = None
    theirs = answers[name]
    if theirs is not None:
        theirs = [(described(each["words"], each["files"]), each["environment"]) for each in theirs]
    assert ours == theirs
