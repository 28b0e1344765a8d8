"""The time to open a project of 500 files: the server's part, from the request to the complete answer.

`python -m tests.benchmarks opening [--files 500]`. Cold is the first time after the start of the server, when
nothing of the project has been read yet; warm is every other time. The processor time is printed too, since
wall time means little on a busy machine.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import psutil
import requests

from tests.backend.serving import Served, serving
from tests.benchmarks.figures import Figure, show
from tests.benchmarks.timing import processor_s

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

ACTION = '''"""Drives on for a while."""

import py_trees
from geometry_msgs.msg import Twist


class {name}(py_trees.behaviour.Behaviour):
    """Drives at a speed.

    Ports:
        speed (in, float): m/s.
    """

    def setup(self, **kwargs):
        self.node = kwargs["node"]
        self.publisher = self.node.create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        twist = Twist()
        twist.linear.x = {number} / 100
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING
'''
TIMES = 15


def project_files(number: int) -> list[dict[str, object]]:
    """Returns this many files: two fifths actions, one fifth trees that use them, the rest notes."""
    actions = [f"Drive{n}" for n in range(2 * number // 5)]
    files = {f"actions/{name}.py": ACTION.format(name=name, number=n) for n, name in enumerate(actions)}
    for n in range(number // 5):
        nodes = {"n1": {"type": "Sequence", "children": ["n2", "n3", "n4"]}}
        for m in (2, 3, 4):
            nodes[f"n{m}"] = {"type": actions[(3 * n + m) % len(actions)]}
        head = {"format": "bt-studio/diagram", "version": 1, "id": f"Tree{n}", "root": "n1"}
        files[f"trees/Tree{n}.json"] = json.dumps(head | {"nodes": nodes})
    for n in range(number - len(files) - 2):  # the new project already has two
        files[f"notes/{n}.txt"] = f"Note {n}. " * 40
    return [{"path": path, "base_revision": 0, "content": text} for path, text in files.items()]


def opened(server: Served, project: str) -> tuple[float, float, int]:
    """Returns the time to the complete answer and the processor time, in ms, and the size of the answer."""
    process = psutil.Process(server.process.pid)
    before, started = processor_s(process), time.perf_counter()
    answer = requests.get(f"{server.base}/api/v1/projects/{project}", headers=server.headers, timeout=60)
    took = time.perf_counter() - started
    answer.raise_for_status()
    return 1000 * took, 1000 * (processor_s(process) - before), len(answer.content)


def measure(options: Sequence[str] = ()) -> Iterable[Figure]:
    """Makes the project, starts the server again, and opens it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--files", type=int, default=500)
    chosen = parser.parse_args(options)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with serving(folder) as server:
            ask = requests.Session()
            ask.headers.update(server.headers)
            base = f"{server.base}/api/v1/projects"
            project = ask.post(base, json={"name": "Large"}, timeout=60).json()["id"]
            changes: Any = {"files": project_files(chosen.files)}
            ask.post(f"{base}/{project}/changes", json=changes, timeout=60).raise_for_status()
        with serving(folder) as server:
            # The very first request pays for imports, which is independent of this project.
            small = {"name": "Small"}
            requests.post(f"{server.base}/api/v1/projects", json=small, headers=server.headers, timeout=60)
            took, used, size = opened(server, project)
            what = f"opening {chosen.files} files"
            yield Figure(f"{what}: size of the answer", size / 1e3, "kB")
            yield Figure(f"{what}, cold: to the complete answer", took, "ms")
            yield Figure(f"{what}, cold: processor time", used, "ms")
            process = psutil.Process(server.process.pid)
            before_s = processor_s(process)
            warm = [opened(server, project)[0] for _ in range(TIMES)]
            # The kernel counts in steps of 10 ms, so all of them are taken together.
            used = 1000 * (processor_s(process) - before_s) / TIMES
            yield Figure(f"{what}, warm: to the complete answer, median", statistics.median(warm), "ms")
            yield Figure(f"{what}, warm: processor time, mean", used, "ms")


def main() -> None:
    """Prints the figures."""
    show(measure(sys.argv[1:]))


if __name__ == "__main__":
    main()
