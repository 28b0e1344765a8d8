"""Plays of events on three hosts with the product's keepers: whatever is lost, no session runs twice.

Requests and answers are lost, hosts are cut off and come back, web servers restart, and time passes. The
keepers are real, and so are the rows; links and clocks are the play's.
"""

from __future__ import annotations

import random
import tempfile
from contextlib import ExitStack, suppress
from pathlib import Path

import pytest

from backend.sessions import maintenance
from backend.sessions.hosts.dial import NotReachedError
from backend.sessions.launchers.docker import DockerLauncher
from backend.sessions.launchers.hosts import LOCAL, HostsLauncher
from backend.sessions.lifecycle import writes
from backend.sessions.models import Session
from tests.backend.sessions.keeper.conftest import Host
from tests.backend.sessions.lifecycle.test_writes import launched
from tests.budget import seeds

pytestmark = [pytest.mark.django_db(transaction=True), pytest.mark.timeout(900)]
ROUND_S = 5.0
SILENCE_S = 120.0
EVENTS = 40
PROJECTS = 4


class PlayedLauncher(DockerLauncher):
    """A further host, whose link the play cuts."""

    name = "docker"

    def __init__(self, host, clock):
        super().__init__(host.folder)
        self.host = host
        self._clock = clock
        self.is_cut = False
        self.loses = ""
        self.heard_s = clock()

    def request(self, method, target, body, timeout_s):
        if self.is_cut:
            raise NotReachedError("cut off")
        loses, self.loses = self.loses, ""
        if loses == "request":
            raise TimeoutError("lost on the way")
        if (method, target) == ("GET", "/sessions"):
            self.heard_s = self._clock()
        found = super().request(method, target, body, timeout_s)
        if loses == "answer":
            raise TimeoutError("lost on the way back")
        return found


class Play:
    """Three hosts, one web server, and users who start and end sessions."""

    def __init__(self, stack, api, monkeypatch, seed):
        self.random = random.Random(seed)  # noqa: S311 - a play is repeated by its seed
        self.now_s = 1000.0
        self._api = api
        self._stack = stack
        self._monkeypatch = monkeypatch
        self._launcher = None
        self.local = self._host(1)
        self.further = [self._host(places, silence_s=SILENCE_S) for places in (2, 3)]
        self.links = {f"h{n}": PlayedLauncher(host, self.clock) for n, host in enumerate(self.further)}
        self.projects = [api.post("projects", {"name": f"P{n}"}, expect=201)["id"] for n in range(PROJECTS)]
        self.restart()

    def clock(self):
        return self.now_s

    def _host(self, places, **options):
        folder = Path(self._stack.enter_context(tempfile.TemporaryDirectory()))
        host = Host(folder, "good", places, 60, clock=self.clock, **options)
        self._stack.callback(host.close)
        return host

    def restart(self):
        """The web server is started again, and knows only the database."""
        if self._launcher is not None:
            self._launcher.close()
        hosts = {LOCAL: DockerLauncher(self.local.folder), **self.links}
        self._launcher = HostsLauncher(hosts, self.clock)
        self._monkeypatch.setattr(writes, "launcher", lambda: self._launcher)
        maintenance.begin()

    def start(self):
        made = self._api.post(f"projects/{self.random.choice(self.projects)}/session")
        launched(made["id"])

    def end(self):
        live = list(Session.objects.filter(state="ready"))
        if live:
            self._api.delete(f"sessions/{self.random.choice(live).id}")

    def cut_or_heal(self):
        link = self.random.choice(list(self.links.values()))
        link.is_cut = not link.is_cut

    def lose(self):
        self.random.choice(list(self.links.values())).loses = self.random.choice(["request", "answer"])

    def wait(self):
        for _ in range(self.random.choice([1, 3, 8, 30])):
            self.rounds(1)

    def rounds(self, number, **options):
        for _ in range(number):
            self.now_s += ROUND_S
            maintenance.maintain(**options)
            for session in Session.objects.filter(state="starting"):
                launched(str(session.id))
            for host in self.further:
                host.keeper.end_unheard()

    def step(self):
        events = [self.start] * 6 + [
            self.end,
            self.cut_or_heal,
            self.cut_or_heal,
            self.lose,
            self.wait,
            self.restart,
        ]
        self.random.choice(events)()
        self.check()

    def running(self):
        """The host of each executor that runs."""
        found: dict[str, list[str]] = {}
        hosts = {LOCAL: self.local, **{name: link.host for name, link in self.links.items()}}
        for name, host in hosts.items():
            for one in list(host.docker.containers.values()):
                if one["State"]["Running"]:
                    found.setdefault(one["Labels"]["org.bt-studio.session"], []).append(name)
        return found

    def check(self):
        running = self.running()
        assert all(len(hosts) == 1 for hosts in running.values()), running
        for link in self.links.values():
            if self.now_s - link.heard_s > SILENCE_S + ROUND_S:
                assert [one for one in link.host.docker.containers.values() if one["State"]["Running"]] == []
        for session in Session.objects.filter(state="failed"):
            assert session.error

    def check_in_the_end(self):
        for link in self.links.values():
            link.is_cut, link.loses = False, ""
        self.rounds(3, is_for_orphans=True)
        ready = {str(one.id): [one.host] for one in Session.objects.filter(state="ready")}
        assert self.running() == ready

    def close(self):
        for session in Session.objects.filter(state="ready"):
            with suppress(AssertionError):
                self._api.delete(f"sessions/{session.id}")
        self._launcher.close()


@pytest.mark.parametrize("seed", seeds("hosts_play"))
def test_no_session_runs_twice_whatever_is_lost(seed, api, monkeypatch):
    with ExitStack() as stack:
        play = Play(stack, api, monkeypatch, seed)
        stack.callback(play.close)
        for _ in range(EVENTS):
            play.step()
        play.check_in_the_end()
