"""The editor's template of an action that drives, in a simulated world."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
TEMPLATE = ROOT / "frontend" / "src" / "features" / "code" / "templates" / "drive.py"
DRIVE = TEMPLATE.read_text(encoding="utf-8").replace("NewAction", "Drive")
RUN = """
import json
import sys
from executor.headless.lockstep import LockstepOptions, run_lockstep
xml = sys.stdin.read().encode()
options = LockstepOptions(universe="empty", duration_s=4, outlasts_tree=True)
json.dump(run_lockstep({"self_contained_tree.xml": xml}, options).to_json(), sys.stdout)
"""


def driven(tree: str) -> dict[str, Any]:
    """Runs a tree for 4 s in the empty world, and returns the report of the run."""
    code = f"<Code><Action name='Drive'><![CDATA[{DRIVE}]]></Action></Code>"
    xml = f"<root BTCPP_format='4'><BehaviorTree ID='Main'>{tree}</BehaviorTree>{code}</root>"
    done = subprocess.run(
        [sys.executable, "-c", RUN],
        input=xml,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=200,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    report: dict[str, Any] = json.loads(done.stdout)
    assert report["errors"] == []
    return report


@pytest.mark.parametrize(
    ("tree", "status"),
    [
        ("<Drive seconds='2' speed='0.2'/>", "SUCCESS"),
        ("<Timeout msec='2000'><Drive seconds='60' speed='0.2'/></Timeout>", "FAILURE"),
    ],
    ids=["at its end", "when it is halted"],
)
def test_the_robot_drives_for_its_seconds_and_stops(tree: str, status: str) -> None:
    report = driven(tree)
    assert report["root_status"] == status
    # With the way in which it gets fast and slow: 2 s of 4, so it stands in the rest.
    assert report["distance_m"] == pytest.approx(0.4, abs=0.06)
    before, last = report["trajectory"][-6], report["trajectory"][-1]
    assert before[1:3] == pytest.approx(last[1:3], abs=1e-3)


def test_it_turns_too() -> None:
    last = driven("<Drive seconds='1' speed='0' turn='0.5'/>")["trajectory"][-1]
    assert last[-1] == pytest.approx(0.5, abs=0.1)
