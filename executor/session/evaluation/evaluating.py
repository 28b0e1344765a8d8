"""The evaluation that a session runs beside its ladder: one job at a time, in a process of its own.

Its outcomes go to the client that asked last, and are kept until another job begins, so that a client that
reconnects gets them again.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final
from uuid import uuid4

from executor import evaluation_messages, messages

if TYPE_CHECKING:
    from executor.evaluation_events import Evaluate, EvaluationEnd
    from executor.session.events import ChildExited, ChildSaid, CommandCame
    from executor.session.stage import Stage

__all__ = ["Evaluating"]

LAST_LINES: Final = 3


@dataclass
class _Job:
    """A job, and who hears of it."""

    name: str
    client: str
    request: str
    run: str = ""
    started: messages.EvaluationStarted | None = None
    outcomes: dict[int, messages.EvaluationOutcome] = field(default_factory=dict)
    ended: messages.EvaluationEnded | None = None


class Evaluating:
    """The evaluation of a session."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._job: _Job | None = None

    def begin(self, event: CommandCame, data: Evaluate) -> None:
        """Begins a job, or sends what is known of the one that already runs."""
        job = self._job
        if job is not None and job.name == data.job and (job.ended is None or job.ended.end == "complete"):
            job.client, job.request = event.client, event.request
            self._stage.output.send(event.client, messages.Ack(), event.request)
            self._tell_again(job, set(data.seeds))
            return
        folder = self._stage.recording.folder
        if data.record and not (folder and data.seeds):
            self._stage.output.refuse(
                event, "not_recorded", "This session is not recorded, or no seed is named."
            )
            return
        self._stage.output.send(event.client, messages.Ack(), event.request)
        self._end("replaced", "Another evaluation began.")
        children = self._stage.children
        children.drop("evaluation")
        for spare in ("world", "application"):
            child = children.get(spare)
            if child is not None and not child.is_started:
                children.drop(spare)  # its memory is for the runs
        run = uuid4().hex[:12] if data.record else ""
        self._job = _Job(data.job, event.client, event.request, run)
        children.ensure("evaluation")
        children.tell_evaluation(
            evaluation_messages.StartEvaluation(
                archive_base64=data.app_zip_base64,
                evaluation=data.evaluation,
                seeds=data.seeds,
                known=data.known,
                record_to=f"{folder}/{run}/0.0.mcap" if run else "",
                runs=data.runs,
                sealed=data.sealed,
            )
        )

    def said(self, event: ChildSaid) -> None:
        """Handles a message of the process."""
        job = self._job
        if job is None or self._stage.children.of(event) is None:
            return
        match event.message:
            case evaluation_messages.Started() as begun:
                job.started = messages.EvaluationStarted(
                    job=job.name,
                    workers=begun.workers,
                    seed=begun.seed,
                    wanted=begun.wanted,
                    sequential=begun.sequential,
                    duration_s=begun.duration_s,
                    plan=begun.plan,
                    notes=begun.notes,
                )
                self._tell(job, job.started)
            case evaluation_messages.RunDone() as done:
                outcome = messages.EvaluationOutcome(
                    job=job.name,
                    seed=done.seed,
                    line=done.line,
                    cpu_s=done.cpu_s,
                    done=done.done,
                    wanted=done.wanted,
                    rate=done.rate,
                    low=done.low,
                    high=done.high,
                    left_s=done.left_s,
                )
                job.outcomes[done.seed] = outcome
                self._tell(job, outcome)
            case evaluation_messages.EvaluationDone(wanted=wanted):
                self._end("complete", wanted=wanted)
            case evaluation_messages.Refused(message=message):
                self._end("refused", message)
            case _:
                pass

    def exited(self, event: ChildExited) -> None:
        """Notes that the process has ended; without its last word it has failed."""
        child = self._stage.children.of(event)
        if child is None:
            return
        del self._stage.children.living["evaluation"]
        child.end(event.reason, event.last_lines)
        self._end("failed", "\n".join([f"The evaluation {event.reason}.", *event.last_lines[-LAST_LINES:]]))

    def _end(self, end: EvaluationEnd, message: str = "", wanted: int = 0) -> None:
        job = self._job
        if job is None or job.ended is not None:
            return
        run = job.run if end == "complete" else ""
        job.ended = messages.EvaluationEnded(job.name, end, wanted, message, run)
        self._tell(job, job.ended)

    def _tell_again(self, job: _Job, seeds: set[int]) -> None:
        if job.started is not None:
            self._tell(job, job.started)
        for seed, outcome in job.outcomes.items():
            if seed in seeds or not seeds:
                self._tell(job, outcome)
        if job.ended is not None:
            self._tell(job, job.ended)

    def _tell(
        self,
        job: _Job,
        event: messages.EvaluationStarted | messages.EvaluationOutcome | messages.EvaluationEnded,
    ) -> None:
        # As an answer it is never dropped.
        self._stage.output.send(job.client, event, job.request)
