"""Summarises stored outcomes: `python -m executor.evaluation.served.stored report|compare`.

The web server starts it as a process of its own, since what it reads comes from users' programs. It reads
from stdin a line with a JSON object, then the lines of `runs.jsonl`, an empty line, and those of the older
version. It writes `report.html`, or the comparison as JSON.

The object has for a report: project, path, evaluation, wanted, sequential, plan; a comparison needs none.
"""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.outcome import Outcome, read_outcome
from executor.evaluation.report import report_data, report_html
from executor.evaluation.statistics import mcnemar
from executor.evaluation.summary import Pairs, Summary, pair
from executor.supervision.confine import confine_reader

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

__all__ = ["comparison", "main", "report"]

MEMORY_BYTES: Final = 1 << 30
SECONDS: Final = 60
REPORT_BYTES: Final = 64 << 20


def comparison(pairs: Pairs) -> dict[str, Any]:
    """Returns a comparison of two versions as JSON."""
    value, low, high = pairs.difference
    return {
        "difference": [value, low, high],
        "p": mcnemar(len(pairs.only_older), len(pairs.only_newer)),
        "both": len(pairs.both),
        "neither": len(pairs.neither),
        "only_older": list(pairs.only_older),
        "only_newer": list(pairs.only_newer),
        "measures": [
            {"name": name, "pairs": count, "difference": list(difference)}
            for name, (count, difference) in pairs.measures.items()
        ],
    }


def report(about: dict[str, Any], newer: Sequence[Outcome], older: Sequence[Outcome]) -> str:
    """Returns the page of an evaluation."""
    summary = Summary(
        tuple(newer),
        about["wanted"],
        about["sequential"],
        stopped_early=about["sequential"] and len(newer) < about["most"],
    )
    data = report_data(
        summary,
        None,
        project=about["project"],
        path=about["path"],
        evaluation=about["evaluation"],
        pairs=pair(older, newer) if older else None,
        notes=about["notes"],
    )
    return report_html({**data, "plan": about["plan"]})


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command; returns the exit status."""
    [what] = arguments if arguments is not None else sys.argv[1:]
    confine_reader(MEMORY_BYTES, SECONDS, REPORT_BYTES)
    lines = iter(sys.stdin.buffer)
    about = json.loads(next(lines))
    newer, older = list(_outcomes(lines)), list(_outcomes(lines))
    if what == "report":
        sys.stdout.write(report(about, newer, older))
    else:
        json.dump(comparison(pair(older, newer)), sys.stdout)
    return 0


def _outcomes(lines: Iterable[bytes]) -> Iterator[Outcome]:
    for line in lines:
        if not line.strip():
            return
        yield read_outcome(line)


if __name__ == "__main__":
    sys.exit(main())
