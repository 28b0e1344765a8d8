"""`bt-studio open`: a robot's log in the browser."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time

import requests

from backend.cli.main import VERBS
from backend.cli.open_log import open_log
from tests.backend.serving import REPOSITORY
from tests.executor.recorder.outside.logs import SAMPLES

COMMAND = [sys.executable, "-m", "backend.cli.main", "open"]


def clean():
    return {name: value for name, value in os.environ.items() if not name.startswith("BT_STUDIO_")}


def opened(folder, log, *arguments):
    command = [*COMMAND, str(log), "--data-dir", str(folder / "data"), *arguments]
    return subprocess.run(command, cwd=REPOSITORY, env=clean(), capture_output=True, text=True, check=False)


def test_a_log_becomes_a_project_and_its_link_shows_the_run(tmp_path):
    ready = tmp_path / "ready.json"
    options = [
        "--data-dir",
        str(tmp_path / "data"),
        "--no-browser",
        "--port",
        "0",
        "--ready-file",
        str(ready),
    ]
    command = [*COMMAND, str(SAMPLES / "patrol.btlog"), *options]
    with subprocess.Popen(command, cwd=REPOSITORY, env=clean(), stdout=subprocess.PIPE, text=True) as process:
        try:
            deadline = time.monotonic() + 120
            while not ready.exists():
                assert process.poll() is None
                assert time.monotonic() < deadline
                time.sleep(0.05)
            url = json.loads(ready.read_text())["url"]
            page, _, token = url.rpartition("&token=")
            base, _, path = page.partition("/projects/")
            project, _, run = path.partition("?run=")
            link = requests.get(url, allow_redirects=False, timeout=30)
            assert (link.status_code, link.headers["Location"]) == (302, f"/projects/{path}")
            headers = {"Authorization": f"Bearer {token}"}
            found = requests.get(f"{base}/api/v1/projects/{project}/runs/{run}", headers=headers, timeout=30)
            assert (found.json()["name"], found.json()["result"]) == ("patrol.btlog", "success")
            second = opened(tmp_path, SAMPLES / "patrol.db3")
            assert second.returncode == 0, second.stderr
            assert (
                f"The server that runs already (process {process.pid}) has it at /projects/" in second.stdout
            )
        finally:
            process.terminate()


def test_the_command_is_called_open():
    assert VERBS["open"] == ("open_log", open_log.__name__)


def test_what_is_no_log_is_said_with_its_place(tmp_path):
    (tmp_path / "f.btlog").write_bytes((SAMPLES / "patrol.btlog").read_bytes()[:300])
    for log, text in (("f.btlog", "f.btlog:23: it ends within its tree"), ("nothing", "No such file")):
        failed = opened(tmp_path, tmp_path / log)
        assert failed.returncode in {1, 2}
        assert text in failed.stderr
        assert "Traceback" not in failed.stderr
