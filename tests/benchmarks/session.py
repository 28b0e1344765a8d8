"""A whole session through the real server: the time from Run to motion, and the rates that it sustains.

Two clients watch: one takes the 3D stream, one the camera's pictures, each in a process's thread that
decodes every message, as a browser would.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import tempfile
import time
import urllib.request
from http.cookiejar import CookieJar
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tests.benchmarks.figures import Figure, show
from tests.benchmarks.timing import processor_s
from tests.e2e.observer import Observer
from tests.e2e.server import Server, serving, wait_until

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

RUNS = 5
WATCHED_S = 20.0


class Client:
    """A user without a browser: the token's cookie, REST, and the session's sockets."""

    def __init__(self, server: Server) -> None:
        self.server = server
        self.cookies = CookieJar()
        self.opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(self.cookies))
        self.opener.open(server.url).close()

    def call(self, method: str, path: str, body: dict[str, Any] | None = None) -> dict[str, Any]:
        """One call of the REST API."""
        request = urllib.request.Request(
            f"{self.server.origin}/api/v1{path}",
            method=method,
            data=None if body is None else json.dumps(body).encode(),
            headers={"Content-Type": "application/json", "Origin": self.server.origin},
        )
        with self.opener.open(request) as response:
            result: dict[str, Any] = json.loads(response.read() or b"{}")
        return result

    def join(self, session_id: str) -> Observer:
        """Joins a session; the first to join drives it."""
        cookie = "; ".join(f"{c.name}={c.value}" for c in self.cookies)
        return Observer.join(self.server.origin, cookie, session_id)


def run_to_motion_s(client: Client, template: str) -> tuple[float, Observer, str]:
    """Returns the seconds from the Run request, with no process of the session, to the first changed pose."""
    project = client.call("POST", "/projects", {"template": template})["id"]
    pressed = time.monotonic()
    app = client.call("GET", f"/projects/{project}/app")
    session = client.call("POST", f"/projects/{project}/session")["id"]
    observer = client.join(session)
    application = {name: app[name] for name in ("app_zip_base64", "tick_hz", "on_finish", "on_error")}
    observer.send("run", {"universe": {"universe": app["universe"]}, "application": application})
    wait_until(lambda: moved(observer), "the robot moves", every_s=0.005)
    return time.monotonic() - pressed, observer, session


def moved(observer: Observer) -> bool:
    """Returns whether the robot has moved."""
    return "robot" in observer.objects and observer.distance_travelled("robot") > 0.002


def measure(options: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields the figures of one server."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=RUNS)
    parser.add_argument("--watched", type=float, default=WATCHED_S, metavar="SECONDS")
    chosen = parser.parse_args(options)
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder)) as server:
        client = Client(server)
        times, used = [], []
        for _ in range(chosen.runs):
            before_s = _used_s(server)
            seconds, observer, session = run_to_motion_s(client, "laser_bump_and_go")
            times.append(seconds)
            used.append(_used_s(server) - before_s)
            observer.close()
            client.call("DELETE", f"/sessions/{session}")
        yield Figure("Run to first changed pose, warm, median", statistics.median(times), "s")
        yield Figure("Run to first changed pose, warm, worst", max(times), "s")
        yield Figure("meanwhile processor time, median", statistics.median(used), "s")

        _, observer, session = run_to_motion_s(client, "visual_follow_person")
        viewer = client.join(session)
        viewer.send("subscribe", {"stream": "camera", "max_hz": 15})
        start_t, start = observer.sim_time(), dict(observer.frames)
        start_camera, began = viewer.frames.get("camera", 0), time.monotonic()
        before_s = _used_s(server)
        time.sleep(chosen.watched)
        passed = time.monotonic() - began
        who = "with one 3D client and one camera client"
        yield Figure(f"{who}: real-time factor", (observer.sim_time() - start_t) / passed, "×", "higher")
        poses, pictures = observer.frames["poses"] - start["poses"], viewer.frames["camera"] - start_camera
        yield Figure(f"{who}: pose frames", poses / passed, "/s", "higher")
        yield Figure(f"{who}: camera frames", pictures / passed, "/s", "higher")
        cores = (_used_s(server) - before_s) / passed
        yield Figure(f"{who}: processor time of all processes", 100 * cores, "%")
        observer.close()
        viewer.close()
        client.call("DELETE", f"/sessions/{session}")


def _used_s(server: Server) -> float:
    return processor_s(server.process, *server.process.children(recursive=True))


def main() -> None:
    """Prints the figures."""
    show(measure(sys.argv[1:]))


if __name__ == "__main__":
    main()
