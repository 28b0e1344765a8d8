"""The volumes of a team's server of the previous release, as data that a test restores.

`release_0_1/` holds that release's compose file, its database as text, and its other volumes as archives.
They were made by running that release and using it:

    git checkout RELEASE && docker/images.sh old && python -m tests.docker.old_release old
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from tests.docker.engine import engine
from tests.docker.stack import Stack, User

if TYPE_CHECKING:
    from collections.abc import Mapping

FOLDER = Path(__file__).parent / "release_0_1"
DUMP = FOLDER / "database.sql"
ARCHIVED = ("studio", "keeper", "gate")
SETTINGS = {
    "BT_STUDIO_SECRET_KEY": "0123456789abcdef0123456789abcdef0123456789abcdef",
    "BT_STUDIO_DATABASE_PASSWORD": "oldpassword",
    "BT_STUDIO_MAX_SESSIONS": "3",
    "BT_STUDIO_REGISTRATION": "open",
    "BT_STUDIO_PROXY_HOPS": "0",
}
"""Lines of that server's `.env`."""
ADMIN = ("ada", "correct horse battery")
USER = ("ann", "staple of the old days")
PROJECT = "Bump since last year"
NOTE = ("assets/note.txt", "written before the upgrade")


class OldStack(Stack):
    """The stack of that release."""

    files = (FOLDER / "compose.yaml",)


def lines(values: Mapping[str, str]) -> str:
    """Returns the text of an `.env`."""
    return "".join(f"{name}={value}\n" for name, value in values.items())


def _archive(stack: Stack, volume: str) -> bytes:
    command = [stack.engine.docker, "run", "--rm", "-v", f"{stack.name}_{volume}:/volume:ro"]
    command += ["debian:bookworm-slim", "tar", "-C", "/volume", "-cz", "."]
    return subprocess.run(command, env=stack.engine.environment, check=True, stdout=subprocess.PIPE).stdout


def _put(stack: Stack, volume: str) -> None:
    command = [stack.engine.docker, "run", "--rm", "-i", "-v", f"{stack.name}_{volume}:/volume"]
    command += ["debian:bookworm-slim", "tar", "-C", "/volume", "-xz", "--numeric-owner"]
    given = (FOLDER / f"{volume}.tar.gz").read_bytes()
    subprocess.run(command, env=stack.engine.environment, check=True, input=given)


def leave_behind(stack: OldStack) -> None:
    """Creates the volumes of that release, with its compose file and its stopped database."""
    stack.compose("up", "-d", "--no-deps", "postgres")
    stack.await_healthy("postgres")
    load = ("exec", "-T", "postgres", "psql", "-q", "-v", "ON_ERROR_STOP=1", "-U", "studio", "-d", "studio")
    stack.compose(*load, input=DUMP.read_text())
    for volume in ARCHIVED:
        # With Compose's labels, so that it recognizes them.
        labels = ["--label", f"com.docker.compose.project={stack.name}"]
        labels += ["--label", f"com.docker.compose.volume={volume}"]
        stack.engine.run("volume", "create", *labels, f"{stack.name}_{volume}")
        _put(stack, volume)
    stack.compose("stop")


def _use(stack: OldStack) -> None:
    """Uses that server as people do."""
    for (name, password), kind in ((ADMIN, ()), (USER, ("--user",))):
        stack.studio("admin", "create", name, *kind, "--password-stdin", input=password + "\n")
    admin, user = User(stack, *ADMIN), User(stack, *USER)
    admin.post("groups", {"name": "Class of the old days"})
    project = user.post("projects", {"name": PROJECT, "template": "laser_bump_and_go"})["id"]
    path, content = NOTE
    change = {"files": [{"path": path, "content": content, "base_revision": 0}]}
    user.post(f"projects/{project}/changes", change)


def main(tag: str) -> None:
    """Runs that release and stores its volumes."""
    with tempfile.TemporaryDirectory() as folder, engine(Path(folder)) as running:
        stack = OldStack(running, Path(folder), tag, **SETTINGS)
        try:
            stack.up()
            _use(stack)
            stack.compose("stop", "-t", "10", "web", "keeper")
            dump = stack.compose("exec", "-T", "postgres", "pg_dump", "-U", "studio", "--no-owner", "studio")
            DUMP.write_text(dump.stdout)
            for volume in ARCHIVED:
                (FOLDER / f"{volume}.tar.gz").write_bytes(_archive(stack, volume))
        finally:
            stack.down()


if __name__ == "__main__":
    main(sys.argv[1])
