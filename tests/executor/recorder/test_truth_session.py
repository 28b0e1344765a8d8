"""As `test_truth`, for real sessions: read in segments as the page does, and as the file that is kept."""

from __future__ import annotations

import asyncio
import base64
import math
import random
import urllib.request
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from executor.messages import Poses, RecordingPart
from executor.stream.pose_codec import POSE_BYTES, unpack
from tests.budget import count
from tests.executor.recorder.page import segment, shown_by_page
from tests.executor.recorder.test_process import runs_before
from tests.executor.recorder.test_truth import MOMENTS, Seen, compare_poses, compare_scan, compare_tree
from tests.executor.recorder.truth_app import random_app
from tests.executor.session_client import TOKEN, SessionClient, run_data
from tests.executor.warm import warm_session
from translator.package.zip import write_zip

if TYPE_CHECKING:
    from pathlib import Path

SPEED = 2.0
LASTS_S = 44.0
"""Simulated; two segments end within it."""
LATE_S = 0.1 * SPEED
"""A process hears of the time, and a line is printed, so much later than elsewhere."""
LONGEST_GAP_S = 0.06
PART_BYTES = 1 << 20

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(300)]


@pytest.mark.parametrize("seed", range(1, 1 + count("recorder_truth_sessions")))
async def test_at_random_moments_of_a_session_the_page_shows_what_was(tmp_path: Path, seed: int) -> None:
    app = base64.b64encode(write_zip(random_app(seed, tmp_path / "notes", raises=False))).decode()
    async with warm_session() as (manager, client):
        before = await runs_before(client)
        await client.ask("subscribe", {"stream": "poses", "max_hz": 60.0})
        data = run_data(app, universe="football", on_error="failure")
        data["universe"]["speed"] = SPEED
        assert await client.ask("run", data) == "ack"
        await client.event("segment", lambda d: d["run"] not in before and d["to_t"] > LASTS_S)
        assert await client.ask("pause") == "ack"
        newest = {event["number"]: event for event in client.named("segment") if event["run"] not in before}
        parts = [(await fetched(client, event, tmp_path), event) for _, event in sorted(newest.items())]
        kept = tmp_path / "kept.mcap"
        run = parts[0][1]["run"]
        kept.write_bytes(await asyncio.to_thread(download, manager.ready["port"], run))
        ways = ways_of([frame for _, frame in client.frames if isinstance(frame, Poses)])
    assert len(parts) > LASTS_S // 20
    at = moments(random.Random(seed), ways)  # noqa: S311 - reproducible moments, no secret
    seen = Seen(tmp_path / "notes")
    for shown in (shown_by_page(parts, at), shown_by_page([(kept, segment())], at)):
        assert shown["failures"] == []
        for t, moment in zip(at, shown["moments"], strict=True):
            where = f"seed {seed} at {t} s"
            compare_tree(seen, moment, where, late_s=LATE_S)
            compare_scan(seen, moment, where)
            compare_lines(seen, moment, where)
            compare_poses({number: pose_at(way, t) for number, way in ways.items()}, moment, where)


async def fetched(client: SessionClient, event: dict[str, Any], folder: Path) -> Path:
    """Reads a segment from the session, as the page does."""
    path = folder / f"{event['number']}.mcap"
    data = b""
    where = {name: event[name] for name in ("run", "branch", "version")} | {"segment": event["number"]}
    while len(data) < event["bytes"]:
        length = min(PART_BYTES, event["bytes"] - len(data))
        assert await client.ask("read_recording", {**where, "offset": len(data), "length": length}) == "ack"
        at = len(data)
        data += (
            await client.until(
                lambda: next(
                    (
                        frame
                        for _, frame in client.frames
                        if isinstance(frame, RecordingPart)
                        and (frame.segment, frame.offset) == (event["number"], at)  # noqa: B023 - awaited
                    ),
                    None,
                )
            )
        ).data
    path.write_bytes(data)
    return path


def download(port: int, run: str) -> bytes:
    """Returns the joined recording of a run."""
    data, total = b"", 1
    while len(data) < total:
        url = f"http://127.0.0.1:{port}/recordings/{run}/0"
        headers = {"Authorization": f"Bearer {TOKEN}", "Range": f"bytes={len(data)}-"}
        with urllib.request.urlopen(urllib.request.Request(url, headers=headers)) as answer:
            data += answer.read()
            total = int(answer.headers["Content-Range"].rpartition("/")[2])
    return data


def compare_lines(seen: Seen, moment: dict[str, Any], where: str) -> None:
    """Compares the lines of the application; those of the last moments may be there or not."""
    rows = [(note["t"], line) for note in seen.prints for line in note["text"].split("\n")]
    shown = [text for _, source, _, text, _ in moment["console"] if source == "action"]
    assert shown == [text for _, text in rows][: len(shown)], where
    surely = sum(t <= moment["t"] - LATE_S for t, _ in rows)
    perhaps = sum(t <= moment["t"] + LATE_S for t, _ in rows)
    assert surely <= len(shown) <= perhaps, where


def ways_of(frames: list[Poses]) -> dict[int, list[tuple[float, Any]]]:
    """Returns the poses of each object with their times, as a second listener of the stream got them."""
    ways: dict[int, list[tuple[float, Any]]] = {}
    for frame in frames:
        for place, number in enumerate(memoryview(frame.ids).cast("H")):
            record = frame.poses[place * POSE_BYTES : (place + 1) * POSE_BYTES]
            ways.setdefault(number, []).append((frame.t, np.array(unpack(record))))
    return ways


def moments(chance: random.Random, ways: dict[int, list[tuple[float, Any]]]) -> list[float]:
    """Returns random times at which the listener got all frames; a slow machine leaves some out."""
    times = np.array(sorted({t for way in ways.values() for t, _ in way}))
    gaps = np.diff(times)
    found: list[float] = []
    while len(found) < MOMENTS:
        t = chance.uniform(1.0, LASTS_S - 1.0)
        at = int(np.searchsorted(times, t))
        if gaps[max(at - 4, 0) : at + 3].max() <= LONGEST_GAP_S:
            found.append(t)
    return sorted(found)


def pose_at(way: list[tuple[float, Any]], t: float) -> list[float]:
    """Returns a pose at a time; between two that are near each other in time, it is between them."""
    before = next((each for each in reversed(way) if each[0] <= t), way[0])
    after = next((each for each in way if each[0] > t), before)
    if after[0] - before[0] > 0.2 or math.isclose(after[0], before[0]):
        return [float(x) for x in before[1]]
    share = (t - before[0]) / (after[0] - before[0])
    second = after[1].copy()
    if float(before[1][3:] @ second[3:]) < 0:
        second[3:] *= -1
    found = before[1] + (second - before[1]) * share
    found[3:] /= np.linalg.norm(found[3:])
    return [float(x) for x in found]
