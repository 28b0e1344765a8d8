"""Controls that are visible in the first project while it runs: `python -m tests.benchmarks.controls`.

At 1440 x 900. The counts stand in `docs/explanation/ten-tasks.md`.
"""

from __future__ import annotations

import argparse
import tempfile
from collections import Counter
from pathlib import Path
from typing import Final

from playwright.sync_api import expect, sync_playwright

from tests.e2e.conftest import CHROMIUM, QUIET, SOFTWARE_WEBGL
from tests.e2e.controls import visible_controls
from tests.e2e.server import serving
from tests.e2e.studio import Studio

TEMPLATE: Final = "laser_bump_and_go"


def count(*, is_basic: bool, is_listed: bool) -> int:
    """Opens the first project of a new user, runs it, and returns how many controls are visible."""
    expect.set_options(timeout=60_000)
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*QUIET, *SOFTWARE_WEBGL])
        with serving(Path(folder)) as server:
            context = browser.new_context(viewport={"width": 1440, "height": 900})
            studio = Studio(context.new_page(), server, is_basic=is_basic)
            studio.page.set_default_timeout(120_000)
            studio.open()
            studio.new_from(TEMPLATE)
            studio.run()
            expect(studio.at("time-axis")).to_be_visible()
            found = visible_controls(studio.page)
            studio.picture("controls")
            context.close()
        browser.close()
    for part, number in Counter(part for part, _ in found).most_common():
        print(f"{number:4}  {part or 'elsewhere'}")
        if is_listed:
            print("      " + ", ".join(name for each, name in found if each == part))
    return len(found)


def main() -> None:
    """Prints the counts by part, and their sum."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.controls", description=__doc__)
    parser.add_argument("--list", action="store_true", help="names each control")
    parser.add_argument("--full", action="store_true", help="after *Show more*, as for who is no beginner")
    options = parser.parse_args()
    print(f"{count(is_basic=not options.full, is_listed=options.list):4}  controls")


if __name__ == "__main__":
    main()
