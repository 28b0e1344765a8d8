"""Runs behaviour tests with leaves that are `real`: the project's Python runs in a process of its own.

`python -m executor.tools.behaviours` reads a job and the names of the tests as JSON, and writes their
results. It ends by itself soon after its limit, and no process of a test outlives it.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.tools.answering import answer
from tree_gardener.testing.apart import run_apart
from tree_gardener.testing.job import Job

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection

    from tree_gardener.testing import Result

__all__ = ["run_behaviours", "run_job", "serve_behaviours"]

LIMIT_S: Final = 50.0
"""How long all tests of a request may take; those after it are not run."""
WALL_S: Final = 15.0
"""How long one test may take: an action that sleeps uses no processor time."""
LAST_S: Final = LIMIT_S + WALL_S + 10.0
_ROOT: Final = str(Path(__file__).resolve().parents[2])


class _OverError(Exception):
    """The time of the request is over."""


def run_job(document: dict[str, Any], *, limit_s: float = LIMIT_S, wall_s: float = WALL_S) -> dict[str, Any]:
    """Runs tests of a job; returns their `results`, in the order of the tests, as far as the time sufficed.

    Args:
        document: `job`, and `run` with file and name of each test.
        limit_s: the time for all of them.
        wall_s: the time for each of them.
    """
    job = Job.from_json(document["job"])
    wanted = {(file, name) for file, name in document["run"]}
    cases = [case for case in job.cases(job.suite())[0] if (case.file, case.name) in wanted]
    results: list[Result] = []
    end_s = time.monotonic() + limit_s

    def hear(result: Result) -> None:
        results.append(result)
        if time.monotonic() > end_s:
            raise _OverError

    with contextlib.suppress(_OverError):
        run_apart(job, cases, told=hear, wall_s=wall_s)
    return {"results": [result.to_json() for result in results]}


async def run_behaviours(text: str) -> str:
    """Runs the tests that a text asks for in a child; returns its answer, "" if it gave none.

    The child is ended if this is cancelled.
    """
    process = await asyncio.create_subprocess_exec(
        sys.executable,
        "-m",
        "executor.tools.behaviours",
        stdin=asyncio.subprocess.PIPE,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.DEVNULL,
        cwd=_ROOT,
        env={"PATH": os.environ.get("PATH", os.defpath), "LANG": "C.UTF-8", "OPENBLAS_NUM_THREADS": "1"},
    )
    try:
        output, _ = await asyncio.wait_for(process.communicate(text.encode()), LAST_S)
    except TimeoutError:
        return ""
    finally:
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        await process.wait()
    return output.decode() if process.returncode == 0 else ""


async def serve_behaviours(connection: ServerConnection) -> None:
    """Receives `{job, run}` as JSON, and answers `{results}`; "" if that cannot be done.

    The tests end with the connection.
    """
    asked = await connection.recv()
    text = asked if isinstance(asked, str) else asked.decode()
    await answer(connection, run_behaviours(text))


def main() -> None:
    """Reads the job from standard input, and writes the results to standard output."""
    found = run_job(json.load(sys.stdin))
    json.dump(found, sys.stdout, default=str)


if __name__ == "__main__":
    main()
