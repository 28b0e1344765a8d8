"""Saves of Python files by eight clients at the same time; every answer is checked.

`python -m tests.benchmarks.saves [--saves 100000] [--clients 8] [--workers N]`. The server is one for a
team, with PostgreSQL and Redis. Half of the clients have a project of their own, the others share one. Each
file is of a different shape each time, and some are broken on purpose: these are saved like all others, and
a finding says what is wrong. A save is answered with the next revision, or with a conflict where, now and
then, its base was made stale on purpose; all else is a false answer. In the end all files are read back.
"""

from __future__ import annotations

import argparse
import asyncio
import random
import sys
import tempfile
import time
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from tests.backend.serving import serving
from tests.benchmarks.editors import Editor, Measured
from tests.benchmarks.figures import Figure, show
from tests.benchmarks.load import sign_in, team

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

FILES = 10
"""Action files of each client."""
STALE = 0.05
BROKEN = 0.1
SHOWN = 20
HEAD = "from py_trees.behaviour import Behaviour\nfrom py_trees.common import Status\n"
BODIES = (
    "        return Status.SUCCESS\n",
    "        match {n}:\n            case {n} | 1 if True:\n                return Status.RUNNING\n"
    "        return Status.FAILURE\n",
    "        found = [x for x in range({n}) if (y := x % 3) and not y == 2]\n"
    "        return Status.SUCCESS if found else Status.FAILURE\n",
    "        try:\n            text = f\"{{'ä' * {n}!r:>{{10}}}}\"\n        except* ValueError as error:\n"
    "            raise RuntimeError(str(error)) from None\n        else:\n            print(text)\n"
    "        return Status.RUNNING\n",
    "        with open('/dev/null') as a, open('/dev/null') as b:\n            a.read({n}), b.read()\n"
    "        return (lambda *, s=Status.SUCCESS: s)()\n",
    "        " + "(" * 60 + "{n}" + ")" * 60 + "\n        return Status.SUCCESS\n",
    "        value = " + " + ".join(["{n}"] * 150) + "\n        return Status.SUCCESS if value else None\n",
    "        async def later(n: int = {n}) -> None:\n            async for _ in aiter(()):\n"
    "                await n\n"
    "        return Status.SUCCESS\n",
)
DAMAGES = (
    "        return (\n",
    "        retrun Status.SUCCESS\n",
    "      return Status.SUCCESS\n",
    "        x = " + "(" * 300 + ")" * 300 + "\n",
    "        '''never ends\n",
    "        f'{'\n",
)


def source(name: str, number: int, chance: random.Random) -> tuple[str, bool]:
    """Returns an action that was never saved before, and whether it is valid Python."""
    is_whole = chance.random() >= BROKEN
    body = chance.choice(BODIES).replace("{n}", str(number)).replace("{{", "{").replace("}}", "}")
    damage = "" if is_whole else chance.choice(DAMAGES)
    decorations = "@(lambda c: c)\n" if chance.random() < 0.2 else ""
    head = f'{HEAD}\n{decorations}class {name}(Behaviour):\n    """Number {number}."""\n\n'
    return f"{head}    def update(self) -> Status:\n{damage}{body}", is_whole


@dataclass
class Answers:
    """Counts of the answers, and of all unexpected ones."""

    saved: int = 0
    conflicts: int = 0
    unread: int = 0
    seconds: float = 0.0
    false: list[str] = field(default_factory=list)

    def lie(self, *what: object) -> None:
        """Records a wrong answer."""
        self.false.append(" ".join(map(str, what))[:400])


class Saver(Editor):
    """A client with its own files in one project."""

    def __init__(self, number: int, port: int, who: tuple[str, str], answers: Answers, *, seed: int) -> None:
        super().__init__(number, port, who, Measured())
        self._prefix = f"Client{number}Action"
        self._chance = random.Random(seed + number)  # noqa: S311 - it chooses what is saved
        self._answers = answers
        self._stored: dict[str, tuple[int, str]] = {}
        self._saves = 0

    @property
    def project(self) -> str:
        """The id of its project."""
        return str(self._project["id"])

    async def join(self, other: Saver, name: str) -> None:
        """Joins the project of another client, whose owner gives `name` access."""
        await self._connect()
        await other.asked(
            "share", "POST", f"projects/{other.project}/shares", {"name": name, "role": "editor"}
        )
        self._project = {"id": other.project}

    async def save_next(self) -> None:
        """Saves one file, with a base that is either correct or intentionally stale."""
        self._saves += 1
        name = f"{self._prefix}{self._saves % FILES}"
        path = f"actions/{name}.py"
        text, is_whole = source(name, self._saves, self._chance)
        base = self._stored.get(path, (0, ""))[0]
        stale = self._chance.randrange(base) if base and self._chance.random() < STALE else None
        status, answer = await self._posted(path, text, base if stale is None else stale)
        if stale is not None:
            self._judge_conflict(path, status, answer)
        elif status == 200:
            self._judge_saved(path, text, is_whole, base, answer)
        else:
            self._answers.lie("a save was refused:", path, status, answer)

    async def _posted(self, path: str, text: str, base: int) -> tuple[int, dict[str, Any]]:
        change = {"path": path, "content": text, "base_revision": base}
        return await self.asked("save", "POST", f"projects/{self.project}/changes", {"files": [change]})

    def _judge_conflict(self, path: str, status: int, answer: dict[str, Any]) -> None:
        self._answers.conflicts += 1
        revision, text = self._stored[path]
        theirs = [one["theirs"] for one in answer.get("conflicts", [])]
        if status != 409 or [(one["revision"], one["content"]) for one in theirs] != [(revision, text)]:
            self._answers.lie("a stale base was answered:", path, status, answer)

    def _judge_saved(self, path: str, text: str, is_whole: bool, base: int, answer: dict[str, Any]) -> None:
        self._answers.saved += 1
        if answer["revision"] <= base:
            self._answers.lie("the revision did not grow:", path, base, answer["revision"])
        self._stored[path] = (answer["revision"], text)
        if not answer["checked"]:
            self._answers.lie("it was not checked:", path, answer["diagnostics"])
            return
        errors = [found for found in answer["diagnostics"] if found["severity"] == "error"]
        named = [found for found in errors if found.get("file") == path]
        if bool(named) == is_whole:
            self._answers.lie("whole" if is_whole else "broken", "but:", path, errors[:2])

    async def read_back(self) -> None:
        """Compares all files on the server with the last saved ones."""
        _, opened = await self.asked("open", "GET", f"projects/{self.project}")
        found = {file["path"]: (file["revision"], file["content"]) for file in opened["files"]}
        for path, stored in self._stored.items():
            if found.get(path) != stored:
                self._answers.lie("read back:", path, (found.get(path) or [None])[0], "instead of", stored[0])


async def storm(port: int, people: list[tuple[str, str]], saves: int, *, seed: int = 1) -> Answers:
    """Makes this many saves, with one client for each account `editor…`."""
    answers = Answers()
    clients = [Saver(number, port, who, answers, seed=seed) for number, who in enumerate(people)]
    half = (len(clients) + 1) // 2
    for number, client in enumerate(clients):
        await (client.open() if number <= half else client.join(clients[half], f"editor{number}"))
    left = iter(range(saves))

    async def work(client: Saver) -> None:
        for _ in left:
            await client.save_next()

    began = time.monotonic()
    await asyncio.gather(*map(work, clients))
    answers.seconds = time.monotonic() - began
    for client in clients:
        await client.read_back()
        await client.leave()
    return answers


def measure(options: Sequence[str] = ()) -> Iterable[Figure]:
    """Starts a team's server, and saves."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--saves", type=int, default=100_000)
    parser.add_argument("--clients", type=int, default=8)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=0)
    chosen = parser.parse_args(options)
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        settings, port = team(stack, folder, sqlite=False)
        more = ("--workers", str(chosen.workers)) if chosen.workers else ()
        served = stack.enter_context(serving(folder, "--port", str(port), *more, **settings))
        people = sign_in(folder, settings, chosen.clients)
        answers = asyncio.run(storm(served.port, people, chosen.saves, seed=chosen.seed))
    done = answers.saved + answers.conflicts
    yield Figure(f"answers to {chosen.clients} clients", done / answers.seconds, "/s", "higher")
    yield Figure("saved", answers.saved, "", "higher")
    yield Figure("conflicts meant", answers.conflicts, "")
    yield Figure("false answers", len(answers.false), "")
    for lie in answers.false[:SHOWN]:
        print(f"  {lie}")


def main() -> None:
    """Prints the figures."""
    show(measure(sys.argv[1:]))


if __name__ == "__main__":
    main()
