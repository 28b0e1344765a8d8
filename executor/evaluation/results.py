"""The folder of results: `evaluation.json`, and `runs.jsonl` with one line a seed, in their order."""

from __future__ import annotations

import hashlib
import json
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.fingerprint import differences
from executor.evaluation.outcome import Outcome, read_outcome
from executor.evaluation.report import world_of

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from executor.evaluation.plan import Plan

HEADER: Final = "evaluation.json"
RUNS: Final = "runs.jsonl"
PART: Final = "runs.part.jsonl"
FORMAT: Final = "bt-studio/evaluation-results"


class ResultsError(Exception):
    """A folder of results cannot be used; the text says why."""


def kept_outcomes(
    results: Results, plan: Plan, mine: dict[str, str]
) -> tuple[list[Outcome], list[dict[str, str]], list[str]]:
    """Reads the folder of a plan; returns the outcomes to keep, all fingerprints, and notes about these.

    Runs that failed for reasons outside of the project are repeated.

    Raises:
        ResultsError: there are no results, or they are of another project or evaluation.
    """
    header = results.header()
    if header.get("inputs") != inputs_of(plan):
        raise ResultsError(
            f"{results.folder / HEADER}:1:1: the results are of another version of the project or "
            "evaluation; name another folder"
        )
    world, made_in = world_of(plan.universe), header.get("universe")
    if made_in not in {None, world["version"]}:
        raise ResultsError(
            f"{results.folder / HEADER}:1:1: the results are of version {made_in} of the world "
            f"“{world['name']}”, which is {world['version']} now; name another folder"
        )
    earlier: list[dict[str, str]] = header.get("fingerprints", [])
    notes = [
        f"the results were made on another platform: {'; '.join(differences(mine, other))}"
        for other in earlier
        if other.get("id") != mine["id"]
    ]
    prints = [*earlier, *([] if any(other.get("id") == mine["id"] for other in earlier) else [mine])]
    return [outcome for outcome in results.outcomes() if outcome.is_counted], prints, notes


def inputs_of(plan: Plan) -> str:
    """Returns the digest of all that decides the outcomes: the project's files, and the evaluation."""
    digest = hashlib.sha256(f"{plan.name}\n{plan.to_the_end}\n{'sealed' * plan.sealed}".encode())
    for path, data in sorted(plan.project.files.items()):
        digest.update(f"{path}\n{len(data)}\n".encode())
        digest.update(data)
    return digest.hexdigest()


class Results:
    """A folder of results. Each outcome is on the disk as soon as it is known."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    @property
    def folder(self) -> Path:
        """The folder."""
        return self._folder

    def header(self) -> dict[str, Any]:
        """Returns the header of the results that the folder holds.

        Raises:
            ResultsError: it holds none.
        """
        path = self._folder / HEADER
        try:
            document = json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise ResultsError(f"{path}:1:1: there are no results of an earlier evaluation") from error
        if not isinstance(document, dict) or document.get("format") != FORMAT:
            raise ResultsError(f"{path}:1:1: these are no results of an evaluation")
        return document

    def outcomes(self) -> list[Outcome]:
        """Returns the outcomes that the folder holds, in the order of the seeds.

        Raises:
            ResultsError: a line is no outcome.
        """
        found: dict[int, Outcome] = {}
        for name in (RUNS, PART):
            path = self._folder / name
            lines = path.read_bytes().splitlines(keepends=True) if path.exists() else []
            for number, line in enumerate(lines, 1):
                try:
                    outcome = read_outcome(line)
                except ValueError as error:
                    if name == PART and not line.endswith(b"\n"):
                        continue  # the process ended while it wrote
                    raise ResultsError(f"{path}:{number}:1: {error}") from error
                found[outcome.seed] = outcome
        return [found[seed] for seed in sorted(found)]

    def require_none(self) -> None:
        """Raises ResultsError if the folder holds outcomes, so that none is replaced without a word."""
        if any((self._folder / name).exists() for name in (HEADER, RUNS, PART)):
            raise ResultsError(
                f"{self._folder}: it holds the results of an earlier evaluation "
                "(continue that one with --resume, or name another folder)"
            )

    def begin(self, header: dict[str, Any], kept: Iterable[Outcome] = ()) -> None:
        """Begins new results, with outcomes that are kept.

        Raises:
            ResultsError: the folder cannot be written.
        """
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            text = json.dumps({"format": FORMAT, "version": 1, **header}, ensure_ascii=False, indent=2) + "\n"
            self._replace(HEADER, text.encode())
            self.finish(kept)
        except OSError as error:
            raise ResultsError(f"{self._folder}: it cannot be written: {error.strerror}") from error

    def add(self, outcome: Outcome) -> None:
        """Writes one more outcome."""
        with (self._folder / PART).open("ab") as file:
            file.write(outcome.to_line().encode() + b"\n")

    def finish(self, outcomes: Iterable[Outcome]) -> None:
        """Writes all outcomes in the order of their seeds, and replaces the earlier file."""
        ordered = sorted(outcomes, key=lambda outcome: outcome.seed)
        self._replace(RUNS, b"".join(outcome.to_line().encode() + b"\n" for outcome in ordered))
        with suppress(FileNotFoundError):
            (self._folder / PART).unlink()

    def write(self, name: str, text: str) -> None:
        """Writes a further file."""
        self._replace(name, text.encode())

    def _replace(self, name: str, data: bytes) -> None:
        temporary = self._folder / f".{name}.part"
        temporary.write_bytes(data)
        temporary.replace(self._folder / name)
