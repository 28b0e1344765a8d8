"""`docker/up.sh` without an engine: its handling of arguments and settings, and its refusals."""

from __future__ import annotations

import os
import subprocess

import pytest

from tests.docker.engine import REPOSITORY

UP = REPOSITORY / "docker" / "up.sh"
FAKE = REPOSITORY / "tests" / "fakes" / "docker_program.sh"
GOOD = "20.10.24 linux/x86_64"


@pytest.fixture
def up(tmp_path):
    """Runs the script until it needs images, which do not exist."""

    def run(*words, info=GOOD, refusal="", volumes="", docker=str(FAKE)):
        ours = {name: value for name, value in os.environ.items() if not name.startswith("BT_STUDIO_")}
        ours |= {"DOCKER": docker, "BT_STUDIO_ENV_FILE": str(tmp_path / ".env")}
        ours |= {"FAKE_INFO": info, "FAKE_REFUSAL": refusal, "FAKE_VOLUMES": volumes}
        ours |= {"FAKE_LOG": str(tmp_path / "asked")}
        command = [str(UP), "--no-build", *words]
        done = subprocess.run(command, env=ours, capture_output=True, text=True, check=False)
        assert done.returncode == (0 if "--help" in words else 1), done.stdout + done.stderr
        return done.stdout + done.stderr

    return run


@pytest.fixture
def settings(tmp_path):
    """Returns the lines that the script wrote."""

    def read():
        lines = (tmp_path / ".env").read_text().splitlines()
        return dict(line.split("=", 1) for line in lines if not line.startswith("#"))

    return read


def test_help_names_every_option(up):
    said = up("--help")
    options = (
        "--tls",
        "--certificate",
        "--key",
        "--http-port",
        "--https-port",
        "--admin",
        "--email",
        "--no-build",
    )
    for option in options:
        assert f"\n  {option}" in said
    assert "set -euo" not in said


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"docker": "no-such-program"}, "Docker is missing"),
        ({"info": "", "refusal": "dial unix: permission denied"}, "run this as root"),
        ({"info": "", "refusal": "Is the docker daemon running?"}, "is it started"),
        ({"info": "19.03.1 linux/x86_64"}, "Docker 19.03.1 is too old"),
        ({"info": "27.1.0 linux/aarch64"}, "the robots need linux/x86_64"),
    ],
)
def test_a_docker_that_will_not_do_is_named_and_nothing_is_written(up, given, said, tmp_path):
    assert said in up("bt.example.org", **given)
    assert not (tmp_path / ".env").exists()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((), "under which name"),
        (("https://bt.example.org/",), "without https://"),
        (("bt.example.org:8443",), "by --https-port"),
        (("fe80::1",), "an IPv4 address"),
        (("-x",), "no option -x"),
        (("bt example",), "no name of a host"),
        (("a", "b"), "one HOST is enough"),
        (("a", "--tls"), "--tls needs a value"),
        (("a", "--tls", "none"), "none of acme, internal and proxy"),
        (("a", "--certificate", "/none.pem", "--key", "/none.key"), "'/none.pem' cannot be read"),
    ],
)
def test_wrong_arguments_are_named_and_nothing_is_written(up, words, said, tmp_path):
    assert said in up(*words)
    assert not (tmp_path / ".env").exists()


@pytest.mark.parametrize(
    ("host", "tls", "https"),
    [
        ("BT.example.org", "acme", "443"),
        ("192.168.1.20", "internal", "443"),
        ("robots.local", "internal", "443"),
        ("robots", "internal", "443"),
        ("localhost", "internal", "127.0.0.1:443"),
    ],
)
def test_the_host_says_who_signs_and_where_ports_appear(up, settings, host, tls, https):
    assert "the image bt-studio-web:latest is not here" in up(host)
    made = settings()
    assert (made["BT_STUDIO_TLS"], made["BT_STUDIO_HTTPS_PUBLISH"]) == (tls, https)
    assert made["BT_STUDIO_DOMAIN"] == host.lower()
    assert made["BT_STUDIO_PUBLIC_URL"] == f"https://{host.lower()}"
    assert made.get("BT_STUDIO_HSTS_DAYS") == ("0" if host == "localhost" else None)


def test_other_ports_are_in_the_address(up, settings):
    up("192.168.1.20", "--http-port", "8080", "--https-port", "8443")
    made = settings()
    assert made["BT_STUDIO_PUBLIC_URL"] == "https://192.168.1.20:8443"
    assert (made["BT_STUDIO_HTTP_PUBLISH"], made["BT_STUDIO_HTTPS_PUBLISH"]) == ("8080", "8443")


def test_a_second_run_changes_nothing_and_needs_no_arguments(up, tmp_path):
    up("bt.example.org")
    before = (tmp_path / ".env").read_bytes()
    up()
    up("bt.example.org")
    assert (tmp_path / ".env").read_bytes() == before


def test_settings_of_a_user_are_never_overwritten(up, tmp_path):
    before = "BT_STUDIO_PUBLIC_URL=http://bt.example.org:8000\nBT_STUDIO_SECRET_KEY='mine'"
    (tmp_path / ".env").write_text(before)
    (tmp_path / ".env").chmod(0o644)
    said = up("bt.example.org")
    assert "BT_STUDIO_PUBLIC_URL is 'http://bt.example.org:8000'" in said
    assert "--tls proxy" in said
    assert "only its owner reads it" in said
    after = (tmp_path / ".env").read_text()
    assert after.startswith(before + "\n")
    assert "BT_STUDIO_SECRET_KEY=" not in after[len(before) :]
    assert (tmp_path / ".env").stat().st_mode & 0o777 == 0o600


def test_another_host_than_last_time_is_not_taken_silently(up):
    up("bt.example.org")
    assert "BT_STUDIO_DOMAIN is 'bt.example.org', and should be 'other.example.org'" in up(
        "other.example.org"
    )


def test_a_custom_proxy_gets_no_ports_of_caddys(up, settings):
    up("bt.example.org", "--tls", "proxy")
    made = settings()
    assert made["BT_STUDIO_PROXY_HOPS"] == "1"
    assert "BT_STUDIO_HTTPS_PUBLISH" not in made


def test_a_database_whose_password_is_lost_ends_it(up, settings):
    assert "the volume docker_database holds a database" in up("bt.example.org", volumes="docker_database")
    assert "BT_STUDIO_DATABASE_PASSWORD" not in settings()
