"""Caddy's image gets a certificate by ACME, from another Caddy as the test's authority."""

from __future__ import annotations

import secrets
import ssl
import subprocess
import time
from typing import Any

import pytest

from tests.docker.engine import build_images, engine
from tests.docker.test_stack import BUILT, TAG

AUTHORITY = """
{
    admin off
    skip_install_trust
}
https://acme.test {
    tls internal
    acme_server
}
"""
NAME = "bt.example.test"
ROOT = "/data/caddy/pki/authorities/local/root.crt"
DEADLINE_S = 120
ASK = f"""
import socket, ssl, sys
context = ssl.create_default_context(cadata=sys.stdin.read())
with socket.create_connection(("{NAME}", 443), 10) as plain:
    with context.wrap_socket(plain, server_hostname="{NAME}") as secure:
        print(secure.getpeercert()["subjectAltName"])
"""
pytestmark = [pytest.mark.timeout(1800)]


@pytest.fixture
def network(tmp_path):
    """Yields an engine, a network, and `run`, which starts containers in it; all are removed at the end."""
    with engine(tmp_path) as running:
        if not BUILT:
            build_images(running, TAG)
        name = "btacme" + secrets.token_hex(3)
        running.run("network", "create", name)
        started: list[Any] = []

        def run(alias, *options):
            started.append(f"{name}-{len(started)}")
            command = ("run", "-d", "--name", started[-1], "--network", name, "--network-alias", alias)
            running.run(*command, *options, f"bt-studio-caddy:{TAG}")
            return started[-1]

        try:
            yield running, name, run
        finally:
            for container in started:
                running.run("rm", "-f", "-v", container, check=False)
            running.run("network", "rm", name)


def until(attempt):
    """Repeats the attempt until it returns a result."""
    deadline = time.monotonic() + DEADLINE_S
    while not (found := attempt()):
        assert time.monotonic() < deadline
        time.sleep(0.2)
    return found


def test_a_public_name_gets_a_certificate_by_acme(network, tmp_path):
    engine_, name, run = network
    (tmp_path / "Caddyfile").write_text(AUTHORITY)
    tmp_path.chmod(0o755)
    authority = run("acme.test", "-v", f"{tmp_path}/Caddyfile:/etc/caddy/Caddyfile:ro")
    root = until(lambda: engine_.run("exec", authority, "cat", ROOT, check=False).stdout)
    ssl.PEM_cert_to_DER_cert(root)
    (tmp_path / "root.crt").write_text(root)
    settings = {
        "BT_STUDIO_DOMAIN": NAME,
        "BT_STUDIO_PUBLIC_URL": f"https://{NAME}",
        "BT_STUDIO_TLS": "acme",
        "BT_STUDIO_ACME_CA": "https://acme.test/acme/local/directory",
        # The test's own authority signs for the ACME authority.
        "SSL_CERT_FILE": "/root.crt",
    }
    words = [word for key, value in settings.items() for word in ("-e", f"{key}={value}")]
    closed = ("--read-only", "--cap-drop", "ALL", "--security-opt", "no-new-privileges")
    run(NAME, *closed, *words, "-v", f"{tmp_path}/root.crt:/root.crt:ro")

    def ask():
        command = [engine_.docker, "run", "--rm", "-i", "--network", name, "--entrypoint", "python"]
        done = subprocess.run(
            [*command, f"bt-studio-web:{TAG}", "-c", ASK],
            env=engine_.environment,
            input=root,
            text=True,
            capture_output=True,
            check=False,
        )
        return done.stdout

    assert NAME in until(ask)
