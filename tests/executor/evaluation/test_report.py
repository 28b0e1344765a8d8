"""The page of a report: what it holds, and that foreign text cannot leave its block of data."""

import base64
import hashlib
import json
import re

from executor.evaluation.outcome import Outcome
from executor.evaluation.report import command_of, coverage_of, embedded, plan_of, report_data, report_html
from executor.evaluation.summary import Summary, pair
from executor.universes import parse_universe
from executor.universes.version import version_of
from tests.executor.evaluation.projects import WORLD

HOSTILE = "</script><img src=x onerror=alert(1)>\u2028&"


def report(**options):
    item = {"item": HOSTILE, "holds": False, "at_s": 1.0, "margin": -0.5, "unit": "m"}
    bump = [1.0, 0.5, 0.5, HOSTILE]
    outcomes = (
        Outcome(
            0, "success", measures={"m": 1.5}, seen={HOSTILE: "SR", "b": ""}, path=[[0, 0, 0], [1, 1, 1]]
        ),
        Outcome(
            1,
            "failure",
            HOSTILE,
            1.0,
            [item],
            {},
            {HOSTILE: 1},
            path=[[0, 0, 0]],
            bumps=[bump],
            seen={"b": "F"},
        ),
        Outcome(2, "crashed", HOSTILE),
    )
    summary = Summary(outcomes, 3)
    universe = parse_universe(WORLD)
    return report_data(summary, universe, project=HOSTILE, path="my project", evaluation=HOSTILE, **options)


def test_foreign_text_stays_in_its_block():
    page = report_html(report(gates=[(HOSTILE, False)], fingerprints=[HOSTILE]))
    assert HOSTILE not in page
    assert page.count("<script") == 2
    assert "<img" not in page
    [block] = re.findall(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)
    assert not set(block) & set("<>&\u2028\u2029")
    assert json.loads(block)["project"] == HOSTILE
    assert json.loads(embedded({"a": HOSTILE})) == {"a": HOSTILE}


def test_the_policy_allows_exactly_the_pages_own_script_and_style():
    page = report_html(report())
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)[1]
    assert policy.startswith("default-src 'none'; ")
    for name, pattern in (("script", r"<script>(.*)</script>"), ("style", r"<style>(.*)</style>")):
        text = re.search(pattern, page, re.DOTALL)[1]
        digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
        assert f"{name}-src 'sha256-{digest}'" in policy
    assert "img-src data:" in policy
    assert "unsafe" not in policy


def test_the_data_of_the_page():
    found = report()
    assert (found["successes"], found["counted"], found["complete"]) == (1, 3, True)
    assert found["measures"] == {"m": [[0, 1.5]]}
    assert [run["seed"] for run in found["worst"]] == [2, 1]
    assert found["runs"][1]["bumps"] == [[0.5, 0.5]]
    assert found["against"] is None
    assert found["worst"][1]["command"].startswith("bt-studio run 'my project' --evaluation ")
    assert command_of("p", "e", 7) == "bt-studio run p --evaluation e --seed 7 --record seed-7.mcap"


def test_coverage_counts_runs():
    found = coverage_of(
        [Outcome(0, "success", seen={"a": "SR", "b": ""}), Outcome(1, "success", seen={"a": "F"})]
    )
    assert found == [
        {"node": "a", "S": 1, "F": 1, "R": 1, "K": 0, "runs": 2},
        {"node": "b", "S": 0, "F": 0, "R": 0, "K": 0, "runs": 0},
    ]


def test_the_plan_of_the_world_has_outlines_and_areas():
    plan = plan_of(parse_universe(WORLD))
    assert len(plan["outlines"]) == 2  # wall and crate; the carpet is not solid
    assert plan["outlines"][0][0] == [2.9, -3.0]
    assert [area["name"] for area in plan["areas"]] == ["start", "ahead", "behind"]
    assert plan["universe"] == {"name": "Yard", "version": version_of(parse_universe(WORLD))}


def test_a_comparison_is_shown():
    older = [Outcome(0, "success"), Outcome(1, "failure")]
    newer = [Outcome(0, "failure"), Outcome(1, "failure")]
    found = report(pairs=pair(older, newer))["against"]
    assert found["only_older"] == (0,)
    assert "McNemar" in found["lines"][0]
