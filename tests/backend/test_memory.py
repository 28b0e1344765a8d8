"""The web process stays small while clients ask for much and read nothing, or send what is large to read."""

from __future__ import annotations

import io
import json
import socket
import struct
import zipfile
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import psutil
import pytest
import requests

from tests.backend.migrated import SQLITE, add_sqlite
from tests.backend.programs import sign_in
from tests.backend.serving import TIMEOUT_S, serving
from tests.benchmarks.load import settings_of
from tests.hostile.wire import guest_cookie

MOST_MORE = 400 << 20
CONNECTIONS = 16
FILES, SIZE = 360, 250_000
"""90 MB of Python, in files that come with an opened project."""
ASSETS, ASSET = 10, 10_000_000
"""100 MB that a robot needs, and that the translator only passes on."""
MOST_BUNDLED, MOST_OF_WORKER = 64 << 20, 160 << 20
COPIES = 30
NAMES = 3_000_000
pytestmark = [pytest.mark.timeout(900)]


class Team:
    """A server with accounts, and one user of it."""

    def __init__(self, served, cookie, *others):
        self.served, self.pid, self.others = served, served.process.pid, others
        self.user = {"Cookie": cookie, "Origin": served.base}

    def call(self, method, path, body=None, *, expect=(200, 201), **options):
        options = {"json": body, "headers": self.user} | options
        address = f"{self.served.base}/api/v1/{path}"
        answer = requests.request(method, address, timeout=TIMEOUT_S, **options)
        assert answer.status_code in expect, answer.text[:500]
        return answer.json() if "json" in answer.headers.get("Content-Type", "") else answer.content

    def unread(self, cookie, paths):
        """Connections that ask for these paths, and whose answers nobody reads."""
        place = urlsplit(self.served.base)
        made = []
        for path in paths:
            one = socket.create_connection((place.hostname, place.port))
            one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            head = f"GET /api/v1/{path} HTTP/1.1\r\nHost: {place.netloc}\r\nCookie: {cookie}\r\n\r\n"
            one.sendall(head.encode())
            made.append(one)
        return made

    def memory(self, name):
        return memory_of(self.pid, name)

    def more(self, attack):
        """The bytes that the process took at most during the attack, beyond those just before."""
        rest = self.memory("VmRSS:")
        Path(f"/proc/{self.pid}/clear_refs").write_text("5")  # the peak begins here
        attack()
        return self.memory("VmHWM:") - rest


def memory_of(pid, name):
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return next(1024 * int(line.split()[1]) for line in lines if line.startswith(name))


def peak_of(pid):
    return memory_of(pid, "VmHWM:")


def begun(connections):
    """The first bytes of the answers, once each has begun."""
    found = []
    for one in connections:
        one.settimeout(TIMEOUT_S)
        found.append(one.recv(12).decode("latin-1"))
    return [head.partition(" ")[2] for head in found]


@pytest.fixture(scope="module")
def team(tmp_path_factory):
    folder = tmp_path_factory.mktemp("team")
    add_sqlite(folder)
    settings, port = settings_of(
        {
            "BT_STUDIO_DATABASE_URL": f"sqlite:///{folder / SQLITE}",
            "BT_STUDIO_WORK_DEADLINE_S": str(TIMEOUT_S),  # a slow machine refuses nothing
        }
    )
    with ExitStack() as stack:
        cookies = [cookie for _, cookie in sign_in(folder, settings, 1 + CONNECTIONS)]
        served = stack.enter_context(serving(folder, "--port", str(port), is_migrated=False, **settings))
        yield Team(served, *cookies)


def test_the_offers_of_large_projects_take_little(team):
    one = team.call("POST", "projects", {"name": "Offers"})["id"]
    tree = {"id": "T", "root": "r", "nodes": {"r": {"type": "m"}}, "attributes": {"_bts_offered": "1"}}
    files: list[Any] = [
        {"path": f"actions/m{n}.py", "base_revision": 0, "content": f"# {n}\n" * 3_000_000} for n in range(2)
    ]
    files.append({"path": "trees/T.json", "base_revision": 0, "content": json.dumps(tree)})
    team.call("POST", f"projects/{one}/changes", {"files": files})
    for _ in range(COPIES):
        team.call("POST", f"projects/{one}/duplicate", {})

    def attack():
        found = team.call("GET", "projects/offers?limit=50")["items"]
        assert len(found) == COPIES + 1

    assert team.more(attack) <= MOST_MORE


def million_names():
    """A zip whose directory has three million entries."""
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as made:
        made.writestr("a", "")
    raw = data.getvalue()
    entry = raw[raw.index(b"PK\1\2") : raw.index(b"PK\5\6")]
    directory = entry * NAMES
    record = struct.pack("<4sQ2H2L4Q", b"PK\6\6", 44, 45, 45, 0, 0, NAMES, NAMES, len(directory), 0)
    locator = struct.pack("<4sLQL", b"PK\6\7", 0, len(directory), 1)
    return directory + record + locator + struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 1, 1, 0, 0, 0)


def test_an_archive_of_three_million_names_is_refused(team):
    archive = million_names()

    def attack():
        answer = team.call(
            "POST",
            "projects/import?filename=a.zip",
            expect=(413,),
            data=archive,
            json=None,
            headers=team.user | {"Content-Type": "application/octet-stream"},
        )
        assert "directory is larger than 4 MB" in answer["detail"]

    assert team.more(attack) <= MOST_MORE


@pytest.fixture(scope="module")
def full(team):
    """A project that runs, with 100 MB of assets."""
    one = team.call("POST", "projects", {"name": "Full", "template": "laser_bump_and_go"})["id"]
    for start in range(0, ASSETS, 5):
        files = [
            {"path": f"assets/{n}.obj", "base_revision": 0, "content": f"# {n}\n" * (ASSET // 5)}
            for n in range(start, start + 5)
        ]
        team.call("POST", f"projects/{one}/changes", {"files": files})
    opened = team.call("GET", f"projects/{one}")
    settings = opened["settings"] | {"maintainer": {"name": "Ada", "email": "ada@example.org"}}
    team.call("PATCH", f"projects/{one}", {"base_revision": opened["revision"], "settings": settings})
    return one


BUNDLES = (
    "projects/{one}/app",
    "projects/{one}/package",
    "projects/{one}/package?dockerized=true",
    "projects/{one}/package/preview",
    "projects/{one}/cpp",
    "projects/{one}/export",
    "../../tree_api/generate_app?project_name=Full",
    "../../tree_api/get_dockerized_app?project_name=Full",
)


def test_what_a_full_project_is_exported_as_is_never_in_memory(team, full):
    """Neither in the web process nor in a worker. Pages of the database's file are not the server's."""
    rest = highest = memory_of(team.pid, "RssAnon:")
    for path in BUNDLES:
        address = f"{team.served.base}/api/v1/{path.format(one=full)}"
        with ThreadPoolExecutor() as threads, requests.Session() as session:
            asked = threads.submit(session.get, address, headers=team.user, timeout=TIMEOUT_S, stream=True)
            while not asked.done():  # it is answered when all is packed
                highest = max(highest, memory_of(team.pid, "RssAnon:"))
            answer = asked.result()
            assert answer.status_code == 200, (path, answer.text[:500])
            for _ in answer.iter_content(1 << 20):
                highest = max(highest, memory_of(team.pid, "RssAnon:"))
    assert highest - rest <= MOST_BUNDLED
    workers = psutil.Process(team.pid).children(recursive=True)
    assert max(peak_of(worker.pid) for worker in workers) <= MOST_OF_WORKER


@pytest.fixture(scope="module")
def large(team):
    """A project with 90 MB of Python in two revisions, and the cookie of a guest who may read it."""
    one, base = team.call("POST", "projects", {"name": "Large"})["id"], 0
    for revision in range(2):
        for start in range(0, FILES, 120):
            files = [
                {
                    "path": f"imports/m{n}.py",
                    "base_revision": base,
                    "content": f"# {n} {revision}\n" + "x = 1\n" * (SIZE // 6),
                }
                for n in range(start, start + 120)
            ]
            last = team.call("POST", f"projects/{one}/changes", {"files": files})["revision"]
        base = last
    link = team.call("POST", f"projects/{one}/shares/links", {})["links"][0]["url"]
    return one, guest_cookie(link)


def answered_together(team, ask):
    """The statuses of as many requests at once as there are connections."""
    with ThreadPoolExecutor(CONNECTIONS) as threads:
        return set(threads.map(lambda _: ask().status_code, range(CONNECTIONS)))


def test_copies_of_a_large_project_that_are_made_at_once_take_little(team, large):
    """Also an older state that is restored: the contents are stored already."""
    one, _ = large
    address = f"{team.served.base}/api/v1/projects/{one}"

    def attack(path, body):
        def ask():
            return requests.post(f"{address}/{path}", json=body, headers=team.user, timeout=TIMEOUT_S)

        assert answered_together(team, ask) <= {200, 201, 429, 503}

    assert team.more(lambda: attack("duplicate", {})) <= MOST_MORE
    assert team.more(lambda: attack("revisions/1/restore", {})) <= MOST_MORE


def zip_of_90_mb(manifest):
    """A project in a zip. With a manifest it is one of BT Studio; without, the translator opens it."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        tree = '<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>'
        archive.writestr("T.xml", f'<root BTCPP_format="4">{tree}</root>')
        for n in range(FILES):
            archive.writestr(f"imports/m{n}.py", f"# {n}\n" + "x = 1\n" * (SIZE // 6))
        if manifest:
            archive.writestr("project.json", "{}")
    return made.getvalue()


@pytest.mark.parametrize("is_ours", [True, False])
def test_zips_of_large_projects_that_are_imported_at_once_take_little(team, is_ours):
    """Of many users: one user's uploads come one after the other."""
    data = zip_of_90_mb(is_ours)
    cookies = iter(team.others)

    def ask():
        headers = team.user | {"Cookie": next(cookies), "Content-Type": "application/octet-stream"}
        address = f"{team.served.base}/api/v1/projects/import?filename=a.zip"
        return requests.post(address, data=data, headers=headers, timeout=TIMEOUT_S)

    def attack():
        statuses = answered_together(team, ask)
        assert 201 in statuses
        assert statuses <= {201, 429, 503}

    assert team.more(attack) <= MOST_MORE


KINDS = {
    "opened": "projects/{one}",
    "diff": "projects/{one}/revisions/7/diff?against=1",
    "export": "projects/{one}/export",
    "xml": "projects/{one}/xml",
    "revisions": "projects/{one}/revisions",
}


@pytest.mark.parametrize("kind", KINDS)
def test_answers_that_a_guest_does_not_read_take_little(team, large, kind):
    one, guest = large
    team.call("GET", f"projects/{one}")

    def attack():
        with ExitStack() as stack:
            made = team.unread(guest, [KINDS[kind].format(one=one)] * CONNECTIONS)
            for each in made:
                stack.enter_context(each)
            statuses = begun(made)
            # 422: the translation took too long beside the others.
            assert set(statuses) <= {"200", "503", "413", "422"}

    assert team.more(attack) <= MOST_MORE
