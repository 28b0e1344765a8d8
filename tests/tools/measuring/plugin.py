"""A pytest plugin that writes down what each test costs, and which processes lived while its file ran.

It is loaded by `-p tests.tools.measuring.plugin`, and works where `BT_STUDIO_MEASURE` names a folder: each
process of pytest appends to `FOLDER/runs/PID.jsonl`.
"""

from __future__ import annotations

import json
import mmap
import os
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.tools.measuring.loaded import LANE
from tests.tools.measuring.processor_time import ProcessorTime

if TYPE_CHECKING:
    from collections.abc import Generator, Iterator

    from tests.tools.measuring.loaded import Log

VARIABLE = "BT_STUDIO_MEASURE"


def pytest_configure(config: pytest.Config) -> None:
    """Measures where a folder is named; the process that only hands out tests has none of its own."""
    folder = os.environ.get(VARIABLE)
    is_controller = bool(getattr(config.option, "tx", None)) and not hasattr(config, "workerinput")
    if folder and not is_controller:
        config.pluginmanager.register(Measuring(Path(folder)), "measuring")


class Measuring:
    """Writes a line for each test."""

    def __init__(self, folder: Path) -> None:
        folder = folder / "runs"
        folder.mkdir(parents=True, exist_ok=True)
        self._file = (folder / f"{os.getpid()}.jsonl").open("a")
        self._time = ProcessorTime()
        self._before_s = self._time.read()
        self._failed = False
        self._epochs = Epochs()
        self._own_epochs: list[int] = []
        self._fixtures: list[str] = []

    def pytest_collection_finish(self) -> None:
        """Leaves out the time of collecting, which is no test's."""
        self._before_s = self._time.read()

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Measures a test with its fixtures: those of a file count for its first test."""
        began_s, self._failed, read_before = _since_boot_s(), False, _read_bytes()
        alive = self._time.alive
        self._own_epochs, self._fixtures = [self._epochs.begin()], []
        result = yield
        spent_s = -self._before_s + (now_s := self._time.read())
        self._before_s = now_s
        line = {
            "test": item.nodeid,
            "processor_s": round(spent_s, 3),
            "wall_s": round(_since_boot_s() - began_s, 3),
            "began": began_s,
            "is_failed": self._failed,
            "read": [read_before, _read_bytes()],
            "alive": sorted(f"{pid}-{start}" for pid, start in {*alive, *self._time.alive}),
            "epochs": self._own_epochs,
            "fixtures": self._fixtures,
        }
        self._write(line)
        return result

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: pytest.FixtureDef[object]) -> Generator[None, object, object]:
        """Gives a fixture that several tests share an epoch: what its set-up runs belongs to all of them."""
        if fixturedef.scope == "function":
            return (yield)
        around = self._own_epochs
        self._own_epochs = [self._epochs.begin()]
        try:
            return (yield)
        finally:
            self._write({"fixture": _name(fixturedef), "epochs": self._own_epochs})
            around.append(self._epochs.begin())
            self._own_epochs = around

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_teardown(self, item: pytest.Item) -> None:
        """Notes which shared fixtures the test used, also those that it asked for by name."""
        used = getattr(getattr(item, "_request", None), "_fixture_defs", {})
        self._fixtures = sorted(_name(each) for each in used.values() if each.scope != "function")

    def _write(self, line: dict[str, object]) -> None:
        self._file.write(json.dumps(line) + "\n")
        self._file.flush()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Remembers a failure of any part of the test."""
        self._failed = self._failed or report.failed


class Epochs:
    """The epoch of this lane, which its processes read at each call."""

    def __init__(self) -> None:
        self._now = 1  # while tests are collected
        self._log: Log | None = getattr(sys, "bt_studio_log", None)
        lane = self._log.lane if self._log else ""
        self._head: mmap.mmap | None = None
        if lane:
            os.environ[LANE] = lane
            with Path(lane).open("r+b") as file:
                self._head = mmap.mmap(file.fileno(), mmap.PAGESIZE)

    def begin(self) -> int:
        """Begins the next epoch, and returns it."""
        self._now += 1
        if self._log:
            self._log.forget_texts()
        if self._head:
            self._head[:4] = self._now.to_bytes(4, "little")
        return self._now


def _name(fixture: pytest.FixtureDef[object]) -> str:
    return f"{fixture.baseid}::{fixture.argname}"


def _since_boot_s() -> float:
    """Returns the time in which the kernel counts the starts of processes."""
    return time.clock_gettime(time.CLOCK_BOOTTIME)


def _read_bytes() -> int:
    """Returns how long the list of files is that this process read."""
    log = getattr(sys, "bt_studio_log", None)
    return 0 if log is None or log.file < 0 else os.fstat(log.file).st_size
