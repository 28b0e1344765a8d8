"""The translator's table of limits, read from its file because importing the translator is slow."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Final

_TABLE: Final = Path(__file__).resolve().parents[2] / "translator" / "limits.json"
LIMITS: Final[dict[str, int]] = {
    row["name"]: row["value"] for row in json.loads(_TABLE.read_text(encoding="utf-8"))["limits"]
}
