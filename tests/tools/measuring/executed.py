"""Reads which functions ran in each test, from the files that `executed.c` wrote.

What a test runs are the functions of its epochs, in all processes of its lane; what the set-up of a shared
fixture runs belongs to each test that uses it. A process that lived before a test brings what it ran when it
was started, and what it keeps: the results of caches, and of loaded modules. So does one that it was forked
from. The process of pytest itself runs tests of many files, so what it keeps only belongs to a test that
names it.
"""

from __future__ import annotations

import struct
from collections import defaultdict
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from pathlib import Path

_HEAD: Final = struct.Struct("<4I")
_RECORD: Final = struct.Struct("<4I")
_WORKER: Final = 1
"""The number of the process of pytest in its lane: it is the first."""
_IS_FORK: Final = 1 << 31
_IS_KEPT: Final = 1 << 30
_IS_BLIND: Final = 1 << 29
_IS_START: Final = 1 << 28
_LINE: Final = _IS_START - 1
Place = tuple[str, int]
"""A path and the first line of a function, or 0 for the body of the module."""


@dataclass
class Ran:
    """The functions that the tests of a file ran; `kept` only counts where it is named."""

    places: set[Place] = field(default_factory=set)
    kept: set[Place] = field(default_factory=set)
    is_known: bool = True
    """False where a process ran something that was not noted."""


def path_hash(path: str) -> int:
    """Returns the hash of a path as `executed.c` writes it."""
    found = 2166136261
    for byte in path.encode():
        found = (found ^ byte) * 16777619 & 0xFFFFFFFF
    return found


class Lane:
    """The records of a worker of pytest and of all processes below it."""

    def __init__(self, content: bytes, paths: Mapping[int, str]) -> None:
        _, count, capacity, _ = _HEAD.unpack_from(content)
        self.is_whole = count <= capacity
        self._paths = paths
        self._ran: defaultdict[int, defaultdict[int, set[int]]] = defaultdict(lambda: defaultdict(set))
        self._kept: defaultdict[int, set[int]] = defaultdict(set)
        self._parent: dict[int, int] = {}
        self._birth: dict[int, int] = {}
        self._blind: set[int] = set()
        end = _HEAD.size + _RECORD.size * min(count, capacity)
        for path, line, epoch, process in _RECORD.iter_unpack(content[_HEAD.size : end]):
            if line & _IS_START:
                self._birth[process] = epoch
            elif line & _IS_FORK:
                self._parent[process] = path
            elif line & _IS_BLIND:
                self._blind.add(epoch)
            elif epoch:  # its process was not killed while it wrote
                place = path << 32 | line & _LINE
                (self._kept[process] if line & _IS_KEPT else self._ran[epoch][process]).add(place)

    def of(self, epochs: Sequence[int], fixtures: Iterable[Sequence[int]], others: frozenset[int]) -> Ran:
        """Returns what a test ran.

        Args:
            epochs: its own ones.
            fixtures: those of the set-ups of the shared fixtures that it uses.
            others: the epochs of the set-ups of all other shared fixtures.
        """
        used = [epoch for each in fixtures for epoch in each]
        ran, kept = set[int](), set[int](self._kept[_WORKER] | self._ran[1][_WORKER])
        for epoch in (*epochs, *used):
            for process, places in self._ran.get(epoch, {}).items():
                if self._birth.get(process) not in others:
                    ran |= places
                    ran |= self._brought(process)
        is_known = self.is_whole and self._blind.isdisjoint([*epochs, *used])
        return Ran(self._named(ran), self._named(kept - ran), is_known)

    def _brought(self, process: int) -> set[int]:
        """Returns what a process brings from before the test, with those that it was forked from."""
        found, seen = set[int](), set[int]()
        while process not in seen and process != _WORKER:
            seen.add(process)
            born: dict[int, set[int]] = self._ran.get(self._birth.get(process, 0), {})
            found |= self._kept[process] | born.get(process, set())
            process = self._parent.get(process, _WORKER)
        return found

    def _named(self, places: set[int]) -> set[Place]:
        return {(self._paths[place >> 32], place & _LINE) for place in places if place >> 32 in self._paths}


def lanes(folder: Path, files: Iterable[str]) -> dict[int, Lane]:
    """Reads the lanes of a measured run by the workers of pytest; none where functions were not noted."""
    paths: dict[int, str] = {}
    for path in files:
        if path.endswith(".py"):
            number = path_hash(path)
            if number in paths:
                return {}  # of two paths nobody could say which one ran
            paths[number] = path
    found: dict[int, Lane] = {}
    for file in sorted(folder.glob("executed/*")):
        with file.open("rb") as opened:
            head = opened.read(_HEAD.size)
            _, count, capacity, _ = _HEAD.unpack(head)
            content = head + opened.read(_RECORD.size * min(count, capacity))
        found[int(file.name)] = Lane(content, paths)
    return found


def ran(lane: Lane, lines: list[dict[str, Any]], tests: frozenset[str]) -> dict[str, Ran]:
    """Returns what the given tests of a worker ran, by their files."""
    fixtures: defaultdict[str, list[int]] = defaultdict(list)
    for line in lines:
        if "fixture" in line:
            fixtures[line["fixture"]] += line["epochs"]
    found: dict[str, Ran] = {}
    for line in lines:
        if line.get("test") not in tests:
            continue
        own = [fixtures[name] for name in line["fixtures"]]
        others = frozenset(e for name, each in fixtures.items() if name not in line["fixtures"] for e in each)
        new = lane.of(line["epochs"], own, others)
        file = found.setdefault(line["test"].partition("::")[0], Ran())
        file.places |= new.places
        file.kept |= new.kept
        file.is_known &= new.is_known
    return found
