"""The report of an evaluation: one self-contained page, which makes no request.

Foreign text (names, notes, lines of logs) enters the page as data, in one block of JSON whose `<`, `>` and
`&` are escaped, and is shown by `textContent`. The policy allows the page's own script and style by their
hashes.
"""

from __future__ import annotations

import base64
import hashlib
import html
import json
import math
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.summary import Apart
from executor.universes.version import version_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from executor.evaluation.outcome import Outcome
    from executor.evaluation.summary import Pairs, Summary
    from executor.universes.model import Model, Universe

_PAGE: Final = Path(__file__).with_name("page")
_ESCAPED: Final = {ord(c): f"\\u{ord(c):04x}" for c in "<>&\u2028\u2029"}
_PAGE_HTML: Final = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>{style}</style>
</head>
<body>
<main id="report"><noscript>This report needs JavaScript, which it brings along.</noscript></main>
<script type="application/json" id="data">{data}</script>
<script>{script}</script>
</body>
</html>
"""


def report_html(document: dict[str, Any]) -> str:
    """Returns the page that shows a document of `report_data`."""
    return page_html(document, "report")


def page_html(document: dict[str, Any], kind: str) -> str:
    """Returns a self-contained page that shows a document: `report`, or `tuning` for a study."""
    style = (_PAGE / "report.css").read_text(encoding="utf-8")
    script = "".join((_PAGE / f"{name}.js").read_text(encoding="utf-8") for name in ("elements", kind))
    policy = (
        f"default-src 'none'; script-src '{_hash(script)}'; style-src '{_hash(style)}'; img-src data:; "
        "base-uri 'none'; form-action 'none'"
    )
    title = html.escape(f"{document['evaluation']} · {document['project']}")
    return _PAGE_HTML.format(policy=policy, title=title, style=style, script=script, data=embedded(document))


def embedded(document: dict[str, Any]) -> str:
    """Returns a document as JSON that can stand in a script element."""
    return json.dumps(document, ensure_ascii=False, separators=(",", ":")).translate(_ESCAPED)


def _hash(text: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def report_data(  # noqa: PLR0913 - the parts of the report
    summary: Summary,
    universe: Universe | None,
    *,
    project: str,
    path: str,
    evaluation: str,
    gates: Sequence[tuple[str, bool]] = (),
    pairs: Pairs | Apart | None = None,
    fingerprints: Sequence[str] = (),
    judged_by: str | None = None,
    notes: Sequence[str] = (),
) -> dict[str, Any]:
    """Returns all that the page shows.

    Args:
        summary: the results.
        universe: the universe, as written; its still things are the plan of the world. Without it the
            caller adds the plan.
        project: the name of the project.
        path: the project, as it was given on the command line.
        evaluation: the name of the evaluation.
        gates: the text of each gate's verdict, and whether it passed.
        pairs: the comparison with another version.
        fingerprints: those of the machines.
        judged_by: the project that the evaluation is of, if it is another one.
        notes: a line for each part of the project that did not run, such as a launch node.
    """
    low, high = summary.interval
    return {
        "project": project,
        "evaluation": evaluation,
        "rate": summary.rate,
        "low": low,
        "high": high,
        "successes": summary.successes,
        "counted": summary.counted,
        "wanted": summary.wanted,
        "complete": summary.is_complete,
        "sequential": summary.sequential,
        "stopped_early": summary.stopped_early,
        "counts": summary.counts,
        "gates": [{"text": text, "passes": passes} for text, passes in gates],
        "against": None if pairs is None else _against(pairs),
        "runs": [_run(outcome) for outcome in summary.outcomes],
        "measures": {
            name: [
                [outcome.seed, outcome.measures[name]]
                for outcome in summary.outcomes
                if name in outcome.measures
            ]
            for name in summary.measures
        },
        "coverage": coverage_of(summary.outcomes),
        "worst": [
            {
                "seed": outcome.seed,
                "outcome": outcome.outcome,
                "why": outcome.why,
                "end_s": outcome.end_s,
                "items": [item for item in outcome.items if not item["holds"]],
                "drawn": outcome.drawn,
                "faults": outcome.faults,
                "command": command_of(path, evaluation, outcome.seed, judged_by),
            }
            for outcome in summary.worst()
        ],
        "plan": {} if universe is None else plan_of(universe),
        "fingerprints": list(fingerprints),
        "notes": list(notes),
    }


def command_of(path: str, evaluation: str, seed: int, judged_by: str | None = None) -> str:
    """Returns the command that plays a run again and records it."""
    words = ["bt-studio", "run", path, "--evaluation", evaluation, "--seed", str(seed)]
    words += [] if judged_by is None else ["--judged-by", judged_by]
    return shlex.join([*words, "--record", f"seed-{seed}.mcap"])


def coverage_of(outcomes: Sequence[Outcome]) -> list[dict[str, Any]]:
    """Returns, for each node that some run ticked, in how many runs it had each result."""
    found: dict[str, dict[str, int]] = {}
    for outcome in outcomes:
        for node, letters in outcome.seen.items():
            counts = found.setdefault(node, {"S": 0, "F": 0, "R": 0, "K": 0, "runs": 0})
            counts["runs"] += bool(letters)
            for letter in letters:
                counts[letter] += 1
    return [{"node": node, **counts} for node, counts in found.items()]


def plan_of(universe: Universe) -> dict[str, Any]:
    """Returns the plan of a world, in m: outlines of its solid models and of its areas; and its version."""
    outlines = [outline for model in universe.models if model.solid for outline in _outline(model)]
    areas = [
        {"name": name, "corners": [list(c) for c in area.corners]} for name, area in universe.areas.items()
    ]
    return {"outlines": outlines, "areas": areas, "universe": world_of(universe)}


def world_of(universe: Universe) -> dict[str, str]:
    """Returns the name and the version of the universe that results are of."""
    return {"name": universe.name, "version": version_of(universe)}


def _outline(model: Model) -> list[list[list[float]]]:
    x, y, *_, yaw = model.pose
    if model.shape == "box":
        corners = [
            (sx * model.size[0] / 2, sy * model.size[1] / 2)
            for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))
        ]
    elif model.shape in {"cylinder", "sphere"}:
        turns = [math.tau * step / 16 for step in range(16)]
        corners = [(model.size[0] * math.cos(turn), model.size[0] * math.sin(turn)) for turn in turns]
    else:
        return []
    cosine, sine = math.cos(yaw), math.sin(yaw)
    return [[[round(x + a * cosine - b * sine, 3), round(y + a * sine + b * cosine, 3)] for a, b in corners]]


def _run(outcome: Outcome) -> dict[str, Any]:
    return {
        "seed": outcome.seed,
        "outcome": outcome.outcome,
        "why": outcome.why,
        "end_s": outcome.end_s,
        "path": [point[1:] for point in outcome.path],
        "bumps": [bump[1:3] for bump in outcome.bumps],
    }


def _against(pairs: Pairs | Apart) -> dict[str, Any]:
    lines = list(pairs.lines())
    if isinstance(pairs, Apart):
        return {"lines": lines, "only_older": (), "only_newer": ()}
    return {"lines": lines, "only_older": pairs.only_older, "only_newer": pairs.only_newer}
