"""After `docker/up.sh` on the volumes of the previous release, the data exist and the projects drive robots.

The old server does not run here: its volumes are restored as it left them (`old_release.py` says how they
were made), under its compose file, by whose names and labels the new one finds them. The new images then
migrate the database.
"""

from __future__ import annotations

import pytest

from tests.docker.engine import build_images, engine
from tests.docker.old_release import ADMIN, NOTE, PROJECT, SETTINGS, USER, OldStack, leave_behind, lines
from tests.docker.stack import User
from tests.docker.team_server import LINK, TeamServer
from tests.docker.test_stack import BUILT, TAG, distance_m, run, started

pytestmark = [pytest.mark.timeout(1800)]


@pytest.fixture
def server(tmp_path):
    """Yields a stopped old server and its `.env`."""
    with engine(tmp_path) as running:
        if not BUILT:
            build_images(running, TAG)
        old = OldStack(running, tmp_path, TAG, **SETTINGS)
        made = TeamServer(running, tmp_path, TAG, old.name)
        try:
            leave_behind(old)
            (tmp_path / ".env").write_text(lines({"BT_STUDIO_PUBLIC_URL": made.base, **SETTINGS}))
            yield made
        finally:
            # Compose does not start with less.
            least = dict.fromkeys(("BT_STUDIO_DOMAIN", "BT_STUDIO_PUBLIC_URL", "BT_STUDIO_DOCKER_GID"), "0")
            (tmp_path / ".env").write_text(lines({**least, **made.settings, **SETTINGS}))
            print(made.compose("logs", "--tail=60", check=False).stdout)
            made.down()
            # The new compose file does not know these.
            left = running.run("volume", "ls", "-q", "--filter", f"name={made.name}_").stdout.split()
            for volume in left:
                running.run("volume", "rm", volume)


async def test_an_upgrade_keeps_everything_and_robots_drive(server):
    before = (server.folder / ".env").read_text()
    said = server.up_sh().stdout
    server.trust()
    # Old lines stay; missing ones are added, and the file is readable by its owner alone.
    after = (server.folder / ".env").read_text()
    assert after.startswith(before)
    assert (server.folder / ".env").stat().st_mode & 0o777 == 0o600
    assert "ada is an administrator." in said
    assert LINK.findall(said) == []

    admin, user = User(server, *ADMIN), User(server, *USER)
    assert [group["name"] for group in admin.get("groups")["items"]] == ["Class of the old days"]
    [project] = user.get("projects")["items"]
    assert project["name"] == PROJECT
    files = {file["path"]: file["content"] for file in user.get(f"projects/{project['id']}")["files"]}
    assert files[NOTE[0]] == NOTE[1]
    settings = server.engine.run("inspect", "-f", "{{.Config.Env}}", server.container("web")).stdout
    assert "BT_STUDIO_REGISTRATION=open" in settings
    # Caddy is in front now, in spite of the old line.
    assert "BT_STUDIO_PROXY_HOPS=1" in settings
    async with started(user, project["id"]) as client:
        await run(client, user, project["id"], "walled_room")
        await client.until(lambda: distance_m(client) > 0.05, 120)


def test_a_database_without_its_password_is_not_touched(server):
    lost = {name: value for name, value in SETTINGS.items() if name != "BT_STUDIO_DATABASE_PASSWORD"}
    (server.folder / ".env").write_text(lines(lost))
    done = server.up_sh(check=False)
    assert done.returncode == 1
    assert f"the volume {server.name}_database holds a database" in done.stderr
    assert "BT_STUDIO_DATABASE_PASSWORD" not in (server.folder / ".env").read_text()
