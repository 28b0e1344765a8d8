"""An evaluation as a RayJob: the program of our template, on a real Ray cluster, read by our collector."""

from __future__ import annotations

import json
import time
from pathlib import Path

import pytest

from backend.evaluations import queries, rounds, writes
from backend.projects.storage import writes as projects
from backend.sessions.lifecycle import writes as sessions
from backend.sessions.models import Session
from tests.backend.sessions.launchers.kubernetes.conftest import client, cluster, clusters  # noqa: F401
from tests.fakes.ray_operator import RayOperator

pytestmark = [pytest.mark.django_db(transaction=True), pytest.mark.simulation, pytest.mark.timeout(900)]
EXAMPLE = Path(__file__).parents[3] / "examples" / "laser_bump_and_go"
QUICK = b"""format: bt-studio/evaluation
version: 1
universe: walled_room
duration_s: 1
runs: 3
seed: 5
judge: {success: [{never: collision}]}
"""
LONGEST_S = 800


@pytest.fixture
def operator(
    cluster,  # noqa: F811
    clusters,  # noqa: F811
    settings_of,
    monkeypatch,
    tmp_path,
):
    """An operator of a cluster on which this server starts evaluations."""
    settings_of(launcher="kubernetes", evaluations="rayjob")
    monkeypatch.setattr(sessions, "launcher", lambda: clusters)
    with RayOperator(tmp_path) as running:
        cluster.operator = running.run
        yield running


def until(row, states):
    """Waits until a row has one of some states; rounds take place meanwhile."""
    end_s = time.monotonic() + LONGEST_S
    while row.state not in states:
        assert time.monotonic() < end_s, row.state
        rounds.one_round()
        time.sleep(0.2)
        row.refresh_from_db()


def test_an_evaluation_runs_on_the_ray_cluster_of_its_rayjob_and_ends_it(people, cluster, operator):  # noqa: F811
    found = writes.start(project_of(people).id, "quick", 0, acting_user=people.owner.user)
    until(found, {"done", "failed"})
    assert (found.state, found.error) == ("done", "")
    session = Session.objects.get()
    assert session.own_cluster
    until(session, {"ended", "failed"})
    assert (session.state, session.error) == ("ended", "")
    assert [program.wait(60) for program in operator.programs] == [0]
    assert found.workers == 1
    assert queries.known(found, found.revision) == [(seed, "success") for seed in (5, 6, 7)]
    assert [json.loads(line)["seed"] for line in queries.lines(found, found.revision)] == [5, 6, 7]
    assert not any(cluster.names(kind) for kind in ("pods", "rayjobs", "secrets", "networkpolicies"))


def project_of(people):
    files = {
        str(path.relative_to(EXAMPLE)): path.read_bytes() for path in EXAMPLE.rglob("*") if path.is_file()
    }
    files["evaluations/quick.yaml"] = QUICK
    return projects.create_project(files, acting_user=people.owner.user, name="Laser")
