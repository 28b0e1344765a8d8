"""Makes the README's moving picture: *Laser bump and go* in a real browser, from Run to the first turns.

`python -m tests.tools.moving_picture [FILE]` writes an animated WebP, `docs/images/running.webp` if no other
file is named. It needs Chromium and a page that is built (`make run` builds it). The pictures are screenshots
of the page, shown at the times at which they were taken; look at the result before you store it.
"""

from __future__ import annotations

import sys
import tempfile
from itertools import pairwise
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import cv2
import numpy as np
from playwright.sync_api import sync_playwright

from tests.e2e.conftest import CHROMIUM, QUIET, SOFTWARE_WEBGL
from tests.e2e.server import serving, wait_until
from tests.e2e.studio import Studio

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT: Final = Path(__file__).resolve().parents[2]
PICTURE: Final = ROOT / "docs" / "images" / "running.webp"
PAGE: Final = {"width": 1440, "height": 900}
WIDTH, HEIGHT = 960, 600
# How much of the world's time it shows, and how often a picture is taken of it, in seconds.
SHOWN_S, EVERY_S = 18.0, 0.3
MOST_BYTES: Final = 2_000_000
QUALITIES: Final = (75, 60, 45, 30)

Pixels = np.ndarray[Any, np.dtype[np.uint8]]


class Shot(NamedTuple):
    """A picture of the page, and the world's time in it."""

    time_s: float
    pixels: Pixels


def taken() -> Iterator[Shot]:
    """Runs the example in a browser and takes pictures of it."""
    with (
        tempfile.TemporaryDirectory() as folder,
        serving(Path(folder)) as server,
        sync_playwright() as playwright,
    ):
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*QUIET, *SOFTWARE_WEBGL])
        context = browser.new_context(viewport={"width": PAGE["width"], "height": PAGE["height"]})
        studio = Studio(context.new_page(), server)
        studio.open()
        studio.new_from("laser_bump_and_go")
        studio.choose("sim-speed", "×0.1")  # a picture takes seconds where the processor draws
        studio.run()
        observer = studio.observe()
        wait_until(lambda: observer.distance_travelled("robot") > 0.0, "the robot moves")
        began = observer.sim_time()
        while (time := observer.sim_time() - began) < SHOWN_S:
            yield Shot(time, reduced(studio.page.screenshot()))
            observer.wait_for_sim_time(began + time + EVERY_S)
        observer.close()
        browser.close()


def reduced(png: bytes) -> Pixels:
    """Returns a screenshot in the size of the moving picture."""
    pixels = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)
    if pixels is None:
        raise ValueError("The browser's screenshot is no picture.")
    return np.asarray(cv2.resize(pixels, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA), np.uint8)


def durations(times_s: list[float], last_msec: int = 1000) -> list[int]:
    """Returns for how many milliseconds each picture is shown: until the next one."""
    between = [round((after - before) * 1000) for before, after in pairwise(times_s)]
    return [*between, last_msec]


def write(shots: list[Shot], file: Path) -> int:
    """Writes the pictures as one, as good as its size permits; returns its bytes."""
    animation = cv2.Animation()
    animation.frames = [shot.pixels for shot in shots]
    animation.durations = durations([shot.time_s for shot in shots])
    for quality in QUALITIES:
        if not cv2.imwriteanimation(str(file), animation, [cv2.IMWRITE_WEBP_QUALITY, quality]):
            raise OSError(f"{file} could not be written.")
        if (size := file.stat().st_size) <= MOST_BYTES:
            return size
    file.unlink()
    raise ValueError(f"{len(shots)} pictures need more than {MOST_BYTES} bytes: show less of the run.")


def main(names: list[str]) -> None:
    """Makes the picture."""
    file = Path(names[0]) if names else PICTURE
    began = monotonic()
    shots = list(taken())
    print(f"{len(shots)} pictures in {monotonic() - began:.0f} s, {write(shots, file)} bytes: {file}")


if __name__ == "__main__":
    main(sys.argv[1:])
