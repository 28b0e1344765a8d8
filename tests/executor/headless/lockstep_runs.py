"""Runs projects in lock-step, as `bt-studio run` does: reads their names from stdin and answers with JSON."""

import contextlib
import io
import json
import sys
from pathlib import Path

from backend.cli.run import run
from backend.cli.shared.errors import CliError


def main() -> None:
    for line in sys.stdin:
        folder, duration_s = json.loads(line)
        report = Path(folder) / "report.json"
        said, status = io.StringIO(), 0
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            try:
                run(
                    folder,
                    universe=None,
                    robot=None,
                    duration=duration_s,
                    lockstep=True,
                    seed=0,
                    report=report,
                    record=None,
                    as_json=False,
                )
            except CliError as error:
                status = error.status
                said.write(f"{error}\n")
        written = json.loads(report.read_text()) if report.exists() else {}
        report.unlink(missing_ok=True)
        print(json.dumps({"status": status, "report": written, "said": said.getvalue()}), flush=True)  # noqa: T201 - the result


main()
