"""The number of web workers."""

from __future__ import annotations

import pytest

from backend.config import worker_count
from backend.config.environment import environment
from backend.config.server import ServeError
from backend.config.worker_count import CONNECTIONS, SPARE, judge_workers, too_little_memory, workers_of
from tests.backend.config.test_team import WHOLE


@pytest.fixture
def machine(monkeypatch, settings_of):
    """A team's server with this many cores and connections to its database."""

    def make(cores, connections=100, memory=None, **changes):
        settings_of(**(WHOLE | {"unsafe_users_run_as_server": "true"} | changes))
        monkeypatch.setattr(worker_count, "cores", lambda: cores)
        monkeypatch.setattr(worker_count, "limit_mib", lambda: memory)
        monkeypatch.setattr(worker_count, "admitted_connections", lambda _: connections)
        return environment()

    return make


@pytest.mark.parametrize(("cores", "workers"), [(1, 1), (2, 1), (4, 3), (32, 9)])
def test_a_team_server_leaves_a_core_to_others_and_the_database_its_connections(machine, cores, workers):
    assert workers_of(machine(cores)) == workers


def test_one_worker_serves_where_there_can_be_one_only(machine):
    for changes in ({"launcher": "process"}, {"database_url": "sqlite:////data/bts"}, {"mode": "local"}):
        settings = machine(8, **changes)
        judge_workers(settings)
        assert workers_of(settings) == 1


def test_as_many_serve_as_fit_into_the_memory_of_the_container(machine):
    settings = machine(8, memory=6420)
    assert workers_of(settings) == 5
    assert workers_of(machine(8, memory=6419)) == 4
    assert too_little_memory(settings) == ""


@pytest.mark.parametrize(
    ("memory", "changes"), [(1024, {}), (6144, {"workers": 8}), (8192, {"work_processes": 12})]
)
def test_a_container_with_too_little_memory_is_warned_about(machine, memory, changes):
    warning = too_little_memory(machine(8, memory=memory, **changes))
    assert f"its container has {memory} MiB" in warning
    assert "BT_STUDIO_WORK_PROCESSES" in warning
    assert too_little_memory(machine(8, **changes)) == ""


def test_as_many_workers_serve_as_are_set(machine):
    assert workers_of(machine(2, workers=1)) == 1
    assert workers_of(machine(2, workers=5)) == 5
    assert workers_of(machine(2, workers=5, connections=5 * CONNECTIONS + SPARE)) == 5
    with pytest.raises(ServeError, match="max_connections of PostgreSQL, or use --workers 4"):
        workers_of(machine(2, workers=5, connections=5 * CONNECTIONS + SPARE - 1))


@pytest.mark.parametrize(
    ("changes", "remedy"),
    [
        ({"mode": "local"}, "BT_STUDIO_MODE=team"),
        ({"database_url": "sqlite:////data/bts"}, "BT_STUDIO_DATABASE_URL=postgresql"),
        ({"launcher": "process"}, "BT_STUDIO_LAUNCHER=docker"),
    ],
)
def test_several_are_refused_with_what_to_do(machine, changes, remedy):
    with pytest.raises(ServeError, match=remedy):
        judge_workers(machine(8, workers=2, **changes))
