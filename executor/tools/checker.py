"""Runs ruff once on a text: with a timeout, and without configuration except its arguments."""

from __future__ import annotations

import asyncio
import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection

__all__ = ["run_ruff", "serve_checker"]

TIMEOUT_S: Final = 5.0
PROGRAM: Final = str(Path(sys.executable).with_name("ruff"))


async def serve_checker(connection: ServerConnection) -> None:
    """Receives `{arguments, source}` as JSON, and answers `{status, output}`.

    The status is null after a timeout.
    """
    asked = json.loads(await connection.recv())
    await connection.send(json.dumps(await run_ruff(asked["arguments"], asked["source"])))


async def run_ruff(arguments: list[str], source: str, program: str = PROGRAM) -> dict[str, Any]:
    """Runs the program with a source as its input.

    Returns its `status` (None after a timeout) and its `output`.
    """
    process = await asyncio.create_subprocess_exec(
        program,
        *arguments,
        stdin=asyncio.subprocess.PIPE,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.DEVNULL,
        cwd="/",
        env={"PATH": os.defpath, "LANG": "C.UTF-8", "RAYON_NUM_THREADS": "1"},
    )
    try:
        output, _ = await asyncio.wait_for(process.communicate(source.encode()), TIMEOUT_S)
    except TimeoutError:
        process.kill()
        await process.wait()
        return {"status": None, "output": ""}
    return {"status": process.returncode, "output": output.decode()}
