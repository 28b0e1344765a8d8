"""A hostile user attacks for ten minutes, from inside a session and by the web, while another works.

The attacker runs on the server's machine, so the attacking client is *nice* (19) and bound to one core:
only the server's work may slow the other user down, not the attacker's own. The bound is a ratio: the other
user's requests during the attack against the same requests just before it, in the same stack.
"""

from __future__ import annotations

import asyncio
import json
import os
import statistics
import subprocess
import sys
import time
from contextlib import asynccontextmanager
from functools import partial
from typing import Any

import pytest

from tests.budget import count
from tests.docker.engine import REPOSITORY, build_images, engine
from tests.docker.stack import Stack
from tests.docker.test_stack import BUMP, distance_m, run, run_app, save, ticks
from tests.hostile.projects import large_files
from tests.hostile.wire import guest_cookie

BUILT = os.environ.get("BT_STUDIO_TEST_IMAGES", "")
TAG = BUILT or "test"
# A developer who analyses a failure may set a shorter time.
MINUTES = float(os.environ.get("BT_STUDIO_HOSTILE_MINUTES") or count("hostile_minutes"))
QUIET_S = min(90.0, 60 * MINUTES)
PHASE_S = min(15.0, 60 * MINUTES / 12)
PAUSE_S = 0.1
NODES = 100_000
MOST_TIMES = 3.0
LOOK_S = 15.0
INSIDE = (REPOSITORY / "tests" / "hostile" / "inside.py").read_text()
pytestmark = [pytest.mark.timeout(3600)]


@pytest.fixture(scope="module")
def stack(tmp_path_factory):
    folder = tmp_path_factory.mktemp("hostile")
    with engine(folder) as running:
        if not BUILT:
            build_images(running, TAG)
        made = Stack(
            running,
            folder,
            TAG,
            BT_STUDIO_MAX_SESSIONS="4",
            BT_STUDIO_PROXY_HOPS="0",
            BT_STUDIO_RESERVED_CPUS="1",
        )
        try:
            made.up()
            yield made
        finally:
            print(made.compose("logs", "--tail=40", check=False).stdout)
            made.down()


def process(module, plan):
    """Runs a program of `tests.hostile`; it prints JSON."""
    started = subprocess.Popen(
        [sys.executable, "-m", module],
        cwd=REPOSITORY,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    started.stdin.write(json.dumps(plan))
    started.stdin.close()
    started.stdin = None
    return started


def told(started, timeout_s=600):
    out, err = started.communicate(timeout=timeout_s)
    assert started.returncode == 0, err[-3000:]
    return json.loads(out)


def p95(samples):
    """Returns the p95 of milliseconds; of few samples the largest."""
    times = sorted(ms for _, _, ms, _ in samples)
    return statistics.quantiles(times, n=20)[18] if len(times) >= 20 else times[-1]


def table(title, groups):
    """Returns rows of p95s: before, during the attack, and their ratio."""
    print(
        f"{title:16} {'quiet':>12} {'p95 ms':>8} {'attacked':>9} {'p95 ms':>8} {'ratio':>6} {'worst ms':>9}"
    )
    for name, quiet, attacked in groups:
        if quiet and attacked:
            before, beside = p95(quiet), p95(attacked)
            worst = max(ms for _, _, ms, _ in attacked)
            counts = f"{len(quiet):12} {before:8.1f} {len(attacked):9} {beside:8.1f}"
            print(f"{name:16} {counts} {beside / before:6.2f} {worst:9.0f}")


def phase_of(sample, phases):
    return next((kind for kind, began, _ in reversed(phases) if began <= sample[1]), "")


@asynccontextmanager
async def working(stack, user, project):
    """Runs a user with a robot that drives, an editor, and a page that waits for notices."""
    session = user.post(f"projects/{project}/session")
    client = await user.open_session(session)
    try:
        await run(client, user, project, "walled_room")
        await client.until(lambda: distance_m(client) > 0.05, 120)
        async with user.open_language(project) as editor, user.open_notices(project) as news:
            reading = [asyncio.create_task(read_all(socket)) for socket in (editor, news)]
            yield session["id"], client, (editor, news)
        await asyncio.gather(*reading)
    finally:
        await client.close()


async def read_all(socket):
    """Reads a socket as a browser does; a client that does not read answers no pings, and is disconnected."""
    async for _ in socket:
        pass


async def moves_on(client, until):
    """Checks at intervals that the robot has driven and its program has ticked."""
    looks = 0
    while time.monotonic() < until:
        await asyncio.sleep(LOOK_S)
        assert not client.is_closed, client.control.close_reason
        for what, now in (("ticks", ticks), ("drives", distance_m)):
            before = now(client)
            await client.until(lambda now=now, before=before: now(client) > before, 60)
            assert now(client) > before, what
        looks += 1
    return looks


async def attack_inside(user, project, until):
    """Runs hostile code in a session's container, and starts it again whenever it was ended."""
    starts = 0
    said: dict[Any, Any] = {}
    while time.monotonic() < until:
        starts += 1
        session = await asyncio.to_thread(user.post, f"projects/{project}/session")
        try:
            client = await user.open_session(session, stream=False)
        except (OSError, TimeoutError):
            continue
        try:
            source = f"{INSIDE}\nFIRST = {starts - 1}\n"
            app = await asyncio.to_thread(hostile_app, user, project, source)
            await run_app(client, app)
            left_s = max(0.0, until - time.monotonic())
            await client.until(partial(has_ended, client), left_s)
        except (AssertionError, TimeoutError, OSError) as error:
            said[type(error).__name__] = said.get(type(error).__name__, 0) + 1
        finally:
            for entry in client.named("log"):
                if entry["text"].startswith("TRIES "):
                    said[entry["text"].strip()] = said.get(entry["text"].strip(), 0) + 1
            await client.close()
    print(f"inside: {starts} starts, {said}")


def has_ended(client):
    return client.state != "application_running" or client.is_closed


def hostile_app(user, project, source):
    file = next(f for f in user.get(f"projects/{project}")["files"] if f["path"] == "actions/Forward.py")
    save(user, project, "actions/Forward.py", source, base=file["revision"])
    return user.app(project)


def make_large(user):
    """Creates a project of 100,000 nodes, with an older version that differs, and a public read-only link."""
    made = user.post("projects", {"name": "Large"})
    user.post(f"projects/{made['id']}/changes", {"files": large_files(NODES, made["files"])})
    link = user.post(f"projects/{made['id']}/shares/links", {})["links"][0]["url"]
    return made["id"], link


async def test_a_hostile_user_harms_nobody_else(stack):
    ann, eve = stack.add_user("ann"), stack.add_user("eve")
    project = ann.post("projects", {"name": "Bump", "template": BUMP})["id"]
    theirs = eve.post("projects", {"name": "Harm", "template": BUMP})["id"]
    large, link = make_large(eve)
    guest = guest_cookie(link)
    site = {
        "host": stack.address[0],
        "port": stack.address[1],
        "origin": stack.base,
        "guest": guest,
        "user": eve.cookies,
        "project": large,
        "account": "ann",
    }
    before = stack.restarts()
    async with working(stack, ann, project) as (session, client, open_sockets):
        who = {"host": site["host"], "port": site["port"], "origin": stack.base, "cookie": ann.cookies}
        who |= {"project": project, "session": session}
        plan = {"who": who, "seconds": QUIET_S, "pause_s": PAUSE_S}
        quiet = await asyncio.to_thread(told, process("tests.hostile.bystander", plan))

        until = time.monotonic() + 60 * MINUTES
        attacker = {"site": site, "seconds": 60 * MINUTES, "phase_s": PHASE_S}
        attacker["cores"] = sorted(os.sched_getaffinity(0))[-1:]
        attacking = process("tests.hostile.guest", attacker)
        worker = process("tests.hostile.bystander", plan | {"seconds": 60 * MINUTES})
        looks, _ = await asyncio.gather(moves_on(client, until), attack_inside(eve, theirs, until))
        attacked = await asyncio.to_thread(told, worker)
        phases = await asyncio.to_thread(told, attacking)
        lost = [socket.close_reason or socket.close_code for socket in open_sockets if socket.close_code]
        end = (client.is_closed, client.state)
    report(quiet, attacked, phases)
    print(f"the robot moved at each of {looks} looks; memory: {stack.memory()}")
    assert (lost, end) == ([], (False, "application_running"))
    assert {sample[3] // 100 for sample in attacked} == {2}
    assert stack.restarts() == before
    assert p95(attacked) <= MOST_TIMES * p95(quiet)


def report(quiet, attacked, phases):
    """Prints the requests by kind, by the attack at that time, and the answers to the attackers."""
    kinds = list(dict.fromkeys(sample[0] for sample in quiet))
    table("kind", [(k, [s for s in quiet if s[0] == k], [s for s in attacked if s[0] == k]) for k in kinds])
    names = list(dict.fromkeys(kind for kind, _, _ in phases))
    table("beside", [(n, quiet, [s for s in attacked if phase_of(s, phases) == n]) for n in names])
    table("all", [("all", quiet, attacked)])
    for kind, _, answers in phases:
        print(f"  {kind}: {answers}")
