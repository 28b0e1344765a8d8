"""Reads what a measured run wrote: what each test cost, and what the tests of each file read."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from tests.tools.measuring.executed import Lane, Ran, lanes, ran
from tests.tools.measuring.loaded import TEXT

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

_LINT: Final = "tests/tools/"  # which runs beside the tests
TICKS_PER_S: Final = os.sysconf("SC_CLK_TCK")


@dataclass
class Process:
    """One process of a measured run; `name` is its id and start, `read` are paths in the repository."""

    name: str
    parent: int
    is_marked: bool
    origin: str
    lane: int | None
    began_s: float
    read: list[str] = field(default_factory=list)


@dataclass
class Measured:
    """The results of a run: seconds a test, the failed ones, and the paths that each file's tests read."""

    processor_s: dict[str, float] = field(default_factory=dict)
    wall_s: dict[str, float] = field(default_factory=dict)
    failed: set[str] = field(default_factory=set)
    loaded: dict[str, set[str]] = field(default_factory=dict)
    """What the processes read that a file's tests started or found."""
    read: dict[str, set[str]] = field(default_factory=dict)
    """What the process of pytest itself read for the first time while a file ran."""
    texts: dict[str, set[str]] = field(default_factory=dict)
    """The sources that the processes of a file's tests read as texts."""
    data: dict[str, set[str]] = field(default_factory=dict)
    """What the processes read that a file's tests started."""
    not_followed: set[str] = field(default_factory=set)
    """The files with a process whose functions were not noted."""
    lanes: dict[int, Lane] = field(default_factory=dict)
    lines: dict[int, list[dict[str, Any]]] = field(default_factory=dict)

    def ran(self, tests: frozenset[str]) -> dict[str, Ran]:
        """Returns what some tests ran, by their files, where that is known."""
        found: dict[str, Ran] = {}
        for worker, lines in self.lines.items():
            if worker in self.lanes:
                found |= ran(self.lanes[worker], lines, tests)
        return {file: each for file, each in found.items() if each.is_known and file not in self.not_followed}


def measured(folder: Path, files: Iterable[str] = ()) -> Measured:
    """Reads the folder of a measured run of a tree with some files."""
    processes = {each.name: each for each in map(_process, sorted((folder / "loaded").iterdir()))}
    found = Measured(lanes=lanes(folder, files))
    runs: dict[int, list[dict[str, Any]]] = {}
    for path in sorted((folder / "runs").glob("*.jsonl")):
        lines = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
        found.lines[int(path.stem)] = lines
        lines = [line for line in lines if "test" in line]
        runs[int(path.stem)] = lines
        for line in lines:
            test = line["test"]
            found.processor_s[test] = found.processor_s.get(test, 0.0) + line["processor_s"]
            found.wall_s[test] = line["wall_s"]
            if line["is_failed"]:
                found.failed.add(test)
    for worker, lines in runs.items():
        own = [each for each in processes.values() if each.name.startswith(f"{worker}-")]
        below = _below(worker, processes, set(runs))
        for line in lines:
            file = line["test"].partition("::")[0]
            began_s, alive = line["began"], set(line["alive"])
            ended_s = began_s + line["wall_s"]
            seen = found.loaded.setdefault(file, set())
            for process in below:
                # The kernel cuts starts down to its ticks.
                if process.name in alive or began_s - 1 / TICKS_PER_S <= process.began_s <= ended_s:
                    read = _with_origins(process, processes)
                    seen.update(each.removeprefix(TEXT) for each in read)
                    if process.lane == worker:
                        found.texts.setdefault(file, set()).update(_texts(read))
                        if process.began_s >= began_s - 1 / TICKS_PER_S:
                            found.data.setdefault(file, set()).update(read)
                    elif process.lane is None and _runs_sources(process):
                        found.not_followed.add(file)
            for process in own:
                read = _slice(folder, process, line["read"])
                found.read.setdefault(file, set()).update(each.removeprefix(TEXT) for each in read)
                found.texts.setdefault(file, set()).update(_texts(read))
    return found


def _texts(read: Iterable[str]) -> set[str]:
    return {each.removeprefix(TEXT) for each in read if each.startswith(TEXT)}


def _runs_sources(process: Process) -> bool:
    return any(each.endswith(".py") and not each.startswith((TEXT, _LINT)) for each in process.read)


def _below(worker: int, processes: dict[str, Process], workers: set[int]) -> list[Process]:
    """Returns the descendants of a worker, and the processes of tests whose ancestors are not known."""
    parents = {int(each.name.partition("-")[0]): each.parent for each in processes.values()}

    def belongs(process: Process) -> bool:
        pid, seen = int(process.name.partition("-")[0]), set[int]()
        while pid in parents and pid not in seen:
            seen.add(pid)
            pid = parents[pid]
            if pid in workers:
                return pid == worker
        return (
            process.is_marked
        )  # a program that is not Python's stands between, or it was left by its parent

    return [
        each
        for each in processes.values()
        if int(each.name.partition("-")[0]) not in workers and belongs(each)
    ]


def _with_origins(process: Process, processes: dict[str, Process]) -> list[str]:
    read, seen = list(process.read), {process.name}
    while process.origin in processes and process.origin not in seen:
        process = processes[process.origin]
        seen.add(process.name)
        read += process.read
    return read


def _process(path: Path) -> Process:
    head, *read = path.read_text(encoding="utf-8").splitlines() or ["parent 0 - - -"]
    _, parent, mark, origin, lane = head.split(" ")
    ticks = int(path.name.partition("-")[2])
    return Process(
        path.name,
        int(parent),
        mark == "test",
        origin,
        None if lane == "-" else int(lane),
        ticks / TICKS_PER_S,
        read,
    )


def _slice(folder: Path, process: Process, limits: list[int]) -> list[str]:
    first, last = limits
    if first == last:
        return []
    content = (folder / "loaded" / process.name).read_bytes()[first:last]
    return content.decode().split()
