"""Metrics of the manager, in Prometheus' text format."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Final

from prometheus_client import CONTENT_TYPE_PLAIN_0_0_4, CollectorRegistry, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily

from executor.session.ladder import State

if TYPE_CHECKING:
    from collections.abc import Iterator

    from prometheus_client import Metric

    from executor.manager.server import Traffic
    from executor.session.protocol import Session

__all__ = ["CONTENT_TYPE", "metrics_text"]

CONTENT_TYPE: Final = CONTENT_TYPE_PLAIN_0_0_4


class _Manager:
    """Collects the metrics of one session when they are requested."""

    def __init__(self, session: Session, traffic: Traffic) -> None:
        self._session, self._traffic = session, traffic

    def collect(self) -> Iterator[Metric]:
        yield from self._of_traffic()
        yield from self._of_the_run()
        yield from self._of_the_process()

    def _of_traffic(self) -> Iterator[Metric]:
        traffic = self._traffic
        state = GaugeMetricFamily(
            "bt_studio_session_state", "The rung on which the ladder stands.", labels=["state"]
        )
        for rung in State:
            state.add_metric([rung], int(rung is self._session.state))
        yield state
        yield GaugeMetricFamily("bt_studio_clients", "Clients that are connected.", traffic.clients)
        yield GaugeMetricFamily("bt_studio_streams", "Clients that are sent frames.", traffic.streams)
        yield CounterMetricFamily("bt_studio_commands_total", "Commands that came.", traffic.commands)
        yield CounterMetricFamily(
            "bt_studio_commands_refused_total", "Commands answered with an error.", traffic.refusals
        )
        yield CounterMetricFamily(
            "bt_studio_events_total", "Events sent, once for all clients.", traffic.events
        )
        yield CounterMetricFamily("bt_studio_frames_total", "Frames that the world sent.", traffic.frames)
        yield CounterMetricFamily(
            "bt_studio_snapshots_total", "Snapshots for clients too slow.", traffic.snapshots
        )

    def _of_the_run(self) -> Iterator[Metric]:
        mirror = self._session.mirror
        yield GaugeMetricFamily("bt_studio_faults", "Faults of this run.", len(mirror.faults))
        yield GaugeMetricFamily("bt_studio_ticks", "Ticks of this run.", mirror.tick)
        yield GaugeMetricFamily(
            "bt_studio_tick_seconds", "How long a tick takes of late.", mirror.tick_ms / 1000
        )
        yield GaugeMetricFamily("bt_studio_simulated_seconds", "Simulated time.", self._session.sim_time_s)
        yield GaugeMetricFamily("bt_studio_speed_wanted", "Requested real-time factor.", mirror.speed)
        yield GaugeMetricFamily("bt_studio_real_time_factor", "Of the last second.", mirror.real_time_factor)

    def _of_the_process(self) -> Iterator[Metric]:
        children = len(self._session.children.living)
        yield GaugeMetricFamily("bt_studio_children", "World, application and those that wait.", children)
        descriptors = len(list(Path("/proc/self/fd").iterdir()))
        yield GaugeMetricFamily("bt_studio_open_descriptors", "Of the manager.", descriptors)
        yield GaugeMetricFamily("bt_studio_memory_bytes", "Resident, of the manager.", _resident_bytes())


def metrics_text(session: Session, traffic: Traffic) -> str:
    """Returns all metrics of a session."""
    registry = CollectorRegistry()
    registry.register(_Manager(session, traffic))
    return generate_latest(registry).decode()


def _resident_bytes() -> int:
    return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE")
