"""The snapshots of exact runs, as the session knows them: which run each belongs to, and which are kept."""

from __future__ import annotations

from dataclasses import dataclass, replace
from hashlib import blake2b
from typing import TYPE_CHECKING, Final

from executor import child_messages, messages
from executor.replay_messages import FINGERPRINT_BYTES
from executor.session.events import DropSnapshot, SnapshotEnded, SnapshotWeighed
from executor.session.exact.ring import CEILING_BYTES, Kept, surplus
from executor.session.waits import StepFailed, Wait, message_of

if TYPE_CHECKING:
    from executor.child_messages import NoSnapshots, SnapshotTaken, StartApplication
    from executor.replay_messages import Replay
    from executor.session.child import Child
    from executor.session.exact.past import PastRun
    from executor.session.stage import Stage
    from executor.session.waits import Step

__all__ = ["Snapshots", "keep_present", "ticks_of"]

EPSILON_S: Final = 1e-6
TIP_S: Final = 2.0
NO_MEMORY: Final = "the memory for them is used up"


@dataclass(frozen=True)
class _Snapshot:
    """One snapshot, and the run up to it, as a hash: it is a part of each run that begins in the same way."""

    kept: Kept
    taken: SnapshotTaken
    start: StartApplication
    begin: bytes

    def is_before(self, until_s: float | None) -> bool:
        """Whether the moment, just after a tick, is not before this."""
        if until_s is None:
            return True
        at_s = self.taken.t - EPSILON_S if self.taken.is_at_tick else self.taken.t + EPSILON_S
        return at_s <= until_s


class Snapshots:
    """The snapshots that wait: those of earlier runs first, then those of the present one and its past."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._there: list[_Snapshot] = []
        self._run = 0
        self._is_short = False
        self._told = ""

    def begin(self, child: Child) -> None:
        """Asks a run that begins to make snapshots of itself; those of its past are its own from now on."""
        self._run += 1
        self._told = ""
        past = self._stage.past.find("")
        own = [each for each in self._there if past is not None and _belongs(each, past)]
        others = [each for each in self._there if each not in own]
        own = [replace(each, kept=replace(each.kept, run=self._run)) for each in own]
        self._there = others + sorted(own, key=lambda each: each.kept.cost_s)
        self._stage.children.tell_exact(child, child_messages.KeepSnapshots(is_on=not self._is_short))

    def said(self, child: Child, message: SnapshotTaken | NoSnapshots) -> None:
        """Takes what a run says about its snapshots."""
        if isinstance(message, child_messages.NoSnapshots):
            if not message.is_wanted:
                self._tell(message.reason)
            return
        past, key = self._stage.past.find(""), (child.number, message.number)
        begin = _begin(past, message) if past is not None else None
        if past is None or begin is None or any(each.kept.key == key for each in self._there):
            self._stage.output.effect(DropSnapshot(*key))
            return
        kept = Kept(key, self._run, message.t, message.cost_s, is_tip=message.is_wanted)
        self._there.append(_Snapshot(kept, message, past.start, begin))
        self._trim()

    def ended(self, event: SnapshotEnded) -> None:
        """Forgets a snapshot."""
        self._there = [each for each in self._there if each.kept.key != (event.child, event.snapshot)]

    def weighed(self, event: SnapshotWeighed) -> None:
        """Notes how much memory a snapshot has for itself, and keeps fewer of them where it is short."""
        key = (event.child, event.snapshot)
        self._there = [
            replace(each, kept=replace(each.kept, size_bytes=event.size_bytes))
            if each.kept.key == key
            else each
            for each in self._there
        ]
        ceiling = CEILING_BYTES
        if event.room_bytes is not None:
            ceiling = max(0, min(ceiling, event.room_bytes + sum(e.kept.size_bytes for e in self._there)))
        self._trim(ceiling)
        is_short = ceiling == 0
        if is_short != self._is_short:
            self._is_short = is_short
            self._stage.children.tell_host(child_messages.KeepSnapshots(is_on=not is_short))
            if is_short:
                self._tell(NO_MEMORY)

    def newest(self, past: PastRun, until_s: float | None, most_ticks: int) -> tuple[int, int] | None:
        """Returns the key of the newest snapshot up to a moment and so many ticks; None without one."""
        found = [
            each
            for each in self._there
            if each.taken.ticks <= most_ticks and each.is_before(until_s) and _belongs(each, past)
        ]
        best = max(found, key=lambda each: (each.taken.ticks, each.taken.inputs, each.taken.t), default=None)
        return best.kept.key if best is not None else None

    def forget(self) -> None:
        """Ends all snapshots."""
        for each in self._there:
            self._stage.output.effect(DropSnapshot(*each.kept.key))
        self._there = []

    def _trim(self, ceiling_bytes: int = CEILING_BYTES) -> None:
        draws = bool(self._there) and self._there[-1].taken.draws
        dropped = surplus([each.kept for each in self._there], draws=draws, ceiling_bytes=ceiling_bytes)
        for kept in dropped:
            self._stage.output.effect(DropSnapshot(*kept.key))
        keys = {kept.key for kept in dropped}
        self._there = [each for each in self._there if each.kept.key not in keys]

    def _tell(self, reason: str) -> None:
        if reason == self._told:
            return
        self._told = reason
        text = f"No snapshots of this run are made: {reason}. Going back makes it again from an earlier one."
        self._stage.output.emit(messages.Log("manager", "info", text))


def keep_present(stage: Stage) -> Step:
    """Makes a snapshot of the present, so that the way back to it is short; does nothing where that fails."""
    child = stage.children.host
    if child is None or not child.is_alive or child.is_holding or stage.python.is_stopped:
        return
    child.forget(child_messages.SnapshotTaken)
    child.forget(child_messages.NoSnapshots)
    stage.children.tell_exact(child, child_messages.TakeSnapshot())
    try:
        yield Wait(
            message_of(child, child_messages.SnapshotTaken, child_messages.NoSnapshots), TIP_S, "snapshot"
        )
    except StepFailed as failure:
        if failure.code == "cancelled":
            raise


def _begin(past: PastRun, taken: SnapshotTaken) -> bytes | None:
    """Returns the hash of a run up to a snapshot; None if not so much of it is known."""
    ticks_bytes = taken.ticks * FINGERPRINT_BYTES
    if past.refusal or len(past.fingerprints) < ticks_bytes or len(past.inputs) < taken.inputs:
        return None
    digest = blake2b(memoryview(bytes(past.fingerprints))[:ticks_bytes], digest_size=16)
    for one in past.inputs[: taken.inputs]:
        digest.update(repr((one.tick, one.step, one.hook, one.message)).encode())
    return digest.digest()


def ticks_of(replay: Replay) -> int:
    """Returns how many ticks are made again at most."""
    return len(replay.fingerprints) // FINGERPRINT_BYTES


def _belongs(snapshot: _Snapshot, past: PastRun) -> bool:
    return snapshot.start is past.start and snapshot.begin == _begin(past, snapshot.taken)
