"""The waiting time of a user while another one floods a team's server, by kind of flood.

Each phase of a flood has a quiet phase before it and after it; the figure is p95 of the flooded phase divided
by that of the two quiet ones, the median over all rounds, and the largest. The client of the flood is a
a separate process that is *nice*. Each kind has its name in `tests/hostile/guest.py`: `cheap` are quick GETs.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import requests

from tests.backend.programs import sign_in
from tests.backend.serving import REPOSITORY, serving
from tests.benchmarks.figures import Figure
from tests.benchmarks.load import team
from tests.hostile.bystander import Bystander
from tests.hostile.guest import KINDS
from tests.hostile.projects import large_files
from tests.hostile.wire import guest_cookie

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

NODES = 20_000
PAUSE_S = 0.02
TARGET = 3.0


def parser() -> argparse.ArgumentParser:
    """Returns the options of this part."""
    made = argparse.ArgumentParser(add_help=False)
    made.add_argument("--rounds", type=int, default=5)
    made.add_argument("--phase-s", type=float, default=4.0)
    made.add_argument("--kinds", nargs="+", choices=[*KINDS], default=[*KINDS])
    made.add_argument("--sqlite", action="store_true")
    return made


def measure(options: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields the figures of each kind."""
    chosen, _ = parser().parse_known_args(options)
    ratios: dict[str, list[float]] = {kind: [] for kind in chosen.kinds}
    quiets: list[float] = []
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        settings, port = team(stack, folder, sqlite=chosen.sqlite)
        served = stack.enter_context(serving(folder, "--port", str(port), **settings))
        cookies = [cookie for _, cookie in sign_in(folder, settings, 2)]
        site = _attacked(served, cookies[1])
        worker = _Worker(stack, served, cookies[0])
        before = worker.p95_ms(chosen.phase_s)
        for _ in range(chosen.rounds):
            for kind in chosen.kinds:
                with _flooding(site, kind, chosen.phase_s):
                    flooded = worker.p95_ms(chosen.phase_s)
                after = worker.p95_ms(chosen.phase_s)
                ratios[kind].append(flooded / statistics.mean((before, after)))
                quiets.append(before)
                before = after
    yield Figure("another user, quiet: p95", statistics.median(quiets), "ms")
    yield Figure("another user, quiet: largest p95 of a phase", max(quiets), "ms")
    for kind, found in ratios.items():
        yield Figure(
            f"another user beside {kind}: p95, of quiet", statistics.median(found), f"× (≤ {TARGET:g})"
        )
        yield Figure(f"another user beside {kind}: largest", max(found), "×")


class _Worker:
    """The other user, whose requests never stop."""

    def __init__(self, stack: ExitStack, served: Any, cookie: str) -> None:
        template = {"name": "Bump", "template": "laser_bump_and_go"}
        project = _api(served, cookie, "POST", "projects", template)["id"]
        self._person = Bystander("127.0.0.1", served.port, served.base, cookie, project)
        self._is_over = threading.Event()
        thread = threading.Thread(target=self._work)
        thread.start()
        stack.callback(thread.join)
        stack.callback(self._is_over.set)

    def _work(self) -> None:
        while not self._is_over.is_set():
            self._person.round(PAUSE_S)
        self._person.close()

    def p95_ms(self, seconds: float) -> float:
        """Returns p95 of the requests that begin within so many seconds from now."""
        first, began = len(self._person.samples), time.time()
        time.sleep(seconds)
        times = [sample.ms for sample in self._person.samples[first:] if sample.at >= began]
        return statistics.quantiles(times, n=20)[18] if len(times) > 1 else 1000 * seconds


def _api(served: Any, cookie: str, method: str, path: str, body: Any = None) -> Any:
    headers = {"Cookie": cookie, "Origin": served.base}
    answer = requests.request(method, f"{served.base}/api/v1/{path}", json=body, headers=headers, timeout=120)
    answer.raise_for_status()
    return answer.json()


def _attacked(served: Any, cookie: str) -> dict[str, Any]:
    """Returns a large project of the hostile user, as a plan of the attacks has it."""
    made = _api(served, cookie, "POST", "projects", {"name": "Large"})
    files = large_files(NODES, made["files"])
    _api(served, cookie, "POST", f"projects/{made['id']}/changes", {"files": files})
    link = _api(served, cookie, "POST", f"projects/{made['id']}/shares/links", {})["links"][0]["url"]
    place = {"host": "127.0.0.1", "port": served.port, "origin": served.base}
    return {"guest": guest_cookie(link), "user": cookie, "project": made["id"], "account": "editor0", **place}


@contextmanager
def _flooding(site: dict[str, Any], kind: str, seconds: float) -> Iterator[None]:
    """Floods from another process until the end of the block."""
    plan = {"site": site, "kind": kind, "seconds": seconds + 1}
    command = [sys.executable, "-m", "tests.benchmarks.user_floods"]
    with subprocess.Popen(
        command, cwd=REPOSITORY, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as flood:
        assert flood.stdin is not None
        assert flood.stdout is not None
        flood.stdin.write(json.dumps(plan))
        flood.stdin.close()
        flood.stdout.readline()  # it begins
        yield
        flood.wait()


def flood() -> None:
    """Runs one kind of attack, as the plan on stdin says."""
    import asyncio
    import os
    from collections import Counter

    from tests.hostile.guest import NICEST, before, tried
    from tests.hostile.wire import Site

    os.nice(NICEST)
    plan = json.load(sys.stdin)
    print("begins", flush=True)
    until = time.time() + plan["seconds"]
    asyncio.run(tried(plan["kind"], Site(**plan["site"]), Counter(), before(until)))


if __name__ == "__main__":
    flood()
