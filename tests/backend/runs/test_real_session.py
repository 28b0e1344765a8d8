"""A run of the real executor is kept, and outlives its session."""

from __future__ import annotations

import io
import json

import pytest
import requests
from mcap.reader import make_reader
from websockets.sync.client import connect

from tests.backend.serving import serving

pytestmark = pytest.mark.simulation


def test_a_run_is_kept_while_it_runs_and_downloaded_after_its_session(tmp_path):
    with serving(tmp_path) as server:
        api = requests.Session()
        api.headers.update(server.headers)

        def ask(method, path, **more):
            answer = api.request(method, f"{server.base}/api/v1/{path}", timeout=100, **more)
            assert answer.ok, answer.text
            return answer

        made = ask("POST", "projects", json={"template": "laser_bump_and_go"}).json()
        project = f"projects/{made['id']}"
        session = ask("POST", f"{project}/session").json()
        app = ask("GET", f"{project}/app").json()
        address = "ws" + server.base.removeprefix("http") + session["control_url"]
        with connect(address, additional_headers=server.headers, proxy=None, max_size=None) as socket:
            data = {
                "universe": {"universe": "walled_room", "seed": 1},
                "application": {"app_zip_base64": app["app_zip_base64"], "tick_hz": 20.0},
            }
            socket.send(json.dumps({"id": "run", "command": "run", "data": data}))
            while True:
                event = json.loads(socket.recv(timeout=100))
                if event["command"] == "segment" and event["data"]["to_t"] > 1:
                    break
            asked = {"run": event["data"]["run"], "name": "First"}
            kept = ask("POST", f"{project}/runs", json=asked).json()
        ask("DELETE", f"sessions/{session['id']}")
        assert kept["length_s"] > 0.9
        recording = ask("GET", f"{project}/runs/{kept['id']}/recording").content
        assert len(recording) == kept["size"]
        topics = {channel.topic for _, channel, _ in make_reader(io.BytesIO(recording)).iter_messages()}
        assert {"/bt/tree", "/bt/tick", "/world/poses", "/scan"} <= topics
