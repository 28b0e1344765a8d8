"""Asks the page's own code what it shows at moments of a recording (`frontend/harness`)."""

from __future__ import annotations

import functools
import json
import subprocess
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

FRONTEND = Path(__file__).parents[3] / "frontend"


@functools.cache
def _program(name: str) -> Path:
    """Builds a program below the page's packages, which it loads."""
    cache = FRONTEND / "node_modules" / ".cache"
    cache.mkdir(exist_ok=True)
    folder = Path(tempfile.mkdtemp(prefix="moments-", dir=cache))
    vite = FRONTEND / "node_modules" / ".bin" / "vite"
    options = ["--config", "harness/vite.config.ts", "--ssr", f"{name}.ts", "--outDir", str(folder)]
    subprocess.run([str(vite), "build", *options, "--logLevel", "warn"], cwd=FRONTEND, check=True)
    return folder / f"{name}.js"


def segment(number: int = 0, **more: Any) -> dict[str, Any]:
    """Returns the event of a segment; that of a whole file without more arguments."""
    whole = {"run": "a1", "branch": 0, "version": 0, "from_t": 0.0, "to_t": 1e9, "bytes": 0, "complete": True}
    return whole | {"number": number} | more


def shown_by_page(parts: Sequence[tuple[Path, dict[str, Any]]], at: Sequence[float]) -> dict[str, Any]:
    """Returns the page's overview of a recording, its failures, and what it shows at each time in s."""
    wish = {"parts": [{"file": str(file), "segment": part} for file, part in parts], "at": list(at)}
    done = subprocess.run(
        ["node", str(_program("moments"))],
        input=json.dumps(wish),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def decoded_by_page(file: Path) -> list[Any]:
    """Returns topic, time in s and fields of every message of a recording."""
    command = ["node", str(_program("decoded")), str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    result: list[Any] = json.loads(done.stdout)
    return result
