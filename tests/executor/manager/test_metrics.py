"""The metrics of a session's manager, as a reader of Prometheus' format finds them."""

from __future__ import annotations

from prometheus_client.parser import text_string_to_metric_families

from executor.manager.metrics import metrics_text
from executor.manager.server import Traffic
from executor.session.ladder import State
from executor.session.protocol import Session
from executor.session.stage import About

# Dashboards and alerts of users go by these.
COUNTERS = {"commands_total", "commands_refused_total", "events_total", "frames_total", "snapshots_total"}
GAUGES = {
    *("clients", "streams", "faults", "ticks", "tick_seconds", "simulated_seconds", "speed_wanted"),
    *("real_time_factor", "children", "open_descriptors", "memory_bytes"),
}


def test_the_page_has_the_same_series_as_ever():
    text = metrics_text(Session(About(version="test")), Traffic(clients=2, refusals=5))
    found = {
        (sample.name.removeprefix("bt_studio_"), sample.labels.get("state", "")): (family.type, sample.value)
        for family in text_string_to_metric_families(text)
        for sample in family.samples
    }
    kinds = {key: kind for key, (kind, _) in found.items()}
    assert kinds == {
        **{("session_state", str(state)): "gauge" for state in State},
        **{(name, ""): "gauge" for name in GAUGES},
        **{(name, ""): "counter" for name in COUNTERS},
    }
    assert found["session_state", "idle"][1] == 1
    assert found["clients", ""][1] == 2
    assert found["commands_refused_total", ""][1] == 5
