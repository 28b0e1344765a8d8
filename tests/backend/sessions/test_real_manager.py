"""A server with the real executor: the relay reaches it, and killing the server ends everything."""

from __future__ import annotations

import json

import psutil
import pytest
import requests
from websockets.sync.client import connect

from tests.backend.serving import serving


@pytest.mark.kills
@pytest.mark.simulation
def test_a_session_of_a_killed_server_leaves_no_process(tmp_path):
    with serving(tmp_path) as server:
        api = requests.Session()
        api.headers.update(server.headers)
        made = api.post(
            f"{server.base}/api/v1/projects", json={"template": "laser_bump_and_go"}, timeout=60
        ).json()
        session = api.post(f"{server.base}/api/v1/projects/{made['id']}/session", timeout=60).json()
        address = "ws" + server.base.removeprefix("http") + session["control_url"]
        with connect(address, additional_headers=server.headers, proxy=None, open_timeout=60) as socket:
            hello = json.loads(socket.recv(timeout=60))
            assert (hello["command"], hello["data"]["state"]) == ("introspection", "idle")
            assert hello["data"]["protocol"] == "bt-studio.v1"
            family = psutil.Process(server.process.pid).children(recursive=True)
            assert family
            server.process.kill()
            server.process.wait()
            _, alive = psutil.wait_procs(family, timeout=60)
            assert [p for p in alive if p.status() != psutil.STATUS_ZOMBIE] == []
