"""Attacks by a guest with a read-only link through the web, all together or one kind at a time.

`python -m tests.hostile.guest` takes a plan as JSON on stdin and prints the answers as JSON. It makes itself
*nice*, so that on one machine only the requests slow the server down, not the client.
"""

from __future__ import annotations

import asyncio
import functools
import io
import json
import os
import posixpath
import random
import sys
import time
import urllib.parse
import zipfile
from collections import Counter
from typing import TYPE_CHECKING, Any

from tests.hostile.wire import Site, ask, chunk, connected, frame, status_of, websocket

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Awaitable, Callable

NICEST = 19
CHANCE = random.Random(15)  # noqa: S311 - it spreads what is tried
MEBIBYTE = 1 << 20
DRIP_S = 1.0
DRIPS = 8
HELD = 20
"""Sockets that each of those holds who open many."""
JSON = "application/json"
HEAVY = (
    "xml",
    "xml?self_contained=true",
    "package",
    "package/preview",
    "cpp",
    "models",
    "xsd",
    "app",
    "export",
    "",
    "revisions/1/diff",
)


@functools.cache
def bomb() -> bytes:
    """Returns a zip of some 300 KB that unpacks to 300 MB."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("project.json", '{"format": "bt-studio/project", "version": 1, "name": "Bomb"}')
        for number in range(300):
            packed.writestr(f"assets/{number}.bin", bytes(MEBIBYTE))
    return stream.getvalue()


DEEP = {
    "array": b'{"diagram": ' + b"[" * 200_000 + b"]" * 200_000 + b"}",
    "object": b'{"diagram": ' + b'{"a":' * 100_000 + b"1" + b"}" * 100_000 + b"}",
    "number": b'{"diagram": ' + b"9" * 500_000 + b"}",
}


async def heavy(site: Site, note: Counter[str]) -> None:
    path = CHANCE.choice(HEAVY)
    note[await ask(site, "GET", f"/api/v1/projects/{site.project}/{path}".rstrip("/"))] += 1


async def cheap(site: Site, note: Counter[str]) -> None:
    """Sends requests that cost the client little, on a persistent connection."""
    paths = ("me", "catalog/nodes", f"projects/{site.project}/revisions", "catalog/universes", "nothing")
    async with connected(site) as (reader, writer):
        for _ in range(25):
            path = f"/api/v1/{CHANCE.choice(paths)}"
            writer.write(site.head("GET", path, {"Connection": "keep-alive"}))
            note[await _kept_alive(reader)] += 1


async def _kept_alive(reader: asyncio.StreamReader) -> str:
    head = (await reader.readuntil(b"\r\n\r\n")).decode("latin-1").lower()
    length = head.partition("content-length: ")[2].partition("\r\n")[0]
    if length:
        await reader.readexactly(int(length))
    else:
        while size := int(await reader.readline(), 16):
            await reader.readexactly(size + 2)
        await reader.readline()
    return head.split()[1]


async def forged(site: Site, note: Counter[str]) -> None:
    """Sends forged client addresses and host names."""
    address = ".".join(str(CHANCE.randrange(256)) for _ in range(4))
    lies: Any = {"X_Forwarded_For": address, "X_Real_IP": address, "Forwarded": f"for={address}"}
    more: Any = CHANCE.choice(
        (
            {"Host": "evil.example"},
            {"Origin": "https://evil.example"},
            {"Origin": "null"},
            {"Host": f"{'a' * 300}.example"},
            {"X_Forwarded_Host": "evil.example", "X_Forwarded_Proto": "https"},
            {"Cookie": f"sessionid={CHANCE.getrandbits(160):x}"},
        )
    )
    paths = ("me", f"projects/{site.project}/xml", "projects", "../../metrics", "../../health/ready")
    path = posixpath.normpath(f"/api/v1/{CHANCE.choice(paths)}")
    note[await ask(site, CHANCE.choice(("GET", "POST")), path, **lies, **more)] += 1


async def passwords(site: Site, note: Counter[str]) -> None:
    """Guesses passwords with the page's own form."""
    async with connected(site) as (reader, writer):
        writer.write(site.head("GET", "/accounts/login/", {"Cookie": "a=b"}))
        page = (await reader.read()).decode("latin-1")
    token = page.partition('name="csrfmiddlewaretoken" value="')[2].partition('"')[0]
    cookies = [
        line.partition(": ")[2].partition(";")[0]
        for line in page.split("\r\n")
        if line.lower().startswith("set-cookie")
    ]
    name = site.account if CHANCE.random() < 0.5 else f"user{CHANCE.randrange(1000)}"
    form = {"login": name, "password": f"wrong {CHANCE.random()}", "csrfmiddlewaretoken": token}
    body = urllib.parse.urlencode(form).encode()
    kind = "application/x-www-form-urlencoded"
    referer = f"{site.origin}/accounts/login/"
    lies: Any = {"X_Forwarded_For": f"10.0.{CHANCE.randrange(256)}.{CHANCE.randrange(256)}"}
    note[
        await ask(
            site,
            "POST",
            "/accounts/login/",
            body,
            Content_Type=kind,
            Cookie="; ".join(cookies),
            Referer=referer,
            **lies,
        )
    ] += 1


async def bodies(site: Site, note: Counter[str]) -> None:
    """Sends bodies above the limit: with a length, without one, and with a wrong one."""

    async def endless(wrap: Callable[[bytes], bytes]) -> AsyncIterator[bytes]:
        for _ in range(1500 * 4):
            yield wrap(bytes(MEBIBYTE // 4))

    path = CHANCE.choice(("trees/diagram", "trees/xml", "projects", "projects/import"))
    kind = "application/octet-stream" if path.endswith("import") else JSON
    way = CHANCE.randrange(4)
    if way == 0:
        length = {"Content_Length": str(1500 * MEBIBYTE)}
        answer = ask(site, "POST", f"/api/v1/{path}", endless(bytes), Content_Type=kind, **length)
    elif way == 1:
        chunks = {"Transfer_Encoding": "chunked"}
        answer = ask(site, "POST", f"/api/v1/{path}", endless(chunk), Content_Type=kind, **chunks)
    elif way == 2:
        seven = b'{"diagram": "' + b"x" * (7 * MEBIBYTE) + b'"}'
        answer = ask(site, "POST", "/api/v1/trees/diagram", seven, Content_Type=JSON)
    else:
        answer = ask(site, "POST", f"/api/v1/{path}", b"x" * 4096, Content_Type=kind, Content_Length="5")
    note[await answer] += 1


async def slow(site: Site, note: Counter[str]) -> None:
    """Sends a head or a body byte by byte."""
    async with connected(site) as (reader, writer):
        head = site.head("POST", "/api/v1/trees/diagram", {"Content-Length": "900000", "Content-Type": JSON})
        if CHANCE.random() < 0.5:
            writer.write(head)
        else:
            writer.write(head[:-4] + b"\r\nX-Slow: ")
        answer = asyncio.ensure_future(status_of(reader))
        try:
            for _ in range(DRIPS):
                await asyncio.wait((answer,), timeout=DRIP_S)
                if answer.done():
                    break
                writer.write(b"x")
            note[answer.result() if answer.done() else "left"] += 1
        finally:
            answer.cancel()
            await asyncio.gather(answer, return_exceptions=True)


async def junk(site: Site, note: Counter[str]) -> None:
    """Sends bytes that are no request, or a head that is too large."""
    what = (
        b"\x16\x03\x01" + os.urandom(500),
        b"GET / HTTP/9.9\r\n\r\n",
        b"GET /" + b"a" * 200_000 + b" HTTP/1.1\r\n\r\n",
        b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 50_000,
        site.head("GET", "/api/v1/me", {"Content-Length": "-1"}),
        site.head("POST", "/api/v1/me", {"Content-Length": "5", "Transfer-Encoding": "chunked"})
        + b"0\r\n\r\n",
        b"\r\n" * 100_000,
    )
    async with connected(site) as (reader, writer):
        writer.write(CHANCE.choice(what))
        note[await status_of(reader)] += 1


async def zips(site: Site, note: Counter[str]) -> None:
    """Sends a small archive that is large inside; the hostile user's own account may at least upload it."""
    kind, path = "application/octet-stream", "/api/v1/projects/import?filename=Bomb.zip"
    cookie = CHANCE.choice([cookie for cookie in (site.guest, site.user) if cookie])
    note[await ask(site, "POST", path, bomb(), Content_Type=kind, Cookie=cookie)] += 1


async def deep(site: Site, note: Counter[str]) -> None:
    path = CHANCE.choice(("trees/diagram", "trees/xml", f"projects/{site.project}/check", "projects"))
    cookie = CHANCE.choice([cookie for cookie in (site.guest, site.user) if cookie])
    body = DEEP[CHANCE.choice(list(DEEP))]
    note[await ask(site, "POST", f"/api/v1/{path}", body, Content_Type=JSON, Cookie=cookie)] += 1


async def sockets(site: Site, note: Counter[str]) -> None:
    """Holds many sockets for a while, and reads nothing."""
    held = []
    try:
        for _ in range(HELD):
            entered = websocket(site, f"/ws/projects/{site.project}/notices")
            status, _ = await entered.__aenter__()
            held.append(entered)
            note[status] += 1
        await asyncio.sleep(DRIP_S)  # the attack is to hold them for so long
    finally:
        for entered in held:
            await entered.__aexit__(None, None, None)


async def frames(site: Site, note: Counter[str]) -> None:
    """Sends frames as fast as the server takes them: small ones, large ones, and an endless one."""
    path = CHANCE.choice(("notices", "notices", "notices", "language"))
    async with websocket(site, f"/ws/projects/{site.project}/{path}") as (status, (reader, writer)):
        reading = asyncio.ensure_future(_thrown_away(reader))
        way = CHANCE.randrange(4)
        try:
            for number in range(400):
                if reading.done():
                    break
                if way == 0:
                    writer.write(frame(b"x") * 2000)
                elif way == 1:
                    writer.write(frame(b"ping", opcode=9) * 1000)
                elif way == 2:
                    writer.write(frame(bytes(MEBIBYTE // 4)))
                else:
                    writer.write(frame(bytes(MEBIBYTE // 4), opcode=1 if not number else 0, is_last=False))
                draining = asyncio.ensure_future(writer.drain())
                await asyncio.wait((draining, reading), return_when=asyncio.FIRST_COMPLETED)
                draining.cancel()
                if isinstance((await asyncio.gather(draining, return_exceptions=True))[0], OSError):
                    break
            await asyncio.wait((reading,), timeout=DRIP_S)
            note[f"{status} {'closed' if reading.done() else 'taken'}"] += 1
        finally:
            reading.cancel()
            await asyncio.gather(reading, return_exceptions=True)


async def _thrown_away(reader: asyncio.StreamReader) -> None:
    while await reader.read(1 << 16):
        pass


KINDS: dict[str, tuple[Callable[[Site, Counter[str]], Awaitable[None]], int]] = {
    "heavy": (heavy, 8),
    "cheap": (cheap, 16),
    "forged": (forged, 16),
    "passwords": (passwords, 8),
    "bodies": (bodies, 6),
    "slow": (slow, 100),
    "junk": (junk, 8),
    "zips": (zips, 4),
    "deep": (deep, 8),
    "sockets": (sockets, 15),
    "frames": (frames, 12),
}
"""The attacks, and the number of clients of each."""


async def tried(kind: str, site: Site, note: Counter[str], goes_on: Callable[[int], bool]) -> None:
    """Runs all clients of one kind until the time is over."""
    once, many = KINDS[kind]

    async def again_and_again() -> None:
        rounds = 0
        while goes_on(rounds):
            rounds += 1
            try:
                await once(site, note)
            except (OSError, EOFError, TimeoutError, asyncio.LimitOverrunError) as error:
                note[type(error).__name__] += 1
                await asyncio.sleep(0)

    await asyncio.gather(*(again_and_again() for _ in range(many)))


async def all_at_once(site: Site, rounds: int) -> dict[str, Counter[str]]:
    """Runs every kind at the same time, each with its number of clients."""
    notes: dict[Any, Any] = {kind: Counter() for kind in KINDS}
    await asyncio.gather(*(tried(kind, site, notes[kind], lambda done: done < rounds) for kind in KINDS))
    return notes


def before(until: float) -> Callable[[object], bool]:
    """Whether there is time left."""
    return lambda _: time.time() < until


async def in_phases(site: Site, seconds: float, phase_s: float) -> list[tuple[str, float, dict[str, int]]]:
    """Runs one kind after another with full force, and all together after each round."""
    told: list[tuple[str, float, dict[str, int]]] = []
    end = time.time() + seconds
    while time.time() < end:
        for kinds in (*([kind] for kind in KINDS), list(KINDS)):
            began, until = time.time(), min(end, time.time() + phase_s)
            note: Counter[str] = Counter()
            going = (tried(kind, site, note, before(until)) for kind in kinds)
            await asyncio.gather(*going)
            told.append((kinds[0] if len(kinds) == 1 else "all", began, dict(note)))
            if time.time() >= end:
                break
    return told


def main() -> None:
    os.nice(NICEST)
    plan = json.load(sys.stdin)
    os.sched_setaffinity(0, set(plan.get("cores") or os.sched_getaffinity(0)))
    told = asyncio.run(in_phases(Site(**plan["site"]), plan["seconds"], plan["phase_s"]))
    json.dump(told, sys.stdout)


if __name__ == "__main__":
    main()
