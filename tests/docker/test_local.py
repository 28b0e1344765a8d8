"""The IDE of one user in containers: it starts by one command, drives a robot, and keeps its data."""

from __future__ import annotations

import os
import re
import secrets
import socket
from pathlib import Path

import psutil
import pytest
from playwright.sync_api import expect, sync_playwright

from tests.docker.engine import REPOSITORY, _run, build_images, engine
from tests.e2e.conftest import CHROMIUM, QUIET, SOFTWARE_WEBGL
from tests.e2e.server import Server, wait_until
from tests.e2e.studio import OUTPUT, Studio

BUILT = os.environ.get("BT_STUDIO_TEST_IMAGES", "")
TAG = BUILT or "test"
COMPOSE = REPOSITORY / "docker" / "compose.local.yaml"
LINK = re.compile(r"http://127\.0\.0\.1:\d+/\?token=\S+")
pytestmark = [pytest.mark.timeout(1800)]


class Local:
    """The stack of `docker/compose.local.yaml`."""

    def __init__(self, running):
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        self.engine = running
        self._command = (*running.compose, "-p", "btlocal" + secrets.token_hex(3), "-f", str(COMPOSE))
        group = str(running.socket.stat().st_gid)
        settings = {
            "VERSION": TAG,
            "PORT": str(port),
            "DOCKER_SOCKET": str(running.socket),
            "DOCKER_GID": group,
        }
        self._environment = running.environment | {f"BT_STUDIO_{k}": v for k, v in settings.items()}

    def compose(self, *arguments, **options):
        return _run((*self._command, *arguments), self._environment, **options)

    def up(self):
        """Starts it; returns the link of this start, as a user finds it."""
        before = len(self._links())
        self.compose("up", "-d")
        wait_until(lambda: len(self._links()) > before, "the server prints its link")
        return Server(self._links()[-1], psutil.Process())

    def _links(self):
        return LINK.findall(self.compose("logs", "--no-color", "web", check=False).stdout)

    def executors(self):
        filters = ("--filter", f"ancestor=bt-studio-executor:{TAG}", "--format", "{{.Names}}")
        return self.engine.run("ps", *filters).stdout.split()


@pytest.fixture
def local(tmp_path):
    with engine(tmp_path) as running:
        if not BUILT:
            build_images(running, TAG)
        made = Local(running)
        try:
            yield made
        finally:
            print(made.compose("logs", "--tail=60", check=False).stdout)
            made.compose("down", "-v", "-t", "10")


def test_a_robot_is_driven_and_the_project_is_there_the_next_day(local):
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*QUIET, *SOFTWARE_WEBGL])
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        studio = Studio(page, local.up())
        studio.open()
        studio.new_from("laser_bump_and_go")
        address = page.url.rpartition("/")[2]
        studio.run()
        wait_until(lambda: studio.stat("distance") > 0.1, "the robot drives")
        assert "RUNNING" in studio.statuses_seen("n1", 1.0)
        OUTPUT.mkdir(exist_ok=True)
        page.screenshot(path=Path(OUTPUT) / "local-in-containers.png")
        assert len(local.executors()) == 1
        local.compose("stop")
        assert local.executors() == []
        complaints = list(studio.complaints)

        again = local.up()
        page.goto(again.url)
        page.goto(f"{again.origin}/projects/{address}")
        expect(studio.at("node-n1")).to_be_visible()
        studio.run()
        wait_until(lambda: studio.stat("distance") > 0.1, "the robot drives again")
        studio.end_session()
        wait_until(lambda: local.executors() == [], "the robot's container is gone")
        browser.close()
    assert complaints == []
