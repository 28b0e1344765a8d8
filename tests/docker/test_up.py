"""`docker/up.sh` starts the team's server behind TLS; the death of one of two web servers is not noticed."""

from __future__ import annotations

import asyncio
import http.client
import re
import ssl
import subprocess
import urllib.parse

import pytest

from tests.docker.engine import REPOSITORY, build_images, engine
from tests.docker.stack import User
from tests.docker.team_server import LINK, TeamServer
from tests.docker.test_stack import BUILT, BUMP, TAG, run, save, started, ticks, ticks_on

ADMIN = ("admin", "correct horse battery staple")
METRICS = """
import re, urllib.request
text = urllib.request.urlopen("http://127.0.0.1:8000/metrics", timeout=10).read().decode()
found = re.findall(r'bt_studio_sockets_total{event="(\\w+)"} (\\d+)', text)
count = {kind: int(number) for kind, number in found}
print(count["opened"] - count["ended"])
"""
pytestmark = [pytest.mark.timeout(1800)]


@pytest.fixture(scope="module")
def first_words():
    """Returns the output of the first run of the command."""
    return []


@pytest.fixture(scope="module")
def server(tmp_path_factory, first_words):
    """Starts a server for the first time."""
    folder = tmp_path_factory.mktemp("team")
    with engine(folder) as running:
        if not BUILT:
            build_images(running, TAG)
        made = TeamServer(running, folder, TAG)
        try:
            first_words.append(made.up_sh().stdout)
            made.trust()
            yield made
        finally:
            print(made.compose("logs", "--tail=60", check=False).stdout)
            made.down()


@pytest.fixture(scope="module")
def admin(server, first_words):
    """Returns the administrator, who opened the link and chose a password."""
    [link] = LINK.findall(first_words[0])
    visitor = User.__new__(User)
    visitor.begin(server, {})
    path = urllib.parse.urlsplit(link).path
    page = visitor.open("GET", path).decode()
    form = dict(re.findall(r'<input type="hidden" name="(\w+)" value="([^"]+)"', page))
    form |= {"password1": ADMIN[1], "password2": ADMIN[1]}
    # The link's key is in the session now, and the form's address has none.
    place = re.sub(r"(/key/[^-]+)-.*", r"\1-set-password/", path)
    visitor.open("POST", place, urllib.parse.urlencode(form).encode())
    return User(server, *ADMIN)


@pytest.fixture(scope="module")
def ann(server):
    return server.add_user("ann")


def answer(server, path, *, method="GET", tls=None, headers=None, body=None):
    """Returns status and headers of one request by https."""
    connection = http.client.HTTPSConnection("localhost", server.port, timeout=30, context=tls or server.tls)
    connection.request(method, path, body, headers or {})
    response = connection.getresponse()
    response.read()
    connection.close()
    return response.status, dict(response.getheaders())


def test_the_settings_are_made_for_their_owner_alone(server):
    assert (server.folder / ".env").stat().st_mode & 0o777 == 0o600
    made = server.settings
    assert len(made["BT_STUDIO_SECRET_KEY"]) == 64
    assert len(made["BT_STUDIO_DATABASE_PASSWORD"]) == 48
    assert made["BT_STUDIO_PUBLIC_URL"] == server.base
    assert made["BT_STUDIO_TLS"] == "internal"
    assert made["BT_STUDIO_DOCKER_GID"].isdigit()


def test_the_administrator_comes_in_by_the_link(admin):
    assert admin.get("me")["role"] == "administrator"


def test_the_command_may_be_repeated(server, admin):
    before, containers = (server.folder / ".env").read_bytes(), server.compose("ps", "-q").stdout
    said = server.up_sh().stdout
    assert "admin is an administrator." in said
    assert LINK.findall(said) == []
    assert (server.folder / ".env").read_bytes() == before
    assert server.compose("ps", "-q").stdout == containers
    assert admin.get("me")["user"] == "admin"


def test_only_caddy_is_reached_and_it_has_no_rights(server):
    host = ("PortBindings", "CapDrop", "CapAdd", "ReadonlyRootfs")
    format_ = " ".join(["{{json .HostConfig." + name + "}}" for name in host] + ["{{.Config.User}}"])
    for service in ("web", "keeper", "postgres", "redis", "caddy"):
        ports, *rights = server.engine.run("inspect", "-f", format_, server.container(service)).stdout.split()
        assert (ports not in {"{}", "null"}) == (service == "caddy"), service
    assert rights == ['["ALL"]', "null", "true", "caddy"]
    limits = "{{.HostConfig.Memory}} {{.HostConfig.PidsLimit}} {{.HostConfig.SecurityOpt}} "
    limits += "{{range .HostConfig.Ulimits}}{{.Name}}={{.Hard}}{{end}}"
    assert server.engine.run("inspect", "-f", limits, server.container("caddy")).stdout.split() == [
        str(512 << 20),
        "128",
        "[no-new-privileges:true]",
        "nofile=16384",
    ]


def test_a_browser_that_trusts_the_authority_gets_a_page_and_no_other_does(server):
    status, headers = answer(server, "/accounts/login/")
    assert status == 200
    # It would apply to all of the user's servers on localhost.
    assert "strict-transport-security" not in headers
    with pytest.raises(ssl.SSLCertVerificationError):
        answer(server, "/accounts/login/", tls=ssl.create_default_context())


def test_plain_http_is_sent_on_to_the_public_address(server):
    connection = http.client.HTTPConnection("localhost", server.http_port, timeout=30)
    connection.request("GET", "/projects/1?a=b")
    response = connection.getresponse()
    assert (response.status, response.headers["Location"]) == (308, f"{server.base}/projects/1?a=b")
    connection.close()


@pytest.mark.parametrize(
    "path", ["/metrics", "/metrics/", "//metrics", "/%6detrics", "/x/../metrics", "/METRICS"]
)
def test_metrics_are_not_public(server, path):
    forged = {"X-Forwarded-For": "127.0.0.1", "X-Real-IP": "127.0.0.1"}
    assert answer(server, path)[0] == 404
    assert answer(server, path, headers=forged)[0] == 404


def test_a_body_beyond_the_bound_is_refused_before_all_of_it_is_sent(server, ann):
    size = {"Content-Length": str(65 << 20), "Content-Type": "application/json"}
    head = {"Cookie": ann.cookies, "Origin": server.base, **size}
    # Caddy forwards nothing before a part of the body has arrived.
    status, headers = answer(server, "/api/v1/projects", method="POST", headers=head, body=b" " * (3 << 20))
    assert (status, headers["Content-Type"]) == (413, "application/problem+json")


def test_a_client_cannot_choose_its_address(server, ann):
    server.studio("admin", "create", "liar", "--user", "--password-stdin", input=ADMIN[1] + "\n")
    User(server, "liar", ADMIN[1], {"X-Forwarded-For": "203.0.113.7"})
    query = "SELECT DISTINCT address FROM accounts_auditentry WHERE address IS NOT NULL"
    psql = ("exec", "-T", "postgres", "psql", "-U", "studio", "-At", "-c", query)
    seen = server.compose(*psql).stdout.split()
    # All have the address by which Docker shows this machine: neither Caddy's, nor a forged one.
    format_ = "{{range .NetworkSettings.Networks}}{{.Gateway}}{{end}}"
    assert seen == [server.engine.run("inspect", "-f", format_, server.container("caddy")).stdout.strip()]


async def test_a_dead_web_server_of_two_stops_nobody(server, ann):
    server.compose("up", "-d", "--scale", "web=2")
    for name in server.webs():
        server.await_container(name)
    assert len(server.webs()) == 2
    project = ann.post("projects", {"name": "Bump", "template": BUMP})["id"]
    client = await ann.open_session(ann.post(f"projects/{project}/session"), stream=False)
    try:
        await run(client, ann, project, "walled_room")
        await ticks_on(client)
        [busy] = [name for name in server.webs() if sockets(server, name)]
        before = ticks(client)
        saving = asyncio.create_task(asyncio.to_thread(saves, ann, project, 60))
        await asyncio.to_thread(server.engine.run, "kill", "--signal", "KILL", busy)
        refused, stored = await saving
        await asyncio.wait_for(client.control.wait_closed(), 60)
    finally:
        await client.close()
    # One save may have been in the server that died; its user saves again.
    assert refused <= 1, server.compose("logs", "--tail=40", "caddy").stdout
    found = {file["path"]: file["content"] for file in ann.get(f"projects/{project}")["files"]}
    assert found["assets/note.txt"] == stored
    async with started(ann, project) as again:
        await again.event("snapshot", timeout_s=60)
        assert again.state == "application_running"
        await again.until(lambda: ticks(again) > before, 120)
    server.compose("up", "-d", "--scale", "web=2")
    for name in server.webs():
        server.await_container(name)
    assert len(server.webs()) == 2


def sockets(server, name):
    """Returns the number of sockets of a web server."""
    return int(server.engine.run("exec", name, "python", "-c", METRICS).stdout)


def saves(user, project, count):
    """Saves one file repeatedly; returns the number of refusals, and the last stored text."""
    refused, revision, text = 0, 0, ""
    for number in range(count):
        try:
            done = save(user, project, "assets/note.txt", f"{number}", base=revision)
        except AssertionError as error:
            assert " 502 " in str(error)  # noqa: PT017 - anything else is a failure
            refused += 1
            revision = current(user, project)
        else:
            text = f"{number}"
            revision = next(file["revision"] for file in done["files"] if file["path"] == "assets/note.txt")
    return refused, text


def current(user, project):
    """Returns the current revision of the file, whether or not it was saved."""
    files = {file["path"]: file["revision"] for file in user.get(f"projects/{project}")["files"]}
    return files.get("assets/note.txt", 0)


def test_a_custom_certificate_is_served_and_renewed(server, tmp_path):
    text = (server.folder / ".env").read_text()
    (server.folder / ".env").write_text(text.replace("BT_STUDIO_TLS=internal", "BT_STUDIO_TLS=files"))
    for turn in ("first", "second"):
        certificate, key = tmp_path / f"{turn}.pem", tmp_path / f"{turn}.key"
        make = [
            "openssl",
            "req",
            "-x509",
            "-newkey",
            "ec",
            "-pkeyopt",
            "ec_paramgen_curve:prime256v1",
            "-nodes",
            "-days",
            "2",
        ]
        make += ["-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost"]
        subprocess.run([*make, "-keyout", key, "-out", certificate], check=True, capture_output=True)
        server.up_sh("--certificate", str(certificate), "--key", str(key))
        own = ssl.create_default_context(cafile=str(certificate))
        assert answer(server, "/accounts/login/", tls=own)[0] == 200


def test_the_scripts_pass_the_linter():
    scripts = sorted((REPOSITORY / "docker").rglob("*.sh"))
    done = subprocess.run(["shellcheck", *scripts], capture_output=True, text=True, check=False)
    assert done.stdout == ""
    assert len(scripts) >= 4
