"""An evaluation with the real executor: it outlives its server, is compared, and played again."""

from __future__ import annotations

import json
import signal
import time

import psutil
import pytest
import requests

from tests.backend.serving import serving

pytestmark = [pytest.mark.kills, pytest.mark.simulation]

ROOM = """format: bt-studio/evaluation
version: 1
universe: walled_room
duration_s: 3
runs: 6
seed: 4
vary:
  robot.pose: {area: middle, yaw: [0, 6.283]}
judge:
  success:
    - never: collision
    - never: {closer_than_m: 0.9, to: anything}
  measure: [path_length_m]
"""


class Api:
    """The API of a server, for a project with the evaluation `quick`."""

    def __init__(self, server, project=None):
        self.server = server
        self.session = requests.Session()
        self.session.headers.update(server.headers)
        if project is None:
            made = self.ask("POST", "projects", json={"template": "laser_bump_and_go"}).json()
            project = f"projects/{made['id']}"
        self.project = project

    def ask(self, method, path, **more):
        answer = self.session.request(method, f"{self.server.base}/api/v1/{path}", timeout=100, **more)
        assert answer.ok, answer.text
        return answer

    def write(self, path, text):
        files = [{"path": path, "base_revision": 0, "content": text}]
        return self.ask("POST", f"{self.project}/changes", json={"message": "test", "files": files})

    def until(self, evaluation, state, *, done=0):
        """Waits until an evaluation is in a state, with so many outcomes."""
        deadline = time.monotonic() + 150
        while time.monotonic() < deadline:
            found = self.ask("GET", f"{self.project}/evaluations/{evaluation}").json()
            assert found["state"] in {"waiting", "running", state}, found
            if found["state"] == state and found["sides"][0]["done"] >= done:
                return found
            time.sleep(0.2)
        raise AssertionError(found)


def test_an_evaluation_outlives_its_server_and_is_compared_and_played(tmp_path):
    with serving(tmp_path) as server:
        api = Api(server)
        api.write("evaluations/quick.yaml", ROOM)
        made = api.ask("POST", f"{api.project}/evaluations", json={"name": "quick"}).json()
        api.until(made["id"], "running", done=1)
        server.end(signal.SIGKILL)
    with serving(tmp_path) as server:
        api = Api(server, api.project)
        own = f"{api.project}/evaluations/{made['id']}"
        done = api.until(made["id"], "done")
        assert (done["seed"], done["sides"][0]["done"], done["sides"][0]["wanted"]) == (4, 6, 6)
        rows = api.ask("GET", f"{own}/outcomes").json()
        assert sorted(row["seed"] for row in rows["items"]) == list(range(4, 10))
        assert all(row["unit"] == "m" and "path_length_m" in row["measures"] for row in rows["items"])
        lines = api.ask("GET", f"{own}/runs.jsonl").text.splitlines()
        assert [json.loads(line)["seed"] for line in lines] == list(range(4, 10))
        page = api.ask("GET", f"{own}/report.html")
        assert page.headers["Content-Disposition"].startswith("attachment")
        assert '"evaluation":"quick"' in page.text
        api.ask("POST", f"{own}/compare", json={"revision": 1})
        compared = api.until(made["id"], "done")
        assert [side["done"] for side in compared["sides"]] == [6, 6]
        difference = api.ask("GET", f"{own}/comparison").json()
        assert difference["only_older"] == difference["only_newer"] == []
        assert difference["both"] + difference["neither"] == 6
        wish = {"revision": done["revision"], "seed": 5}
        replay = api.ask("POST", f"{own}/replays", json=wish).json()
        deadline = time.monotonic() + 60
        while replay["state"] != "done" and time.monotonic() < deadline:
            assert replay["state"] != "failed", replay
            time.sleep(0.2)
            replay = api.ask("GET", f"{own}/replays/{replay['id']}").json()
        run = api.ask("GET", f"{api.project}/runs/{replay['run']}").json()
        assert run["name"] == f"quick, seed 5, revision {done['revision']}"
        assert api.ask("POST", f"{own}/replays", json=wish).json()["run"] == replay["run"]
        children = psutil.Process(server.process.pid).children(recursive=True)
        server.end()
    assert not psutil.wait_procs(children, timeout=10)[1]
