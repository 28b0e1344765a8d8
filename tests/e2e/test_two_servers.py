"""Two web servers behind a proxy: each ends in turn while somebody types and a robot drives."""

from __future__ import annotations

import contextlib
import signal
import socket
import subprocess
from contextlib import ExitStack
from typing import TYPE_CHECKING

import psutil
import pytest
from playwright.sync_api import expect

from tests.backend.services import free_port
from tests.backend.sessions.several_servers import Team
from tests.e2e.server import Server, wait_until
from tests.e2e.studio import Studio
from tests.fakes.kubernetes_api import FakeCluster
from tests.fakes.kubernetes_node import Node

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser

pytestmark = [
    pytest.mark.e2e,
    pytest.mark.simulation,
    pytest.mark.long_walk,
    pytest.mark.kills,
    pytest.mark.timeout(900),
]

# As `docker/caddy/Caddyfile`, for two servers that are always named. Up to 2.11.1, Caddy answers 502 to a
# request with a body if the first server that it tries is gone (caddyserver/caddy#7546): so it asks for their
# health.
CADDYFILE = """
{{
	admin off
	auto_https off
}}
http://127.0.0.1:{port} {{
	bind 127.0.0.1
	reverse_proxy {servers} {{
		lb_policy first
		health_uri /health/ready
		health_interval 250ms
		health_headers {{
			Host 127.0.0.1:{port}
		}}
		lb_try_duration 10s
		lb_try_interval 100ms
		transport http {{
			dial_timeout 1s
		}}
	}}
}}
"""


@contextlib.contextmanager
def proxy(folder: Path, port: int, servers: list[int]) -> Iterator[None]:
    """Caddy before web servers; it takes the first one that answers."""
    file = folder / "Caddyfile"
    places = " ".join(f"127.0.0.1:{server}" for server in servers)
    file.write_text(CADDYFILE.format(port=port, servers=places))
    command = ["caddy", "run", "--config", str(file), "--adapter", "caddyfile"]
    with (folder / "caddy.log").open("wb") as log, subprocess.Popen(command, stderr=log) as process:
        try:
            wait_until(lambda: listens(port), "the proxy listens")
            yield
        finally:
            process.terminate()


def listens(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


@pytest.fixture
def node(tmp_path: Path) -> Iterator[Node]:
    folder = tmp_path / "node"
    folder.mkdir()
    with Node(folder) as running:
        yield running


@pytest.fixture
def team(tmp_path: Path, node: Node) -> Iterator[Team]:
    """Two servers with a cluster, and the proxy as their public address."""
    port = free_port()
    with FakeCluster(node.run) as cluster, ExitStack() as stack:
        made = Team(stack, tmp_path, cluster, f"http://127.0.0.1:{port}")
        stack.enter_context(proxy(tmp_path, port, made.ports))
        yield made


def test_a_server_that_ends_costs_neither_a_word_nor_the_robot(
    team: Team, node: Node, browser_without_webgl: Browser
) -> None:
    context = browser_without_webgl.new_context(viewport={"width": 1440, "height": 900})
    name, _, value = team.cookie.partition("=")
    context.add_cookies([{"name": name, "value": value, "url": team.public_url}])
    studio = Studio(context.new_page(), Server(team.public_url, psutil.Process()))
    studio.open()
    studio.new_from("laser_bump_and_go")
    studio.run()
    wait_until(lambda: studio.stat("t") > 1, "the robot drives")
    for ending, how, typed in ((0, signal.SIGKILL, "0.41"), (1, signal.SIGTERM, "0.42")):
        studio.set_port("n4", "obs_dist", "0.4")
        type_a_port(studio, typed)
        team.end(ending, how)
        studio.saved()
        before = studio.stat("t")
        wait_until(lambda: studio.stat("t") > before + 2, "the robot drives on")  # noqa: B023 - called here
        studio.expect_state("application_running")
        team.begin_again(ending)
        wait_until(lambda: listens(team.ports[ending]), "the server is back")  # noqa: B023 - called here
    assert len(node.processes) == 1
    studio.picture("two-servers")
    studio.end_session()
    studio.page.reload()
    studio.at("node-n4").click()
    expect(studio.at("port-obs_dist")).to_have_value("0.42")
    context.close()
    assert studio.complaints == []


def type_a_port(studio: Studio, value: str) -> None:
    """Changes a port without waiting until that is stored."""
    field = studio.at("port-obs_dist")
    field.fill(value)
    field.press("Enter")
