"""A whole session driven by JdeRobot's own npm client, with the real world and application."""

from __future__ import annotations

import asyncio
import json

import pytest

from tests.executor.session_client import ROOT, app_zip, manager_process

pytestmark = pytest.mark.simulation
CLIENT = ROOT / "tests" / "ram_client"
CALLS = [
    "pause", "connect", "launchWorld", "prepareTools", "run", "running", "pause", "resume", "stop",
    "terminateApplication", "terminateTools", "terminateWorld", "disconnect", "connect",
]  # fmt: skip
WORLD = {
    "name": "Laser Bump and Go",
    "scene": {"name": "walled_room", "launch_file_path": "/opt/x.launch.py", "type": "gz"},
    "robot": [{"name": "turtlebot2", "launch_file_path": "/opt/robot.launch.py", "type": "gz"}],
}  # fmt: skip


async def drive(address, session):
    process = await asyncio.create_subprocess_exec(
        "node", "--no-warnings", "--experimental-websocket", "session.mjs", address,
        stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE, cwd=CLIENT,
    )  # fmt: skip
    try:
        out, _ = await asyncio.wait_for(process.communicate(json.dumps(session).encode()), 100)
    finally:
        if process.returncode is None:
            process.kill()
            await process.wait()
    return [json.loads(line) for line in out.splitlines()]


async def test_the_npm_client_drives_a_whole_session():
    code = f"data:application/zip;base64,{app_zip()}"
    async with manager_process("--ram") as manager:
        address = f"ws://127.0.0.1:{manager.ready['port']}"
        lines = await drive(address, {"world": WORLD, "code": code, "calls": CALLS})
    outcome = [(line["call"], line["command"], line["state"]) for line in lines if "call" in line]
    assert outcome == [
        ("pause", "error", "idle"),
        ("connect", "ack", "connected"),
        ("launchWorld", "ack", "world_ready"),
        ("prepareTools", "ack", "tools_ready"),
        ("run", "ack", "application_running"),
        ("running", "update", "application_running"),
        ("pause", "ack", "paused"),
        ("resume", "ack", "application_running"),
        ("stop", "error", "application_running"),
        ("terminateApplication", "ack", "tools_ready"),
        ("terminateTools", "ack", "world_ready"),
        ("terminateWorld", "ack", "connected"),
        ("disconnect", "ack", "idle"),
        ("connect", "ack", "connected"),
    ]
    by_call = {line["call"]: line for line in lines if "call" in line}
    assert "Can't trigger event pause from state idle!" in lines[0]["data"]["message"]
    assert by_call["stop"]["data"]["message"] == "Do not know event named 'stop'."
    assert by_call["connect"]["data"] is None
    first = [next(iter(line)) for line in lines[1:4]]
    assert first == ["introspection", "state", "call"]
    assert {"robotics_backend_version", "ros_version", "gpu_avaliable"} <= set(lines[1]["introspection"])
    tree = by_call["running"]["data"]["tree"]
    [root] = tree.values()
    assert root["state"] == "RUNNING"
