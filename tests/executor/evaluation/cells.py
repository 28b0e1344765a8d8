"""Runs seeds of evaluations in a process of its own: jobs from stdin, one a line, outcomes to stdout."""

import contextlib
import dataclasses
import io
import json
import sys
from pathlib import Path

from executor.evaluation.plan import make_plan, sealed
from executor.evaluation.run import run_cell
from translator import open_path


def main() -> None:
    for line in sys.stdin:
        job = json.loads(line)
        with contextlib.redirect_stdout(io.StringIO()):
            plan = make_plan(open_path(Path(job["folder"])), job.get("name", "main"))
            plan = dataclasses.replace(plan, to_the_end=job.get("to_the_end", False))
            plan = sealed(plan) if job.get("sealed") else plan
            if "duration_s" in job:
                shorter = plan.evaluation.model_copy(update={"duration_s": job["duration_s"]})
                plan = dataclasses.replace(plan, evaluation=shorter)
            recording = Path(job["recording"]) if "recording" in job else None
            found = run_cell(plan, job["seed"], recording=recording)
        print(found.to_line(), flush=True)  # noqa: T201 - the result


main()
