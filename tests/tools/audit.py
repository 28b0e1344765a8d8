"""`make audit`: asks the advisory services about every package of the locks.

It needs the internet, and its answer changes by the day, so it is no part of `make test`. Status 0: nothing
is known; 1: something is; 2: a service could not be reached, which means nothing for the packages.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, NamedTuple

REPOSITORY = Path(__file__).parents[2]
UV = Path(sys.executable).with_name("uv")
PYTHON_LOCKS = ("requirements-dev.lock", "requirements-docs.lock")
NPM_FOLDER = REPOSITORY / "frontend"
AUDITOR = "pip-audit>=2.9,<3"


class Answer(NamedTuple):
    """The answer of a service."""

    packages: int = 0
    known: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()
    """Packages that the service does not know."""
    trouble: str = ""


def read_pip(out: str, err: str) -> Answer:
    """Reads the output of `pip-audit -f json`."""
    try:
        rows: list[dict[str, Any]] = json.loads(out)["dependencies"]
    except (ValueError, KeyError):
        return Answer(trouble=(err.strip().splitlines() or ["it said nothing"])[-1])
    flaws = [(row, one) for row in rows for one in row.get("vulns", ())]
    known = [
        f"{row['name']} {row['version']}: {one['id']}, fixed in {' or '.join(one['fix_versions']) or 'none'}"
        for row, one in flaws
    ]
    unknown = [row["name"] for row in rows if "skip_reason" in row]
    if unknown and len(unknown) == len(rows):
        return Answer(trouble="the service knows none of the packages")
    return Answer(len(rows), tuple(known), tuple(unknown))


def read_npm(out: str, err: str) -> Answer:
    """Reads the output of `npm audit --json`."""
    try:
        document: dict[str, Any] = json.loads(out)
    except ValueError:
        return Answer(trouble=(err.strip().splitlines() or ["it said nothing"])[-1])
    if "metadata" not in document:
        error = document.get("error") or {}
        return Answer(trouble=document.get("message") or error.get("summary") or "it gave no report")
    known = [
        f"{name} {row['range']}: {row['severity']}"
        + (
            f", {titles[0]}"
            if (titles := [via["title"] for via in row["via"] if isinstance(via, dict)])
            else ""
        )
        for name, row in sorted(document["vulnerabilities"].items())
    ]
    return Answer(document["metadata"]["dependencies"]["total"], tuple(known))


def report(what: str, answer: Answer) -> int:
    """Prints an answer; returns the status."""
    if answer.trouble:
        print(f"{what}: NOT asked: the advisory service could not be reached, or refused: {answer.trouble}")
        return 2
    print(f"{what}: {answer.packages} packages, {len(answer.known) or 'no'} known vulnerabilities")
    for line in answer.known:
        print(f"  {line}")
    if answer.unknown:
        print(f"  not known to the service: {', '.join(answer.unknown)}")
    return 1 if answer.known else 0


def ask(command: list[str | Path], folder: Path) -> tuple[str, str]:
    """Returns both outputs of a program; a status other than 0 is a result too."""
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    except OSError as error:
        return "", f"{command[0]}: {error.strerror}"
    return done.stdout, done.stderr


def main() -> int:
    """Asks both."""
    with tempfile.TemporaryDirectory() as cache:
        pip: list[str | Path] = [
            UV,
            "tool",
            "run",
            "--from",
            AUDITOR,
            "pip-audit",
            *(f"--requirement={REPOSITORY / lock}" for lock in PYTHON_LOCKS),
            "--disable-pip",
        ]
        pip += ["--format", "json", "--progress-spinner", "off", "--cache-dir", cache]
        python = report("Python", read_pip(*ask(pip, REPOSITORY)))
    npm = report("npm", read_npm(*ask(["npm", "audit", "--package-lock-only", "--json"], NPM_FOLDER)))
    return 1 if 1 in {python, npm} else max(python, npm)


if __name__ == "__main__":
    sys.exit(main())
