"""Hosts: each has a gate, a keeper and a relay in processes of their own, and a stand-in for Docker."""

from __future__ import annotations

import signal
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path

import pytest

from backend.config.environment import environment
from backend.sessions.hosts.authority import WEB_BUNDLE, host_bundle, renew_web_bundle
from backend.sessions.hosts.dial import web_bundle
from backend.sessions.hosts.names import HostAddress, read_host
from backend.sessions.launchers.docker import DockerLauncher
from backend.sessions.launchers.hosts import LOCAL, HostsLauncher
from backend.sessions.launchers.relayed import RelayedLauncher
from tests.backend.services import free_port
from tests.backend.sessions.relay.conftest import relay
from tests.e2e.server import wait_until
from tests.fakes.docker import FakeDocker

ROOT = Path(__file__).parents[4]


class Host:
    """The programs of one host, below a folder with a short name."""

    def __init__(self, stack, authority, name, **settings):
        self.folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        self.address = HostAddress(name, free_port())
        self._stack = stack
        doors, self.keeper_folder = self.folder / "doors", self.folder / "keeper"
        self.keeper_folder.mkdir()
        bundle = self.folder / "host.pem"
        bundle.write_text(host_bundle(authority, name))
        self.docker = FakeDocker(self.folder / "docker.sock", doors)
        stack.callback(self.docker.close)
        self._environment = {
            "BT_STUDIO_GATE_FOLDER": str(doors),
            "BT_STUDIO_GATE_CONTROL": str(self.folder / "control" / "gate.sock"),
            "BT_STUDIO_KEEPER_FOLDER": str(self.keeper_folder),
            "BT_STUDIO_DOCKER_SOCKET": str(self.folder / "docker.sock"),
            "BT_STUDIO_EXECUTOR_IMAGE": "good",
            "BT_STUDIO_STACK": "stack",
            "BT_STUDIO_RELAY_BUNDLE": str(bundle),
            "BT_STUDIO_RELAY_HOST": name,
            "BT_STUDIO_RELAY_PORT": str(self.address.port),
            **settings,
        }
        self.processes = {}
        for program in ("gate", "keeper", "relay"):
            self.start(program)
        self.launcher = RelayedLauncher(self.address)
        wait_until(self.answers, f"the keeper of {name} answers")

    def start(self, program):
        log = self._stack.enter_context((self.folder / f"{program}.log").open("ab"))
        made = subprocess.Popen(
            [sys.executable, "-m", f"backend.sessions.{program}"], env=self._environment, cwd=ROOT, stderr=log
        )
        self.processes[program] = made
        self._stack.callback(self._end, made)

    @staticmethod
    def _end(process):
        process.send_signal(signal.SIGCONT)
        process.terminate()
        process.wait(60)

    def kill(self, program):
        self.processes[program].kill()
        self.processes[program].wait(60)

    def restart_keeper(self, **settings):
        self.kill("keeper")
        self._environment |= settings
        self.start("keeper")
        wait_until(self.answers, "the keeper answers again")

    def cut(self):
        """Nothing comes through the relay, as if the network were gone; what is sent waits."""
        self.processes["relay"].send_signal(signal.SIGSTOP)

    def heal(self):
        self.processes["relay"].send_signal(signal.SIGCONT)

    def answers(self):
        for name, process in self.processes.items():
            assert process.poll() is None, (self.folder / f"{name}.log").read_text()
        try:
            self.launcher.greet()
        except Exception:  # the answer, not its form, is waited for
            return False
        return True

    @property
    def sessions(self):
        """The ids of the sessions whose containers run."""
        containers = dict(self.docker.containers)
        return {
            one["Labels"]["org.bt-studio.session"]
            for one in containers.values()
            if one["State"]["Running"] and "org.bt-studio.session" in one["Labels"]
        }


@pytest.fixture
def authority(tmp_path, settings_of):
    """The folder of the certificates of this web server."""
    settings_of(data_dir=tmp_path)
    web_bundle.cache_clear()
    folder = environment().hosts_folder
    assert renew_web_bundle(folder) == folder / WEB_BUNDLE
    yield folder
    web_bundle.cache_clear()


@pytest.fixture
def host_of(authority):
    """Starts hosts; the last part of an address tells them apart."""
    with ExitStack() as stack:
        yield lambda number, **settings: Host(stack, authority, f"127.0.0.{number}", **settings)


@pytest.fixture
def launcher_of():
    """Makes the launcher of a web server: the first host is its own, the others are reached by relays."""
    made = []

    def make(local, *further, clock=None):
        hosts = {LOCAL: DockerLauncher(local.keeper_folder)}
        for host in further:
            hosts[str(host.address)] = RelayedLauncher(read_host(str(host.address)))
        launcher = HostsLauncher(hosts) if clock is None else HostsLauncher(hosts, clock)
        made.append(launcher)
        return launcher

    yield make
    for launcher in made:
        launcher.close()


__all__ = ["relay"]
