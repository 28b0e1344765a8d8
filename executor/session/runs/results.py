"""The results of the runs of a session, for lists of runs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor import messages

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.recording_events import RunResult

__all__ = ["RunResults"]

_OF_ROOT: Final[dict[str, RunResult]] = {"SUCCESS": "success", "FAILURE": "failure"}
_COLLISION: Final = " bumped into "


class RunResults:
    """Hears the events of a session, and tells the results of its runs.

    The result of a run that was stopped after its robot had bumped into something says so.
    """

    def __init__(self) -> None:
        self._results: dict[str, RunResult] = {}
        self._collided: set[str] = set()

    def of(self, run: str) -> RunResult | None:
        """Returns the result of a run; None while it has none."""
        return self._results.get(run)

    def stop(self, run: str) -> bool:
        """Ends a run from outside; returns whether that is its result."""
        if run in self._results:
            return False
        self._results[run] = "collision" if run in self._collided else "stopped"
        return True

    def hear(self, run: str, event: Struct) -> bool:
        """Takes an event of the present run; returns whether it has its result now."""
        match event:
            case messages.Log(source="world", text=text) if _COLLISION in text:
                self._collided.add(run)
            case messages.Finished(reason="terminated"):
                return self.stop(run)
            case messages.Finished(reason=reason, status=status) if run not in self._results:
                self._results[run] = (_OF_ROOT.get(status) if reason == "root_finished" else None) or "fault"
                return True
        return False
