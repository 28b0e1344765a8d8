"""The recorder of a session: `python -m executor.recorder.process --channel-fd N`.

World and application send what happens over links of their own (`executor.recorder.link`), the manager tells
of lines, faults and the end. None of the user's code is in this process, and it survives all others. Links
are read twice in a second, just after all sources send, and then all is flushed: what arrives between does
not wake the process. For a source that is late there is another look. A full disk stops the recording, not
the run.
"""

from __future__ import annotations

import argparse
import contextlib
import errno
import os
import platform
import selectors
import signal
import struct
import sys
import time
from collections import deque
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import msgspec

from executor import __version__, child_messages, recorder_messages
from executor.messages import Error, RecordingPart, Segment
from executor.recorder.definitions import DefinitionError
from executor.recorder.event_messages import message_of
from executor.recorder.link import ADDRESS_VARIABLE, BATCH_S, Dump, Heard, Mark, Record, Until, next_batch_s
from executor.recorder.ordering import Ordering
from executor.recorder.project_files import project_files, project_name
from executor.recorder.run_writer import LATEST_NS, RunWriter
from executor.recorder.shelf import Budgets, Shelf, file_of
from executor.recorder.sources import MOST_SOURCES, BrokenSource, Source, listen, take_source
from executor.recorder.summary.keyframes import find_keyframe
from executor.recorder_messages import FromRecorder, ToRecorder, decode_to_recorder
from executor.supervision.channel import Channel, ChannelClosed, ChannelError
from executor.supervision.confine import die_with_parent

if TYPE_CHECKING:
    import socket
    from collections.abc import Iterable

    from executor.messages import StopReason
    from executor.recorder import shelf

__all__ = ["RecorderProcess", "main"]

LATER_S: Final = 0.05
"""How long after the moment at which sources send their batches are read."""
LATE_S: Final = 0.1
"""The time between two looks while a source is late."""
FULL_S: Final = 0.01
"""The time between two looks at a source that sends as much as its way holds."""
TOLD_S: Final = 1.0
GOODBYE_S: Final = 0.5
BRANCH: Final = 0
FULL: Final = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})
_NO_FIELDS: Final = (KeyError, TypeError, ValueError, AttributeError, OverflowError, struct.error)
_encode = msgspec.msgpack.Encoder().encode
_Early = tuple[str, int, Record | Heard | Dump]
"""A message that arrived before its run began, with that run and its source."""


class _Stop(Exception):  # noqa: N818 - the way out, not an error
    """Raised when the manager ends the recorder."""


class RecorderProcess:
    """Takes messages and writes them, in one thread."""

    def __init__(self, channel: Channel[FromRecorder, ToRecorder], listener: socket.socket) -> None:
        self._channel = channel
        self._listener = listener
        self._selector = selectors.DefaultSelector()
        self._selector.register(channel, selectors.EVENT_READ)
        self._selector.register(listener, selectors.EVENT_READ)
        self._sources: dict[int, Source] = {}
        self._shelf: Shelf | None = None
        self._writer: RunWriter | None = None
        self._refused: set[str] = set()
        self._told: deque[tuple[float, recorder_messages.RunEvent]] = deque()
        self._order = Ordering[Record | Heard | Dump]()
        self._look_s = 0.0
        self._flush_s = 0.0
        self._has_told = False
        self._early: list[_Early] = []

    def run(self) -> None:
        """Runs until the manager ends it, or is gone."""
        try:
            while True:
                self._turn()
        except (_Stop, ChannelClosed):
            self._take_all()  # what was sent before the end
            self._guarded(self._end_run)

    def _turn(self) -> None:
        for key, _ in self._selector.select(max(0.0, self._look_s - time.monotonic())):
            if key.fileobj is self._channel:
                self._take_commands()
            else:
                self._accept()
        now_s = time.monotonic()
        if now_s >= self._look_s:
            self._look(now_s)

    def _look(self, now_s: float) -> None:
        """Reads the links, and writes what is ready."""
        self._take_all()
        self._write_ready()
        is_full = any(source.is_full for source in self._sources.values())
        next_s = next_batch_s(now_s - LATER_S) + LATER_S
        if self._order.is_behind(next_s - LATER_S - BATCH_S, now_s):
            next_s = min(next_s, now_s + LATE_S)
        self._look_s = now_s + FULL_S if is_full else next_s
        if not is_full or now_s >= self._flush_s:
            self._flush_s = now_s + BATCH_S
            self._has_told = False
            if self._writer is not None:
                self._guarded(self._writer.flush)
            if not self._has_told:  # a segment is a sign of life too
                self._channel.send(child_messages.Beat(0))

    def _take_commands(self) -> None:
        while (message := self._channel.receive(0)) is not None:
            match message:
                case child_messages.Stop():
                    raise _Stop
                case recorder_messages.StartRecorder():
                    budgets = None if message.is_whole else Budgets()
                    self._shelf = Shelf(Path(message.folder), self._announce, budgets)
                    self._shelf.recover()
                case recorder_messages.BeginRun():
                    self._begin(message)
                case recorder_messages.ChangeFiles():
                    self._change_files(message)
                case recorder_messages.RunEvent():
                    self._tell(message)
                case recorder_messages.ReadSegment():
                    self._answer(message)
                case recorder_messages.DropRun(run=run):
                    self._drop(run)
                case recorder_messages.FindKeyframe():
                    self._answer_keyframe(message)

    def _begin(self, message: recorder_messages.BeginRun) -> None:
        about = {**message.about, "bt_studio": __version__, "python": platform.python_version()}
        about["platform"] = platform.platform()
        if self._shelf is not None and (self._writer is None or self._writer.run != message.run):
            files = project_files(message.folder, message.universe)
            about["project"] = project_name(files)
            early = self._take_rest()
            with contextlib.suppress(*_NO_FIELDS):  # no message of our sources
                self._put_early(early, self._writer.run if self._writer is not None else "")
            self._change_run(self._shelf, message.run, about, files)
            with contextlib.suppress(*_NO_FIELDS):
                self._put_early([*self._early, *early], message.run)
            self._early = early

    def _change_files(self, message: recorder_messages.ChangeFiles) -> None:
        """Attaches the changed files; the tree that was made of them has not arrived yet."""
        if (writer := self._writer) is not None and writer.run == message.run:
            self._guarded(lambda: writer.change_files(project_files(message.folder)))

    def _tell(self, message: recorder_messages.RunEvent) -> None:
        """Keeps a message of the manager until world and application have sent what was before it.

        They send in batches. It does not wait for long: the time may still be that of the run before.
        """
        if self._writer is not None and self._writer.run == message.run:
            self._told.append((time.monotonic() + TOLD_S, message))

    def _write_told(self, now_ns: int, *, all_: bool = False) -> None:
        """Writes the lines of up to a time whose nodes are known, and those that waited for long enough."""
        while self._told and (writer := self._writer) is not None:
            until_s, message = self._told[0]
            t_ns = max(0, round(message.t * 1e9))
            path = message.data.get("node_path")
            is_early = t_ns > now_ns or (path and not writer.moment.uid(path))
            if is_early and not all_ and time.monotonic() < until_s:
                return
            self._told.popleft()
            self._write_line(writer, min(t_ns, now_ns), message)

    def _write_line(self, writer: RunWriter, t_ns: int, message: recorder_messages.RunEvent) -> None:
        uid = writer.moment.uid(message.data.get("node_path") or "")
        if (line := message_of(message.name, t_ns, message.data, uid)) is not None:
            self._guarded(lambda: writer.record(*line))

    def _answer(self, message: recorder_messages.ReadSegment) -> None:
        error = self._read(message)
        self._channel.send(child_messages.Answer(request=message.request, error=error))

    def _drop(self, run: str) -> None:
        """Removes what was recorded of an earlier run; what still arrives of it is left out."""
        if self._shelf is not None and (self._writer is None or self._writer.run != run):
            self._refused.add(run)
            self._shelf.drop_run(run)

    def _answer_keyframe(self, message: recorder_messages.FindKeyframe) -> None:
        """Sends the state of a world at a moment; what waits to be written is written before."""
        self._take_all()
        self._write_ready(all_=True)
        if self._writer is not None:
            self._guarded(self._writer.flush)
        known = [one for one in self._segments() if one.run == message.run and one.bytes]
        until_ns = None if message.t is None else round(message.t * 1e9)
        folder = self._shelf.folder if self._shelf is not None else Path()
        newest = sorted(known, key=lambda one: one.number, reverse=True)
        found = find_keyframe([file_of(folder, one) for one in newest], until_ns)
        error = None
        if found is None:
            text = "The recording has no state of the world that is so early."
            error = Error("not_recorded", text, "Go back to a later moment, or press Run.")
        else:
            t_s = found.t_ns * 1e-9
            self._channel.send(recorder_messages.WorldKeyframe(t_s, found.world, found.blackboard_json))
        self._channel.send(child_messages.Answer(request=message.request, error=error))

    def _read(self, message: recorder_messages.ReadSegment) -> Error | None:
        segment = self._find(message)
        if segment is None or self._shelf is None:
            text = f"Segment {message.segment}.{message.version} of run {message.run} is not recorded."
            return Error("not_recorded", text, "A newer version may have replaced it.")
        try:
            data = self._shelf.read(segment, message.offset, message.length)
        except OSError as error:
            return Error("not_recorded", f"The segment cannot be read: {error.strerror}.")
        part = RecordingPart(message.run, BRANCH, message.segment, message.version, message.offset, data)
        lane = f"recording/{message.run}/{message.segment}/{message.version}/{message.offset}"
        self._channel.send(child_messages.Frame(message.client, lane, _encode(part), keep=True))
        return None

    def _find(self, message: recorder_messages.ReadSegment) -> shelf.Segment | None:
        wanted = (message.run, message.segment, message.version)
        return next((one for one in self._segments() if (one.run, one.number, one.version) == wanted), None)

    def _segments(self) -> list[shelf.Segment]:
        """Returns all segments, with the open one."""
        known = list(self._shelf.segments) if self._shelf is not None else []
        if self._writer is not None:
            known.append(self._writer.open_segment)
        return known

    def _announce(self, segment: shelf.Segment) -> None:
        self._has_told = True
        times = segment.from_ns * 1e-9, segment.to_ns * 1e-9
        place = segment.run, BRANCH, segment.number, segment.version
        self._channel.send(
            recorder_messages.Recorded(Segment(*place, *times, segment.bytes, segment.is_complete))
        )

    def _accept(self) -> None:
        source = take_source(self._listener)
        if source is None:
            return
        if len(self._sources) >= MOST_SOURCES:
            source.connection.close()
            return
        self._sources[source.connection.fileno()] = source
        self._order.belongs(source.connection.fileno(), source.process)

    def _take_all(self) -> None:
        for source in list(self._sources.values()):
            self._take(source)

    def _take(self, source: Source) -> None:
        try:
            for message in source.messages():
                if self._writer_of(source.run) is None or isinstance(message, Mark):
                    continue
                if isinstance(message, Until):
                    self._order.reached(message.t_ns, source.connection.fileno(), time.monotonic())
                else:
                    self._put(source.connection.fileno(), message)
        except BrokenSource:
            self._lose(source)
        except _NO_FIELDS as error:
            self._say(f"A message for the recording is not of its type ({type(error).__name__}).")
            self._lose(source)

    def _take_rest(self) -> list[_Early]:
        """Takes the messages that came before a run begins: of the previous run or of the new one."""
        taken: list[_Early] = []
        for source in list(self._sources.values()):
            number = source.connection.fileno()
            with contextlib.suppress(BrokenSource):  # it is lost at the next look
                taken += [
                    (source.run, number, message)
                    for message in source.messages()
                    if not isinstance(message, Mark | Until)
                ]
        return taken

    def _put_early(self, early: Iterable[_Early], run: str) -> None:
        """Puts those that belong to a run into the order."""
        for of_run, number, message in early:
            if of_run == run:
                self._put(number, message)

    def _put(self, number: int, message: Record | Heard | Dump) -> None:
        """Puts a message of a source into the order.

        Raises:
            KeyError, ValueError: it has no time of a run.
        """
        self._order.put(_time_ns(message), message, number, time.monotonic())

    def _lose(self, source: Source) -> None:
        self._order.drop(source.connection.fileno())
        del self._sources[source.connection.fileno()]
        source.connection.close()

    def _writer_of(self, run: str) -> RunWriter | None:
        """Returns the writer of a run; None for an earlier one, of which something arrives late."""
        if self._writer is not None and self._writer.run == run:
            return self._writer
        if run in self._refused:
            return None
        self._take_commands()  # the manager told of the run before it told the source
        return self._writer if self._writer is not None and self._writer.run == run else None

    def _change_run(self, shelf: Shelf, run: str, about: dict[str, str], files: dict[str, bytes]) -> None:
        self._guarded(self._end_run)
        if self._writer is not None:
            self._refused.add(self._writer.run)
        self._writer = RunWriter(shelf, run, about, files)

    def _end_run(self) -> None:
        self._write_ready(all_=True)
        if self._writer is not None:
            self._writer.end()

    def _write_ready(self, *, all_: bool = False) -> None:
        """Writes the messages that no earlier one can precede, and the lines between them."""
        for t_ns, message in self._order.ready(time.monotonic(), all_=all_):
            self._write_told(t_ns)
            if (writer := self._writer) is not None:
                try:
                    self._guarded(lambda m=message, w=writer: self._write(w, m))
                except _NO_FIELDS as error:
                    self._say(f"A message for the recording is not of its type ({type(error).__name__}).")
        if self._writer is not None:
            self._write_told(self._writer.now_ns, all_=all_)

    @staticmethod
    def _write(writer: RunWriter, message: Record | Heard | Dump) -> None:
        match message:
            case Record(name="Input", fields={"tick": None}):
                writer.record(message.topic, message.name, message.fields | {"tick": writer.moment.tick})
            case Record():
                writer.record(message.topic, message.name, message.fields)
            case Heard():
                writer.write(message.topic, message.kind, message.t_ns, message.data)
            case Dump():
                fields = writer.moment.keyframe(message.t_ns, message.step, message.data)
                writer.record("/bt/keyframe", "Keyframe", fields)

    def _guarded(self, write: Any) -> None:
        """Writes; a full disk ends the recording of this run, and an unknown type is left out."""
        try:
            write()
        except DefinitionError as error:
            self._say(f"A topic is not recorded: {error}.")
        except OSError as error:
            self._stop_run(error)

    def _stop_run(self, error: OSError) -> None:
        writer, self._writer = self._writer, None
        self._told.clear()
        if writer is None:
            return
        self._refused.add(writer.run)
        writer.abandon()
        reason: StopReason = "disk_full" if error.errno in FULL else "disk_failed"
        detail = error.strerror or type(error).__name__
        self._channel.send(recorder_messages.Stopped(writer.run, writer.now_ns * 1e-9, reason, detail))

    def _say(self, text: str) -> None:
        self._channel.send(child_messages.Log("warning", text))


def _time_ns(message: Record | Heard | Dump) -> int:
    """Returns the time of a message.

    Raises:
        KeyError, ValueError: it has none, or one that is no time of a run.
    """
    t_ns = message.fields["stamp"] if isinstance(message, Record) else message.t_ns
    if type(t_ns) is not int or not 0 <= t_ns <= LATEST_NS:
        raise ValueError(f"{t_ns!r} is not a time of a run")
    return t_ns


def main(arguments: list[str] | None = None) -> None:
    """Runs a recorder for the manager at the other end of a channel."""
    parser = argparse.ArgumentParser(prog="python -m executor.recorder.process", description=__doc__)
    parser.add_argument("--channel-fd", type=int, required=True)
    options = parser.parse_args(arguments)
    die_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the manager handles Ctrl-C
    channel: Channel[FromRecorder, ToRecorder] = Channel(options.channel_fd, decode_to_recorder)
    try:
        RecorderProcess(channel, listen(os.environ.pop(ADDRESS_VARIABLE))).run()
        channel.flush(GOODBYE_S)
    except ChannelError as error:
        sys.exit(f"The manager sent a message that cannot be read: {error}")


if __name__ == "__main__":
    main()
