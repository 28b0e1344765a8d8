"""Evaluations over HTTP."""

from __future__ import annotations

import json
from pathlib import Path

from backend.evaluations import views
from backend.evaluations.executor_events import Done
from backend.evaluations.models import Evaluation
from backend.projects.storage import writes as projects
from backend.projects.storage.changes import Content, FileChange
from tests.backend.evaluations.conftest import begin, done, line, store
from translator.archive import read_folder

ROOT = Path(__file__).resolve().parents[3]


def address(people):
    return f"projects/{people.project.id}/evaluations"


def test_an_evaluation_is_started_looked_at_cancelled_and_deleted(people, monkeypatch):
    rounds = []
    monkeypatch.setattr(views, "round_soon", lambda: rounds.append(1))
    by, at = people.owner, address(people)
    made = by.post(at, {"name": "room", "runs": 3}, expect=201)
    assert (made["state"], made["revision"], Evaluation.objects.get().runs) == ("waiting", 1, 3)
    listed = people.viewer.get(at)
    assert [row["id"] for row in listed["items"]] == [made["id"]]
    assert (listed["may_start"], listed["may_replay"], listed["why_not"]) == (False, True, "")
    assert by.get(at)["may_start"]
    assert by.post(f"{at}/{made['id']}/cancel")["state"] == "cancelled"
    assert by.post(f"{at}/{made['id']}/resume")["state"] == "waiting"
    by.delete(f"{at}/{made['id']}")
    assert by.get(at)["items"] == []


def test_outcomes_are_read_on_from_a_cursor(people):
    at = address(people)
    made = people.owner.post(at, {"name": "room"}, expect=201)
    found = Evaluation.objects.get()
    begin(found)
    store(found, done(0), done(1, "failure"))
    own = f"{at}/{made['id']}"
    first = people.viewer.get(f"{own}/outcomes")
    assert [row["outcome"] for row in first["items"]] == ["success", "failure"]
    store(found, done(2))
    second = people.viewer.get(f"{own}/outcomes?after={first['cursor']}")
    assert [row["seed"] for row in second["items"]] == [2]
    assert people.viewer.get(f"{own}/outcomes/1")["outcome"] == json.loads(line(1, "failure"))
    people.viewer.get(f"{own}/outcomes/7", expect=404)
    people.viewer.get(f"{own}/outcomes?revision=2", expect=404)
    answer = people.viewer.client.get(f"/api/v1/{own}/runs.jsonl")
    assert answer.getvalue().decode().splitlines() == [line(0), line(1, "failure"), line(2)]
    headers = answer.headers
    assert headers["Content-Disposition"].startswith("attachment")
    assert headers["X-Content-Type-Options"] == "nosniff"


def test_a_sealed_one_says_so_and_the_list_has_what_runs_cost(people):
    at = address(people)
    assert people.owner.post(at, {"name": "room", "sealed": True}, expect=201)["sealed"]
    made = people.owner.post(at, {"name": "room"}, expect=201)
    assert (made["sealed"], made["waits_for"]) == (False, "turn")
    assert people.viewer.get(at)["costs"] == []
    found = Evaluation.objects.get(id=made["id"])
    begin(found)
    store(found, done(0))
    assert people.viewer.get(at)["costs"] == [{"name": "room", "cpu_s": 3.0, "workers": 2}]
    people.owner.post(at, {"name": "room", "sealed": "perhaps"}, expect=422)


def test_a_query_that_is_no_query_is_refused_with_its_field(people):
    at = address(people)
    made = people.owner.post(at, {"name": "room"}, expect=201)
    own = f"{at}/{made['id']}"
    for query, name in (("after=x%27", "after"), ("after=-1", "after"), (f"after={2**63}", "after")):
        assert people.viewer.get(f"{own}/outcomes?{query}", expect=422)["field"] == name
    for place in ("outcomes", "outcomes/1", "runs.jsonl"):
        found = people.viewer.get(f"{own}/{place}?revision={10**30}", expect=422)
        assert found["field"] == "revision"
    for seed in (2**63, 10**30):
        people.viewer.get(f"{own}/outcomes/{seed}", expect=404)
        people.owner.post(f"{own}/replays", {"revision": 1, "seed": seed}, expect=422)


def test_a_wish_that_is_no_wish_is_refused(people):
    at = address(people)
    for bad in ({}, {"name": "room", "runs": -1}, {"name": "room", "runs": "3"}, {"name": "room", "x": 1}):
        people.owner.post(at, bad, expect=422)
    people.owner.post(at, {"name": "rom"}, expect=422)
    people.viewer.post(at, {"name": "room"}, expect=403)


def test_the_coverage_joins_what_all_runs_of_a_revision_have_seen(people):
    at = address(people)
    example = read_folder(ROOT / "examples/laser_bump_and_go")
    change = [
        FileChange(path, 1 if path.startswith("trees/") else 0, Content.of(data))
        for path, data in example.items()
        if path.startswith(("trees/", "actions/"))
    ]
    projects.save_files(people.project.id, change, acting_user=people.owner.user)
    made = people.owner.post(at, {"name": "room"}, expect=201)
    found = Evaluation.objects.get()
    begin(found)
    own = f"{at}/{made['id']}/coverage"
    assert people.viewer.get(own)["share"] == 0
    seen = [{"Turn::5": "R", "bump and go": "R"}, {"Forward::6": "R"}]
    for seed, each in enumerate(seen):
        store(found, Done("a1", seed, line(seed, seen=each), 3.0, 1, 4, 1.0, 0.2, 1.0, 9.0))
    nodes = people.viewer.get(own)["trees"]["MainTree"]["nodes"].values()
    ticked = {node["name"] for node in nodes if node["items"]["ticked"]}
    assert ticked == {"bump and go", "Turn", "Forward"}
    people.viewer.get(f"{own}?revision=7", expect=404)
