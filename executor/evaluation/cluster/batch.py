"""A batch of seeds on one machine: `python -m executor.evaluation.cluster.batch`.

Standard input has a line of JSON (seeds, limits, length of the parcel) and the parcel. Standard output gets a
line for each run that has ended. The runs are forks of this process, which has one thread; what starts it (a
worker of Ray) has many.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, BinaryIO

from executor.evaluation.cluster.parcel import unpack
from executor.evaluation.evaluate import load_libraries, supervisor_of
from executor.evaluation.fingerprint import fingerprint
from executor.evaluation.pool.worker import Done, Limits, read_done
from executor.supervision.confine import die_with_parent
from executor.supervision.signal_names import how_ended
from executor.supervision.single_threaded import SINGLE_THREADED

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence


@dataclass(frozen=True)
class Batch:
    """The result of a batch: the runs that ended, and how the supervisor was lost, if it was."""

    done: tuple[Done, ...]
    fingerprint: dict[str, str]
    lost: str = ""
    node: str = field(default_factory=platform.node)


def run_batch(parcel: bytes, seeds: Sequence[int], limits: Limits | None) -> Batch:
    """Runs seeds in a new supervisor; without limits, the first one tells what they are."""
    head = {"seeds": list(seeds), "limits": None if limits is None else asdict(limits), "bytes": len(parcel)}
    with subprocess.Popen(
        [sys.executable, "-m", "executor.evaluation.cluster.batch"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=_environment(),
    ) as process:
        said, wrong = process.communicate(json.dumps(head).encode() + b"\n" + parcel)
    lines = [line for line in said.splitlines(keepends=True) if line.endswith(b"\n")]
    if not lines:
        return Batch((), {}, _why(process.returncode, wrong))
    done = tuple(_read(lines[1:]))
    lost = "" if process.returncode == 0 else _why(process.returncode, wrong)
    return Batch(done, json.loads(lines[0]), lost)


def _environment() -> dict[str, str]:
    """Returns the environment of the supervisor: that of the worker, without what Ray brings.

    The token of the cluster is of no use to the user's code.
    """
    mine = {name: value for name, value in os.environ.items() if not name.startswith("RAY_")}
    found = {**mine, **SINGLE_THREADED}
    paths = [path for path in found.pop("PYTHONPATH", "").split(os.pathsep) if path and "/ray/" not in path]
    return found | ({"PYTHONPATH": os.pathsep.join(paths)} if paths else {})


def _read(lines: Sequence[bytes]) -> Iterator[Done]:
    for line in lines:
        try:
            yield read_done(line)
        except (ValueError, TypeError):
            return


def _why(status: int, wrong: bytes) -> str:
    last = wrong.decode(errors="replace").strip().splitlines()[-1:]
    return f"its supervisor {how_ended(status)}" + (f": {last[0][:300]}" if last else "")


def serve(lines: BinaryIO, out: int) -> None:
    """Runs the batch that a stream has, and writes what has ended to a descriptor."""
    head = json.loads(lines.readline())
    parcel = lines.read(head["bytes"])
    os.write(out, json.dumps(fingerprint()).encode() + b"\n")
    plan = unpack(parcel)
    load_libraries()

    def told(done: Done) -> bool:
        data = done.to_line()
        while data:
            data = data[os.write(out, data) :]
        return True

    limits = None if head["limits"] is None else Limits(**head["limits"])
    with supervisor_of(plan, 1) as supervisor:
        supervisor.run(head["seeds"], told, limits=limits)


def main() -> None:
    """Serves standard input."""
    die_with_parent()
    out = os.dup(1)
    os.dup2(2, 1)  # what libraries print is no outcome
    os.set_inheritable(out, False)  # noqa: FBT003 - positional in os
    serve(sys.stdin.buffer, out)


if __name__ == "__main__":
    main()
