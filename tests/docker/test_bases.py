"""Base images are pulled by digest where the file has one; a local script is the registry."""

from __future__ import annotations

import os
import re
import subprocess
from collections import Counter

import pytest

from tests.docker.engine import REPOSITORY

DIGESTS = REPOSITORY / "docker" / "bases" / "digests"
FIRST, SECOND = (f"sha256:{character * 64}" for character in "ab")
# `calls` has its requests; `registry` and `images` have a file for each image, with its digest.
DOCKER = r"""#!/usr/bin/env bash
set -eu
cd "$(dirname "$0")"
echo "$*" >>calls
name=${@: -1}
case $1 in
  pull)
    if [ -f "registry/$name" ]; then cp "registry/$name" "images/$name"; exit; fi
    for one in registry/"${name%@*}":*; do
      if [ "$(<"$one")" = "${name#*@}" ]; then cp "$one" "images/$name"; exit; fi
    done
    exit 1 ;;
  tag) cp "images/$2" "images/$3" ;;
  image)
    [ -f "images/$name" ] || exit 1
    digest=$(<"images/$name")
    if [ "$digest" != none ]; then echo "${name%:*}@$digest"; fi ;;
  build) ;;
  *) exit 2 ;;
esac
"""


@pytest.fixture
def machine(tmp_path):
    """Sets up a machine with its own docker program, registry and file of digests."""
    (tmp_path / "docker").write_text(DOCKER)
    (tmp_path / "docker").chmod(0o755)
    (tmp_path / "calls").write_text("")
    for name in named():
        write(tmp_path, "images", name, "none")
        write(tmp_path, "registry", name, FIRST)
    (tmp_path / "digests").write_text(DIGESTS.read_text())
    return tmp_path


def named():
    lines = (line.split() for line in DIGESTS.read_text().splitlines())
    return [words[0] for words in lines if words and words[0] != "#"]


def write(machine, place, name, digest):
    (machine / place).mkdir(exist_ok=True)
    (machine / place / name).write_text(digest)


def script(machine, *command, **settings):
    environment = {
        **os.environ,
        "DOCKER": str(machine / "docker"),
        "BT_STUDIO_DIGESTS": str(machine / "digests"),
        "BT_STUDIO_NO_PULL": "",
        **settings,
    }
    return subprocess.run(
        ["bash", *command], cwd=REPOSITORY, env=environment, capture_output=True, text=True, check=False
    )


def calls(machine, word):
    return [line for line in (machine / "calls").read_text().splitlines() if line.startswith(word)]


def lock(machine):
    return script(machine, "docker/bases/lock.sh", str(machine / "digests"))


def test_the_file_names_each_base_once_and_its_digests_are_digests():
    lines = [line for line in DIGESTS.read_text().splitlines() if line and not line.startswith("#")]
    assert all(re.fullmatch(r"[a-z0-9/]+:[a-z0-9.-]+( sha256:[0-9a-f]{64})?", line) for line in lines)
    assert max(Counter(named()).values()) == 1
    froms = set()
    for path in (REPOSITORY / "docker").glob("*.Dockerfile"):
        froms |= set(re.findall(r"(?m)^FROM (\S+:\S+)", path.read_text()))
    froms |= set(re.findall(r"image: ((?!bt-studio)\S+)", (REPOSITORY / "docker/compose.yaml").read_text()))
    assert froms <= set(named())


def test_locking_writes_the_registrys_digests_down_and_keeps_the_comments(machine):
    assert lock(machine).returncode == 0
    text = (machine / "digests").read_text()
    assert [line for line in text.splitlines() if line.startswith("#")] == [
        line for line in DIGESTS.read_text().splitlines() if line.startswith("#")
    ]
    assert all(f"{name} {FIRST}\n" in text for name in named())


def test_locking_changes_nothing_when_an_image_cannot_be_pulled(machine):
    (machine / "registry" / named()[1]).unlink()
    done = lock(machine)
    assert done.returncode == 1
    assert f"{named()[1]} cannot be pulled" in done.stderr
    assert (machine / "digests").read_text() == DIGESTS.read_text()


def test_images_are_pulled_by_their_digest_and_only_if_they_are_not_there(machine):
    lock(machine)
    for path in (machine / "images").iterdir():
        path.unlink()
    (machine / "calls").write_text("")
    assert script(machine, "docker/images.sh", "mine").returncode == 0
    wanted = {f"pull --quiet {name.split(':')[0]}@{FIRST}" for name in named()}
    assert set(calls(machine, "pull")) == wanted
    (machine / "calls").write_text("")
    assert script(machine, "docker/images.sh", "mine").returncode == 0
    assert calls(machine, "pull") == []


def test_a_digest_that_the_registry_does_not_have_is_not_replaced_by_the_tag(machine):
    lock(machine)
    (machine / "calls").write_text("")
    for name in named():
        write(machine, "registry", name, SECOND)
        write(machine, "images", name, "none")
    done = script(machine, "docker/images.sh", "mine")
    assert done.returncode == 0
    for name in named():
        assert f"{name} is the one of this machine, not the one of docker/bases/digests" in done.stdout
    assert calls(machine, "tag") == []


def test_without_a_registry_the_images_of_this_machine_are_taken(machine):
    assert script(machine, "docker/images.sh", "mine", BT_STUDIO_NO_PULL="1").returncode == 0
    assert calls(machine, "pull") == []
    assert len(calls(machine, "build")) == 4
