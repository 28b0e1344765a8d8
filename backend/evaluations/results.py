"""Reports and comparisons, put together by a child with limits; nothing of it is imported here.

The child is `executor.evaluation.served.stored`, known by its command alone. Its output goes to a
temporary file, so that nobody holds it in memory.
"""

from __future__ import annotations

import json
import logging
import os
import subprocess
import sys
from typing import IO, TYPE_CHECKING, Annotated, Any, Final

import msgspec
from msgspec import Meta

from backend.config.environment import REPOSITORY
from backend.core.scratch import scratch
from backend.evaluations import queries
from backend.evaluations.errors import ReportError, WrongStateError

if TYPE_CHECKING:
    from backend.evaluations.models import Evaluation

log = logging.getLogger(__name__)

DEADLINE_S: Final = 70.0  # the child ends itself after 60 s of processor time
MOST_COMPARISON: Final = 8 << 20
_PASSED: Final = ("PATH", "LANG", "LC_ALL", "PYTHONPATH")
_SINGLE: Final = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
_Number = Annotated[float, Meta(ge=-1e15, le=1e15)]
_Seeds = Annotated[list[int], Meta(max_length=100_000)]


class MeasureDifference(msgspec.Struct):
    """The difference of a measure: newer minus older, with its interval, over so many pairs."""

    name: str
    pairs: int
    difference: tuple[_Number, _Number, _Number]


class Comparison(msgspec.Struct):
    """The comparison of two versions on the same seeds."""

    difference: tuple[_Number, _Number, _Number]
    p: _Number
    both: int
    neither: int
    only_older: _Seeds
    only_newer: _Seeds
    measures: Annotated[list[MeasureDifference], Meta(max_length=200)]


def report_of(found: Evaluation) -> IO[bytes]:
    """Returns the page of an evaluation as a file; the caller closes it. It takes seconds.

    Raises:
        WrongStateError: there are no outcomes.
        ReportError: the child gave up.
    """
    about = found.results.get(str(found.revision), {})
    if not about.get("done"):
        raise WrongStateError("There are no outcomes yet.", hint="Wait for the first run.")
    document = {
        "project": found.project.name,
        "path": found.project.name,
        "evaluation": found.name,
        "wanted": about["wanted"],
        "most": found.wanted or about["wanted"],
        "sequential": found.sequential,
        "notes": found.notes.splitlines(),
        "plan": found.plan or {"outlines": [], "areas": []},
    }
    return _ask("report", found, document)


def comparison_of(found: Evaluation) -> Comparison:
    """Returns the comparison of an evaluation with its older revision. It takes seconds.

    Raises:
        WrongStateError: it is not compared with another revision.
        ReportError: the child gave up.
    """
    if found.older is None:
        raise WrongStateError("The evaluation is not compared with another revision.")
    with _ask("compare", found, {}) as file:
        file.seek(0)
        data = file.read(MOST_COMPARISON)
    try:
        return msgspec.json.decode(data, type=Comparison)
    except msgspec.DecodeError as error:
        raise ReportError("The comparison cannot be read.") from error


def _ask(what: str, found: Evaluation, document: dict[str, Any]) -> IO[bytes]:
    source = scratch().file(key=f"outcomes of {found.id}")
    out = scratch().file(key=f"{what} of {found.id}")
    try:
        with source:
            source.write(json.dumps(document).encode() + b"\n")
            _write_lines(source, found, found.revision)
            source.write(b"\n")
            if found.older is not None:
                _write_lines(source, found, found.older)
            source.seek(0)
            done = subprocess.run(
                [sys.executable, "-m", "executor.evaluation.served.stored", what],
                cwd=REPOSITORY,
                env={key: os.environ[key] for key in _PASSED if key in os.environ} | _SINGLE,
                stdin=source,
                stdout=out,
                stderr=subprocess.PIPE,
                timeout=DEADLINE_S,
                check=False,
            )
        if done.returncode:
            why = done.stderr[-500:].decode(errors="replace")
            log.warning("the %s of evaluation %s: %s", what, found.id, why)
            raise ReportError("The outcomes are too many or too large.", hint="Download runs.jsonl instead.")
    except subprocess.TimeoutExpired as error:
        out.close()
        raise ReportError("It took too long.", hint="Download runs.jsonl instead.") from error
    except BaseException:
        out.close()
        raise
    return out


def _write_lines(file: IO[bytes], found: Evaluation, revision: int) -> None:
    for line in queries.lines(found, revision):
        file.write(line.encode() + b"\n")
