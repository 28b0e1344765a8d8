"""Writes the built-in textures for the universe editor: `python -m executor.generate.textures`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Final

from executor.universes.model import TEXTURES
from executor.world.physics.paint import shipped

FOLDER: Final = Path(__file__).parents[2] / "frontend" / "src" / "generated" / "textures"


def main() -> None:
    """Writes each texture, and the width and height in m that it covers."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    tiles = {}
    for name in TEXTURES:
        jpeg, tile = shipped(name)
        (FOLDER / f"{name}.jpg").write_bytes(jpeg)
        tiles[name] = list(tile)
    (FOLDER / "tiles.json").write_text(json.dumps(tiles, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
