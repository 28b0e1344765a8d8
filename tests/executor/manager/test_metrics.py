"""The metrics of a manager."""

from __future__ import annotations

from executor.manager.metrics import Traffic, metrics_text
from executor.session.ladder import State
from tests.executor.session.play import Play


def test_every_metric_has_its_help_and_type_and_a_number() -> None:
    text = metrics_text(Play().session, Traffic(clients=2))
    lines = text.splitlines()
    assert "bt_studio_clients 2" in lines
    assert sum(line.startswith("bt_studio_session_state{") for line in lines) == len(State)
    names = {line.split()[2] for line in lines if line.startswith("# HELP")}
    assert names == {line.split()[2] for line in lines if line.startswith("# TYPE")}
    for line in lines:
        if not line.startswith("#"):
            float(line.rpartition(" ")[2])
