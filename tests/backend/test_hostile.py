"""A guest with a read-only link attacks a team's server in every way, while another user works."""

from __future__ import annotations

import asyncio
import threading
from contextlib import AsyncExitStack, ExitStack
from pathlib import Path

import psutil
import pytest
import requests
from websockets.asyncio.client import connect
from websockets.protocol import State

from tests.backend.programs import sign_in
from tests.backend.services import redis
from tests.backend.serving import serving
from tests.benchmarks.load import settings_of
from tests.budget import count
from tests.hostile.bystander import Bystander
from tests.hostile.guest import all_at_once
from tests.hostile.projects import large_files
from tests.hostile.wire import Site, guest_cookie

NODES = 20_000
PAGES = 10
MOST_MEMORY = 1 << 30
MOST_THREADS = 64
REFUSED = {"503"}
"""What of 5xx may be answered to those who ask for too much: busy, with when to ask again."""
pytestmark = [pytest.mark.timeout(900)]


@pytest.fixture(scope="module")
def server(tmp_path_factory, warm_postgresql):
    """The server with two accounts, and the cookies of both."""
    folder = tmp_path_factory.mktemp("hostile")
    with ExitStack() as stack:
        services = {
            "BT_STUDIO_DATABASE_URL": stack.enter_context(warm_postgresql.database_url()),
            "BT_STUDIO_REDIS_URL": stack.enter_context(redis()),
        }
        settings, port = settings_of(services)
        served = stack.enter_context(serving(folder, "--port", str(port), **settings))
        yield served, [cookie for _, cookie in sign_in(folder, settings, 2)]


def api(served, cookie, method, path, body=None):
    """One request of somebody who is signed in."""
    headers = {"Cookie": cookie, "Origin": served.base}
    answer = requests.request(method, f"{served.base}/api/v1/{path}", json=body, headers=headers, timeout=120)
    answer.raise_for_status()
    return answer.json()


def attacked_site(served, cookie):
    """A large project of the hostile user, and the cookie of a guest who may read it."""
    made = api(served, cookie, "POST", "projects", {"name": "Large"})
    files = large_files(NODES, made["files"])
    api(served, cookie, "POST", f"projects/{made['id']}/changes", {"files": files})
    link = api(served, cookie, "POST", f"projects/{made['id']}/shares/links", {})["links"][0]["url"]
    place = {"host": "127.0.0.1", "port": served.port, "origin": served.base}
    return Site(guest=guest_cookie(link), user=cookie, project=made["id"], account="editor0", **place)


async def watched(process, attack):
    """Returns the largest number of threads during the attack, and the results of the attack."""
    most, attacking = 0, asyncio.ensure_future(attack)
    while not attacking.done():
        most = max(most, process.num_threads())
        await asyncio.wait((attacking,), timeout=0.2)
    return most, attacking.result()


async def read_all(page):
    """Reads as a browser does; a client that does not read answers no ping, and is disconnected."""
    async for _ in page:
        pass


def peak_bytes(process):
    lines = Path(f"/proc/{process.pid}/status").read_text().splitlines()
    return next(1024 * int(line.split()[1]) for line in lines if line.startswith("VmHWM:"))


async def test_a_hostile_guest_harms_nobody_else(server):
    served, (cookie, hostile) = server
    site = attacked_site(served, hostile)
    project = api(served, cookie, "POST", "projects", {"name": "Bump", "template": "laser_bump_and_go"})["id"]
    worker = Bystander("127.0.0.1", served.port, served.base, cookie, project)
    process, is_over = psutil.Process(served.process.pid), threading.Event()

    def work():
        while not is_over.is_set():
            worker.round()

    uri = f"ws://127.0.0.1:{served.port}/ws/projects/{project}/notices"
    options = {"additional_headers": {"Cookie": cookie}, "origin": served.base, "proxy": None}
    async with AsyncExitStack() as stack:
        pages = [await stack.enter_async_context(connect(uri, **options)) for _ in range(PAGES)]
        reading = [asyncio.ensure_future(read_all(page)) for page in pages]
        working = asyncio.ensure_future(asyncio.to_thread(work))
        try:
            threads, answers = await watched(process, all_at_once(site, count("hostile_guest")))
        finally:
            is_over.set()
            await asyncio.wait((working,))
            worker.close()
        working.result()
        assert all(page.state is State.OPEN for page in pages)
    await asyncio.gather(*reading)
    assert {sample.status // 100 for sample in worker.samples} == {2}
    assert all(note for note in answers.values())
    failed = {
        (kind, status)
        for kind, note in answers.items()
        for status in note
        if status[:1] == "5" and status[:3] not in REFUSED
    }
    assert failed == set()
    assert threads <= MOST_THREADS
    assert peak_bytes(process) < MOST_MEMORY
