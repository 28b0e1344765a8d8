"""A whole session through the real server: the time from Run to motion, and the rates that it sustains.

Two clients watch: one takes the 3D stream, one the camera's pictures, each in a process's thread that
decodes every message, as a browser would.
"""

from __future__ import annotations

import json
import statistics
import tempfile
import time
import urllib.request
from http.cookiejar import CookieJar
from pathlib import Path
from typing import Any

from tests.e2e.observer import Observer
from tests.e2e.server import Server, serving, wait_until

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


def main() -> None:
    """Prints the figures of one run."""
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder)) as server:
        client = Client(server)
        times = []
        for _ in range(RUNS):
            seconds, observer, session = run_to_motion_s(client, "laser_bump_and_go")
            times.append(seconds)
            observer.close()
            client.call("DELETE", f"/sessions/{session}")
        print(
            f"Run to first changed pose, warm: median {statistics.median(times):.2f} s,"
            f" worst {max(times):.2f} s"
        )

        _, observer, session = run_to_motion_s(client, "visual_follow_person")
        viewer = client.join(session)
        viewer.send("subscribe", {"stream": "camera", "max_hz": 15})
        start_t, start = observer.sim_time(), dict(observer.frames)
        start_camera, began = viewer.frames.get("camera", 0), time.monotonic()
        time.sleep(WATCHED_S)
        passed = time.monotonic() - began
        print(
            f"with one 3D client and one camera client over {passed:.0f} s: "
            f"real-time factor {(observer.sim_time() - start_t) / passed:.3f}, "
            f"{(observer.frames['poses'] - start['poses']) / passed:.1f} pose frames/s, "
            f"{(viewer.frames['camera'] - start_camera) / passed:.1f} camera frames/s"
        )
        observer.close()
        viewer.close()
        client.call("DELETE", f"/sessions/{session}")


if __name__ == "__main__":
    main()
