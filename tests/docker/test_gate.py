"""Keeper and gate as they are deployed: their rights, and a session that attacks the doors."""

from __future__ import annotations

import asyncio
import json
import os
import subprocess
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.docker.engine import REPOSITORY, build_images, engine
from tests.docker.stack import COMPOSE, PROXY, Stack
from tests.docker.test_stack import BUMP, hostile, run, run_app, started, ticks_on
from tests.e2e.server import wait_until

BUILT = os.environ.get("BT_STUDIO_TEST_IMAGES", "")
TAG = BUILT or "test"
FLOODER = (Path(__file__).parent / "flooder.py").read_text()
# The stack here has no Caddy, as behind a custom proxy; `test_up.py` checks Caddy's limits.
WITHOUT = {
    name for name, service in yaml.safe_load(PROXY.read_text())["services"].items() if "profiles" in service
}
SERVICES = sorted(set(yaml.safe_load(COMPOSE.read_text())["services"]) - WITHOUT)
CHECK = ("python3", "-m", "backend.sessions.gate", "--check")
# The limit of the keeper for a session that starts slowly.
HOLD = """
import socket, sys
from pathlib import Path
from backend.sessions.gate.client import Door
ours, handed = socket.socketpair()
with Door(Path("/run/bt-studio-control/gate.sock"), handed, "held", "t" * 64).open() as door:
    print(door.path, flush=True)
    sys.stdin.read()
"""
pytestmark = [pytest.mark.timeout(1800)]


@pytest.fixture(scope="module")
def stack(tmp_path_factory):
    folder = tmp_path_factory.mktemp("gate")
    with engine(folder) as running:
        if not BUILT:
            build_images(running, TAG)
        made = Stack(running, folder, TAG, BT_STUDIO_MAX_SESSIONS="3", BT_STUDIO_SESSION_CPUS="1")
        try:
            made.up()
            yield made
        finally:
            print(made.compose("logs", "--tail=60", check=False).stdout)
            made.down()


@pytest.fixture(scope="module")
def ann(stack):
    return stack.add_user("ann")


@pytest.fixture(scope="module")
def ben(stack):
    return stack.add_user("ben")


@pytest.fixture(scope="module")
def projects(ann, ben):
    """Creates one project of the same example for each user."""
    return {user: user.post("projects", {"name": "Bump", "template": BUMP})["id"] for user in (ann, ben)}


def inspected(stack, service):
    return json.loads(stack.engine.run("inspect", stack.container(service)).stdout)[0]


def health(stack, service):
    return inspected(stack, service)["State"]["Health"]["Status"]


def is_back(stack, service):
    wait_until(lambda: health(stack, service) == "healthy", f"{service} is healthy")


@pytest.mark.parametrize("service", SERVICES)
def test_each_container_has_its_limits(stack, service):
    host = inspected(stack, service)["HostConfig"]
    assert 0 < host["Memory"] <= 8 << 30
    assert 0 < host["PidsLimit"] <= 2048
    [files] = [one for one in host["Ulimits"] if one["Name"] == "nofile"]
    assert 0 < files["Hard"] <= 65536
    assert "no-new-privileges:true" in host["SecurityOpt"]
    assert not host["Privileged"]


@pytest.mark.parametrize(("service", "uid"), [("keeper", 10003), ("gate", 10004)])
def test_keeper_and_gate_are_no_root_and_have_no_network(stack, service, uid):
    found = inspected(stack, service)
    host = found["HostConfig"]
    assert (host["NetworkMode"], host["ReadonlyRootfs"], host["CapDrop"]) == ("none", True, ["ALL"])
    assert int(stack.compose("exec", "-T", service, "id", "-u").stdout) == uid
    mounts = {mount["Destination"] for mount in found["Mounts"]}
    assert ("/var/run/docker.sock" in mounts) == (service == "keeper")
    is_back(stack, service)
    notices = stack.compose("exec", "-T", service, "cat", "THIRD-PARTY-NOTICES").stdout
    assert notices.startswith("# Third-party notices")


def test_without_the_sockets_group_the_keeper_says_which_one_it_takes(stack):
    socket = stack.engine.socket
    mount = f"{socket}:/var/run/docker.sock"
    done = stack.engine.run("run", "--rm", "-v", mount, f"bt-studio-keeper:{TAG}", check=False)
    assert done.returncode == 1
    assert f"keeper_group: Docker's socket /var/run/docker.sock belongs to group {socket.stat().st_gid}" in (
        done.stderr
    )
    assert f"Set BT_STUDIO_DOCKER_GID={socket.stat().st_gid} in docker/.env" in done.stderr


@contextmanager
def held_door(stack):
    """Yields the name of a door that stays open."""
    command = [stack.engine.docker, "exec", "-i", stack.container("keeper"), "python3", "-c", HOLD]
    pipes: Any = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, cwd=REPOSITORY, env=stack.engine.environment, **pipes) as keeper:
        yield keeper.stdout.readline().strip()
        keeper.stdin.close()
        assert keeper.wait(60) == 0


async def test_listing_guessing_and_flooding_finds_no_door_and_blocks_no_session(stack, ann, ben, projects):
    with held_door(stack) as door:
        source = FLOODER + f"\nDOOR = {door!r}\n"
        async with started(ann, projects[ann]) as attacker:
            await run_app(attacker, hostile(ann, projects[ann], source))
            line = await attacker.event("log", lambda data: data["text"].startswith("FOUND "), timeout_s=120)
            found = json.loads(line["data"]["text"].removeprefix("FOUND "))
            assert found["list"] == found["watch"] == "refused: PermissionError"
            assert found["write"] == "refused: OSError"  # a read-only mount
            assert found["root"] == "refused: FileNotFoundError"
            assert found["own"] == found["guessed"] == ["refused: FileNotFoundError"]
            assert (found["named"], found["control"]) == ([], False)
            # The test passes the name to it, which a session never learns, and it floods that door.
            await attacker.event("log", lambda data: data["text"] == "FLOODED 2000", timeout_s=120)
            async with started(ben, projects[ben]) as other:
                await run(other, ben, projects[ben], "walled_room")
                await ticks_on(other)
                assert stack.compose("exec", "-T", "gate", *CHECK, check=False).returncode == 0
                await ticks_on(other)
            await attacker.event("log", lambda data: data["text"].startswith("FLOODED"), timeout_s=120)


async def test_a_robot_lives_through_the_end_of_keeper_and_gate(stack, ann, ben, projects):
    async with started(ben, projects[ben]) as driven:
        await run(driven, ben, projects[ben], "walled_room")
        for service in ("gate", "keeper"):
            stack.engine.run("kill", "--signal", "KILL", stack.container(service))
            await ticks_on(driven)
            stack.compose("up", "-d", "gate", "keeper")
            await asyncio.to_thread(is_back, stack, service)
            session = await asyncio.to_thread(ann.post, f"projects/{projects[ann]}/session")
            async with started(ann, projects[ann]) as new:
                await run(new, ann, projects[ann], "walled_room")
                await ticks_on(new)
            await asyncio.to_thread(ann.delete, f"sessions/{session['id']}")
            await ticks_on(driven)
