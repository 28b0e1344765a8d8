"""Runs tests in a separate process, so that no test can harm the caller.

The process reads one job from its standard input and writes one line of JSON for each start and each result
to a pipe. A test that ends the process, or does not end, is one failure; the tests after it continue in a new
process. What the tests start ends with the process, also what has left its session (`descendants.guarded`).
"""

import contextlib
import functools
import json
import os
import selectors
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import IO, Any, Final

from tree_gardener.testing.cases import Case, Failure, Result
from tree_gardener.testing.job import Job
from tree_gardener.testing.limits import MEMORY_BYTES, PROCESSOR_S, OverLimitError, memory, processor_time

WALL_S: Final = 60.0
"""How long a test may take by the wall clock: an action that sleeps uses no processor time."""
_LONGEST_LINE: Final = 64 * 1024 * 1024
_PATIENCE_S: Final = 5.0
_END: Final = "null"
"""The last line: a process that an action forked may hold the pipe open for longer than the tests."""


def run_apart(
    job: Job,
    cases: Sequence[Case],
    *,
    told: Callable[[Result], None] | None = None,
    wall_s: float = WALL_S,
    processor_s: float = PROCESSOR_S,
) -> list[Result]:
    """Runs tests of a job in another process; returns their results in the same order.

    Args:
        job: the job.
        cases: those of its tests to run.
        told: called with each result as it comes.
        wall_s: the time that one test may take.
        processor_s: the processor time that one test may take.
    """
    results: list[Result] = []
    while len(results) < len(cases):
        left = cases[len(results) :]
        document = {
            "job": job.to_json(),
            "run": [[case.file, case.name] for case in left],
            "processor_s": processor_s,
        }
        count = len(results)
        reason = ""
        for item in _lines(document, wall_s):
            if isinstance(item, str):
                reason = item
                break
            results.append(Result.from_json(item))
            if told is not None:
                told(results[-1])
        if len(results) < len(cases):
            at = cases[len(results)]
            text = reason or "the process of the test ended before its result"
            failed = Result(at.name, at.file, at.line, at.tree, (Failure(text, at.line),))
            results.append(failed)
            if told is not None:
                told(failed)
        assert len(results) > count  # each process brings one result or more
    return results


def _lines(document: dict[str, Any], wall_s: float) -> Iterator[dict[str, Any] | str]:
    """Yields the results of one process; at last a sentence if it did not end by itself."""
    reading, writing = os.pipe()
    environment = {**os.environ, "PYTHONHASHSEED": "0"}
    with subprocess.Popen(
        [sys.executable, "-m", "tree_gardener.testing", str(writing), str(os.getpid())],
        stdin=subprocess.PIPE,
        stdout=sys.stderr if _has_descriptor(sys.stderr) else subprocess.DEVNULL,
        pass_fds=(writing,),
        env=environment,
        start_new_session=True,
    ) as process:
        os.close(writing)
        with os.fdopen(reading, "rb", buffering=0) as pipe:
            try:
                assert process.stdin is not None
                try:
                    process.stdin.write(json.dumps(document).encode())
                    process.stdin.close()
                except BrokenPipeError:
                    pass
                yield from _read(pipe, process.pid, wall_s)
            finally:
                _end(process)


def _end(process: subprocess.Popen[bytes]) -> None:
    """Ends the process, which first ends all that the tests have started."""
    process.terminate()
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(_PATIENCE_S)
        return
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)  # a test has stopped it


def _has_descriptor(stream: Any) -> bool:
    try:
        stream.fileno()
    except (AttributeError, OSError, ValueError):
        return False
    return True


def _read(pipe: IO[bytes], pid: int, wall_s: float) -> Iterator[dict[str, Any] | str]:
    held = b""
    with selectors.DefaultSelector() as selector, _end_of(pid) as ends:
        selector.register(pipe, selectors.EVENT_READ)
        for end in ends:
            selector.register(end, selectors.EVENT_READ)
        while True:
            ready = selector.select(wall_s)
            if not ready:
                yield f"the test did not end within {wall_s:g} s"
                return
            if all(key.fileobj is not pipe for key, _ in ready):
                return
            data = pipe.read(1 << 16)
            if not data:
                return
            held += data
            if len(held) > _LONGEST_LINE:
                yield "the result of the test is too large"
                return
            *lines, held = held.split(b"\n")
            for line in lines:
                if (item := json.loads(line)) is None:
                    return
                yield item


@contextlib.contextmanager
def _end_of(pid: int) -> Iterator[list[int]]:
    """Yields a descriptor that is ready when a process has ended; on Linux."""
    if not hasattr(os, "pidfd_open"):
        yield []
        return
    fd = os.pidfd_open(pid)
    try:
        yield [fd]
    finally:
        os.close(fd)


def serve() -> int:
    """Runs the job on standard input; results go to the file descriptor that the first argument names."""
    with os.fdopen(int(sys.argv[1]), "w", encoding="utf-8") as pipe:
        os.set_inheritable(pipe.fileno(), False)  # noqa: FBT003 - its only form
        document = json.load(sys.stdin)
        job = Job.from_json(document["job"])
        suite = job.suite()
        cases = {(case.file, case.name): case for case in job.cases(suite)[0]}
        for file, name in document["run"]:
            case = cases[file, name]
            result = bounded(functools.partial(suite.run, case), case, document["processor_s"])
            pipe.write(json.dumps(result.to_json(), default=str) + "\n")
            pipe.flush()
        pipe.write(f"{_END}\n")
    return 0


def bounded(run: Callable[[], Result], case: Case, processor_s: float = PROCESSOR_S) -> Result:
    """Runs a test within its limits."""
    try:
        with memory(), processor_time(processor_s):
            return run()
    except OverLimitError:
        text = f"the test needs more than {processor_s:g} s of processor time"
    except MemoryError:
        text = f"the test needs more than {MEMORY_BYTES // 1024 // 1024} MB of memory"
    return Result(case.name, case.file, case.line, case.tree, (Failure(text, case.line),))
