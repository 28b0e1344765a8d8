"""Writes the answers of libsdformat down: `python -m tests.tools.sdf_oracle`."""

from __future__ import annotations

import json
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Final

from tests.tools.sdf_oracle.build import ask, is_there
from tests.tools.sdf_oracle.random_worlds import COUNT, world_of

STORED: Final = Path(__file__).with_name("answers.json")
DEFAULTS: Final = Path(__file__).with_name("defaults.json")
SPECIFICATION: Final = Path("/usr/share/sdformat12/1.9")
"""Of Debian's `sdformat-sdf`."""


def defaults_in(folder: Path) -> dict[str, str]:
    """Returns the default of each child that has one, by `element.child`, as the specification has them."""
    found: dict[str, str] = {}
    for path in sorted(folder.glob("*.sdf")):
        for element in ET.parse(path).getroot().iter("element"):  # noqa: S314 - Debian's own files
            for child in element.findall("element"):
                key = f"{element.get('name')}.{child.get('name')}"
                if child.get("default") is not None:
                    found.setdefault(key, child.get("default", ""))
    return found


def main() -> int:
    """Asks about all random worlds, and stores the answers."""
    if not is_there():
        print("libsdformat is missing: apt-get install libsdformat-dev", file=sys.stderr)
        return 1
    worlds = {f"{number}.sdf": world_of(number) for number in range(COUNT)}
    with tempfile.TemporaryDirectory() as folder:
        answers = ask(worlds, Path(folder))
    rounded = {
        name: {key: [round(value, 8) for value in pose] for key, pose in found.items()}
        for name, found in answers.items()
    }
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(found)}" for name, found in rounded.items())
    STORED.write_text(f"{{\n{lines}\n}}\n")
    DEFAULTS.write_text(json.dumps(defaults_in(SPECIFICATION), indent=0, sort_keys=True) + "\n")
    refused = [name for name, found in answers.items() if not found]
    print(
        f"{STORED}: {len(answers)} worlds, {len(refused)} of them refused or empty: {', '.join(refused[:9])}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
