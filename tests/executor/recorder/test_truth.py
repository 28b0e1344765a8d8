"""The page shows of a moment what was: compared with an observer in the run, not the recorder."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from tests.budget import count
from tests.executor.forks import completed
from tests.executor.recorder.page import segment, shown_by_page

ROOT = Path(__file__).parents[3]
MOMENTS = 50
AT_ONCE = 10
IN_PLACE = 2**32 - 1
NEAR_M = 0.01
NEAR_RAD = 0.25
"""Poses are recorded 30 times in a second; a wheel or a ball turns by as much between them when it hits."""

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(600)]


class Seen:
    """The notes of the observer in a run."""

    def __init__(self, path: Path) -> None:
        notes = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
        self.nodes = next(note["nodes"] for note in notes if note["kind"] == "tree")
        self.ticks, self.prints, self.scans, self.raised = (
            [note for note in notes if note["kind"] == kind] for kind in ("tick", "print", "scan", "raise")
        )

    def tick_at(self, moment: dict[str, Any], late_s: float) -> dict[str, Any] | None:
        """Returns the tick of a moment: the last before it; where times differ, that of the same number."""
        ticks = (tick for tick in reversed(self.ticks))
        if late_s:
            return next((tick for tick in ticks if tick["n"] == moment["tick"]), None)
        return next((tick for tick in ticks if tick["t"] <= moment["t"]), None)

    def written_until(self, last: dict[str, Any]) -> dict[tuple[str, str], tuple[float, int]]:
        """Returns the time and the writer of each entry's last write, up to a tick."""
        found: dict[tuple[str, str], tuple[float, int]] = {}
        for tick in self.ticks[: self.ticks.index(last) + 1]:
            for scope, key, removed, writer in tick["writes"]:
                found[scope, key] = (tick["t"], writer)
                if removed:
                    del found[scope, key]
            for scope, key in tick["in_place"]:
                found[scope, key] = (tick["t"], IN_PLACE)
        return found


@pytest.mark.parametrize("first", range(0, count("recorder_truth_runs"), AT_ONCE))
def test_at_random_moments_of_random_runs_the_page_shows_what_was(tmp_path: Path, first: int) -> None:
    seeds = range(first, min(first + AT_ONCE, count("recorder_truth_runs")))
    done = completed("tests.executor.recorder.truth_run", tmp_path, MOMENTS, *seeds)
    assert done.returncode == 0, done.stderr
    for seed in seeds:
        places = json.loads((tmp_path / f"{seed}.poses").read_text())
        shown = shown_by_page([(tmp_path / f"{seed}.mcap", segment())], [t for t, _ in places])
        assert shown["failures"] == []
        seen = Seen(tmp_path / f"{seed}.notes")
        texts = [fault["message"] for fault in shown["overview"]["faults"]]
        assert texts.count("ValueError: on purpose") == len(seen.raised)  # others are of the engine
        for moment, (t, poses) in zip(shown["moments"], places, strict=True):
            where = f"seed {seed} at {t} s"
            compare_tree(seen, moment, where)
            compare_scan(seen, moment, where)
            compare_console(seen, shown["overview"]["faults"], moment, where)
            compare_poses(dict(enumerate(poses)), moment, where)


def compare_tree(seen: Seen, moment: dict[str, Any], where: str, *, late_s: float = 0.0) -> None:
    """Compares nodes, statuses, flashes, and the blackboard with its writers."""
    assert [[node["uid"], node["path"], node["type"]] for node in moment["tree"]] == seen.nodes, where
    tick = seen.tick_at(moment, late_s)
    assert tick is not None, where
    assert moment["tick"] == tick["n"], where
    assert moment["tickT"] == pytest.approx(tick["t"], abs=late_s + 1e-6), where
    assert {str(uid): status for uid, status in moment["statuses"]} == tick["status"], where
    assert moment["flashes"] == tick["flashed"], where
    shown = {
        (e["scope"], e["key"]): (e["type"], [] if e["isPreview"] else [e["value"]]) for e in moment["entries"]
    }
    was = {
        (scope, key): (kind, [json.loads(text) for text in texts])
        for scope, key, kind, texts in tick["entries"]
    }
    assert shown == was, where
    written = seen.written_until(tick)
    for entry in moment["entries"]:
        if (entry["scope"], entry["key"]) not in written:
            assert (entry["type"], entry["since"], entry["writer"]) == ("empty", None, None), (where, entry)
            continue
        t, writer = written[entry["scope"], entry["key"]]
        assert entry["since"] == pytest.approx(t, abs=late_s + 1e-6), (where, entry)
        # A value may be changed in place after it was written in the same tick.
        assert entry["writer"] in {writer, IN_PLACE}, (where, entry)


def compare_scan(seen: Seen, moment: dict[str, Any], where: str) -> None:
    """Compares the nearest scan, where the application hears scans."""
    before = [scan for scan in seen.scans if scan["t"] <= moment["t"]]
    if not before or before[-1] is seen.scans[-1]:
        return  # the last one may not be the last that was sent
    assert moment["scan"] is not None, where
    assert moment["scan"]["t"] == pytest.approx(before[-1]["t"], abs=1e-6), where
    assert moment["scan"]["ranges"] == before[-1]["ranges"], where


def compare_console(seen: Seen, faults: list[Any], moment: dict[str, Any], where: str) -> None:
    """Compares all lines of the application up to the moment; faults stand between them."""
    rows = [
        (round(note["t"], 6), 0, "error" if note["error"] else "info", line)
        for note in seen.prints
        for line in note["text"].split("\n")
    ] + [(round(fault["t"], 6), 1, "error", line) for fault in faults for line in lines_of(fault)]
    was = [(level, text) for t, _, level, text in sorted(rows, key=lambda row: row[:2]) if t <= moment["t"]]
    shown = [(level, text) for _, source, level, text, _ in moment["console"] if source == "action"]
    assert shown == was, where


def lines_of(fault: dict[str, Any]) -> list[str]:
    text: str = fault["traceback"] or fault["message"]
    return text.removesuffix("\n").split("\n")


def compare_poses(was: dict[int, list[float]], moment: dict[str, Any], where: str) -> None:
    """Compares where every object is."""
    shown = dict(moment["poses"])
    assert shown.keys() == was.keys(), where
    for number, pose in shown.items():
        assert math.dist(pose[:3], was[number][:3]) < NEAR_M, (where, number, pose, was[number])
        same = abs(sum(a * b for a, b in zip(pose[3:], was[number][3:], strict=True)))
        assert 2 * math.acos(min(1.0, same)) < NEAR_RAD, (where, number, pose, was[number])
