"""Two Docker engines on this machine as two hosts: placement, a lost host, and a healed partition."""

from __future__ import annotations

import os
import secrets
import shutil
import subprocess
import time
from contextlib import contextmanager

import pytest

from backend.sessions.hosts.contact import LOST_S
from tests.docker.engine import DEADLINE_S, REPOSITORY, _run, build_images, engine, new_engine
from tests.docker.stack import Stack

BUILT = os.environ.get("BT_STUDIO_TEST_IMAGES", "")
TAG = BUILT or "test"
BRIDGE = "btstudio2"
NAME = "172.30.77.1"
PORT = 17164
RELAY_USER = 10006
pytestmark = [pytest.mark.timeout(1800)]


@contextmanager
def second_engine(folder):
    """Yields an engine with data, a bridge and containers of its own."""
    _ip("link", "delete", BRIDGE, check=False)  # that of a test that was killed
    _ip("link", "add", BRIDGE, "type", "bridge")
    try:
        _ip("addr", "add", f"{NAME}/24", "dev", BRIDGE)
        _ip("link", "set", BRIDGE, "up")
        with new_engine(folder, "docker2", folder / "data2", "--bridge", BRIDGE) as made:
            yield made
    finally:
        _ip("link", "delete", BRIDGE)
        shutil.rmtree(folder / "data2", ignore_errors=True)


def _ip(*arguments, check=True):
    subprocess.run(["ip", *arguments], check=check, capture_output=True)


class FurtherHost:
    """Keeper, gate and relay on the second engine, as `docs/how-to/run-on-several-hosts.md` starts them."""

    def __init__(self, own, folder, stack):
        self.engine = own
        self.name = "btstudiohost" + secrets.token_hex(3)
        self._folder = folder / "host"
        self._folder.mkdir()
        bundle = self._folder / "host.pem"
        bundle.write_text(stack.studio("hosts", "certificate", NAME).stdout)
        os.chown(bundle, RELAY_USER, RELAY_USER)
        bundle.chmod(0o400)
        self._file = folder / "host.env"
        values = {
            "BT_STUDIO_VERSION": TAG,
            "BT_STUDIO_DOCKER_GID": str(own.socket.stat().st_gid),
            "BT_STUDIO_DOCKER_SOCKET": str(own.socket),
            "BT_STUDIO_RELAY_PUBLISH": str(PORT),
            "BT_STUDIO_RELAY_FOLDER": str(self._folder),
            "BT_STUDIO_MAX_SESSIONS": "3",
        }
        self._file.write_text("".join(f"{name}={value}\n" for name, value in values.items()))

    def compose(self, *arguments):
        file = str(REPOSITORY / "docker" / "compose.host.yaml")
        options = ("-p", self.name, "-f", file, "--env-file", str(self._file))
        command = (*self.engine.compose, *options, *arguments)
        return _run(command, self.engine.environment)

    def relay(self, what):
        """Pauses or continues the relay: the host is cut off, or reached again."""
        self.engine.run(what, self.compose("ps", "-q", "relay").stdout.strip())

    def sessions(self):
        """Returns the ids of the sessions whose containers run."""
        label = "org.bt-studio.session"
        asked = ("--filter", f"label={label}", "--format", f'{{{{.Label "{label}"}}}}')
        return self.engine.run("ps", *asked).stdout.split()


def wait_for(true, what, seconds=DEADLINE_S):
    deadline = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < deadline, what
        time.sleep(0.5)


@pytest.fixture(scope="module")
def hosts(tmp_path_factory):
    """Yields the server's stack, and a further host that it reaches."""
    folder = tmp_path_factory.mktemp("docker")
    with engine(folder) as running, second_engine(folder) as second:
        if not BUILT:
            build_images(running, TAG)
        for image in ("keeper", "executor"):
            name = f"bt-studio-{image}:{TAG}"
            running.run("save", "-o", str(folder / "image.tar"), name)
            second.run("load", "-i", str(folder / "image.tar"))
        listed = f'["{NAME}:{PORT}"]'
        places = {"BT_STUDIO_MAX_SESSIONS": "4", "BT_STUDIO_HOST_SESSIONS": "1"}
        stack = Stack(running, folder, TAG, BT_STUDIO_EXECUTOR_HOSTS=listed, **places)
        further = None
        try:
            stack.up()
            further = FurtherHost(second, folder, stack)
            further.compose("up", "-d")
            wait_for(
                lambda: not stack.studio("hosts", "check", check=False).returncode, "the host is not reached"
            )
            yield stack, further
        finally:
            print(stack.compose("logs", "--tail=60", check=False).stdout)
            if further is not None:
                further.compose("down", "-v", "-t", "5")
            stack.down()


def test_robots_run_on_both_hosts_and_none_twice_when_one_is_cut_off(hosts):
    stack, further = hosts
    ann = stack.add_user("ann")
    projects = [ann.post("projects", {"name": f"P{n}"})["id"] for n in range(2)]
    first = ann.post(f"projects/{projects[0]}/session")["id"]
    wait_for(lambda: ann.get(f"sessions/{first}")["state"] == "ready", "the first robot does not start")
    assert further.sessions() == [first]
    assert stack.sessions() == []

    further.relay("pause")
    second = ann.post(f"projects/{projects[1]}/session")["id"]
    wait_for(lambda: ann.get(f"sessions/{second}")["state"] == "ready", "no robot starts on the other host")
    assert len(stack.sessions()) == 1
    wait_for(
        lambda: ann.get(f"sessions/{first}")["state"] == "failed", "the lost host is not given up", 4 * LOST_S
    )
    assert "was not reached for 30 s" in ann.get(f"sessions/{first}")["error"]
    assert further.sessions() == [first], "it is cut off, and runs on for two minutes"

    further.relay("unpause")
    wait_for(lambda: further.sessions() == [], "what was given up still runs")
    assert ann.get(f"sessions/{second}")["state"] == "ready"
    third = ann.post(f"projects/{projects[0]}/session")["id"]
    wait_for(lambda: ann.get(f"sessions/{third}")["state"] == "ready", "the host is not used again")
    assert further.sessions() == [third]
    for session in (second, third):
        ann.delete(f"sessions/{session}")
