"""Runs of the real executor outlive their sessions: one that is kept, and the last one by itself."""

from __future__ import annotations

import io
import json
import time
from contextlib import contextmanager
from pathlib import Path

import psutil
import pytest
import requests
from mcap.reader import make_reader
from websockets.sync.client import connect

from tests.backend.serving import serving
from tests.processes import with_word

pytestmark = pytest.mark.simulation


class Api:
    """The API of a server, for a project."""

    def __init__(self, server):
        self.server = server
        self.session = requests.Session()
        self.session.headers.update(server.headers)
        made = self.ask("POST", "projects", json={"template": "laser_bump_and_go"}).json()
        self.project = f"projects/{made['id']}"

    def ask(self, method, path, **more):
        answer = self.session.request(method, f"{self.server.base}/api/v1/{path}", timeout=100, **more)
        assert answer.ok, answer.text
        return answer

    @contextmanager
    def running(self, seconds):
        """Runs the project for some seconds; gives the session, and the name of the run."""
        session = self.ask("POST", f"{self.project}/session").json()
        app = self.ask("GET", f"{self.project}/app").json()
        address = "ws" + self.server.base.removeprefix("http") + session["control_url"]
        with connect(address, additional_headers=self.server.headers, proxy=None, max_size=None) as socket:
            data = {
                "universe": {"universe": "walled_room", "seed": 1},
                "application": {"app_zip_base64": app["app_zip_base64"], "tick_hz": 20.0},
            }
            socket.send(json.dumps({"id": "run", "command": "run", "data": data}))
            while True:
                event = json.loads(socket.recv(timeout=100))
                if event["command"] == "segment" and event["data"]["to_t"] > seconds:
                    break
            yield session, event["data"]["run"]

    def last(self, run):
        """Waits until a run is kept as the last one, and returns it."""
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            found = [each for each in self.runs() if each["is_last"]]
            if found and found[0]["recorded_as"] == run:
                return found[0]
            time.sleep(0.2)
        raise AssertionError(f"{run} is not the last run of {self.runs()}")

    def runs(self):
        return self.ask("GET", f"{self.project}/runs").json()["items"]


def test_a_run_is_kept_while_it_runs_and_downloaded_after_its_session(tmp_path):
    with serving(tmp_path) as server:
        api = Api(server)
        with api.running(1) as (session, run):
            kept = api.ask("POST", f"{api.project}/runs", json={"run": run, "name": "First"}).json()
            assert (kept["result"], kept["has_thumbnail"]) == ("running", True)
        api.ask("DELETE", f"sessions/{session['id']}")
        assert kept["length_s"] > 0.9
        recording = api.ask("GET", f"{api.project}/runs/{kept['id']}/recording").content
        assert len(recording) == kept["size"]
        topics = {channel.topic for _, channel, _ in make_reader(io.BytesIO(recording)).iter_messages()}
        assert {"/bt/tree", "/bt/tick", "/world/poses", "/scan"} <= topics


@pytest.mark.kills
def test_the_last_run_is_kept_by_itself_when_its_session_or_executor_or_server_ends(tmp_path):
    with serving(tmp_path) as server:
        api = Api(server)
        with api.running(1) as (session, run):
            api.ask("DELETE", f"sessions/{session['id']}")
        assert api.last(run)["length_s"] > 0.9
        with api.running(1) as (_, run):
            for child in with_word("executor.manager", psutil.Process(server.process.pid).children()):
                child.kill()
        lost = api.last(run)
        assert lost["length_s"] > 0.5
        assert len(api.runs()) == 1
        with api.running(1) as (_, run):
            server.process.kill()
            server.process.wait()
    with serving(tmp_path) as server:
        api.server = server
        api.session.headers.update(server.headers)
        assert api.last(run)["length_s"] > 0.5
        assert list((Path(tmp_path) / "recordings").iterdir()) == []
