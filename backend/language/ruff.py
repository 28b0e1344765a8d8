"""Formats and checks texts with ruff, without the user's configuration and with limits.

On localhost ruff is a child of the web server; elsewhere it runs in the user's container (`places.py`). A run
is stopped after some seconds.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

from backend.language.errors import PythonRefusedError

LINE_LENGTH: Final = 110
TIMEOUT_S: Final = 5
MAX_SOURCE_BYTES: Final = 1024 * 1024
# Rules for probable errors. The formatter handles style; the language server finds undefined names, too.
RULES: Final = "F,B,E7,E9,W605,PLE,RUF100"
IGNORED: Final = "F821,F405,F811,B027"
_MAX_FINDINGS: Final = 200

# A function from arguments and source to exit status and output; the status is None after a timeout.
Run = Callable[[list[str], str], tuple[int | None, str]]


def format_source(source: str, filename: str, run: Run) -> dict[str, Any]:
    """Returns the source as `ruff format` writes it; one that does not parse, unchanged with its errors.

    Raises:
        PythonRefusedError: it is too long, or takes too long.
    """
    status, output = _run(run, ["format", "--line-length", str(LINE_LENGTH)], source, filename)
    if status == 0:
        return {"source": output, "findings": []}
    errors = [each for each in findings(source, filename, run) if each["severity"] == "error"]
    return {"source": source, "findings": errors}


def findings(source: str, filename: str, run: Run) -> list[dict[str, Any]]:
    """Returns ruff's findings in the source, each with the edits that fix it.

    Lines and columns count from 1; columns are in code points.
    """
    options = ["--output-format", "json", "--select", RULES, "--ignore", IGNORED]
    _, output = _run(run, ["check", "--exit-zero", "--no-fix", *options], source, filename)
    try:
        found = json.loads(output or "[]")
    except ValueError as error:
        raise PythonRefusedError("The checker gave no answer.", hint="Try again.") from error
    return [_finding(each) for each in found[:_MAX_FINDINGS]]


def _finding(found: dict[str, Any]) -> dict[str, Any]:
    code = found.get("code") or "syntax"
    fix = found.get("fix")
    return {
        "code": code,
        "severity": "error" if code in {"syntax", "invalid-syntax"} else "warning",
        "message": found["message"],
        "start": _place(found["location"]),
        "end": _place(found["end_location"]),
        "fix": fix
        and {
            "message": fix.get("message") or found["message"],
            "edits": [
                {
                    "start": _place(edit["location"]),
                    "end": _place(edit["end_location"]),
                    "content": edit["content"],
                }
                for edit in fix["edits"]
            ],
        },
    }


def _place(location: dict[str, int]) -> dict[str, int]:
    return {"line": location["row"], "column": location["column"]}


def _run(run: Run, arguments: list[str], source: str, filename: str) -> tuple[int, str]:
    if len(source.encode()) > MAX_SOURCE_BYTES:
        raise PythonRefusedError("The file is too long to be formatted or checked.", hint="Split it.")
    options = ["--isolated", "--no-cache", "--target-version", "py311", "--stdin-filename", filename, "-"]
    status, output = run(arguments + options, source)
    if status is None:
        raise PythonRefusedError("The formatter did not answer.", hint="Try again.")
    return status, output


def run_beside(arguments: list[str], source: str) -> tuple[int | None, str]:
    """Runs ruff as a child process; returns its status (None after a timeout) and its output."""
    try:
        done = subprocess.run(
            [str(Path(sys.executable).with_name("ruff")), *arguments],
            input=source,
            capture_output=True,
            encoding="utf-8",
            timeout=TIMEOUT_S,
            check=False,
            cwd="/",
            env={"PATH": os.defpath, "LANG": "C.UTF-8", "RAYON_NUM_THREADS": "1"},
        )
    except (OSError, subprocess.TimeoutExpired):
        return None, ""
    return done.returncode, done.stdout
