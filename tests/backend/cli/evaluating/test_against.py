"""`--against`: where the older version comes from, and what is compared."""

from __future__ import annotations

import subprocess

import pytest

from backend.cli.evaluating.against import open_older
from backend.cli.shared.errors import CliError
from backend.cli.shared.translation import open_project
from tests.backend.cli.evaluating.test_evaluate import TEXT
from tests.cli.typed import evaluating as studio
from tests.executor.evaluation.projects import DRIVE, write

SLOW = DRIVE.replace("default=0.5", "default=0.05")


def git(folder, *arguments):
    identity = ["-c", "user.name=Test", "-c", "user.email=test@example.org"]
    subprocess.run(["git", "-C", str(folder), *identity, *arguments], check=True, capture_output=True)


def test_the_older_version_comes_from_a_folder_or_git_and_the_world_from_the_newer(tmp_path):
    folder = write(tmp_path / "repository" / "p", TEXT, action=SLOW)
    git(tmp_path / "repository", "init")
    git(tmp_path / "repository", "add", "-A")
    git(tmp_path / "repository", "commit", "-m", "slow")
    write(folder, TEXT + "# newer\n", action=DRIVE)
    newer = open_project(str(folder))
    other = write(tmp_path / "other", TEXT, action=SLOW)
    for against in ("HEAD", str(other)):
        older = open_older(newer, str(folder), against)
        assert older.files["actions/Drive.py"] == SLOW.encode()
        assert older.files["evaluations/main.yaml"] == newer.files["evaluations/main.yaml"]


@pytest.mark.parametrize("against", ["HEAD~99", "--output=/tmp/x", "nowhere"])
def test_a_revision_that_is_not_there_is_refused(tmp_path, against):
    folder = write(tmp_path / "p", TEXT)
    with pytest.raises(CliError) as caught:
        open_older(open_project(str(folder)), str(folder), against)
    assert caught.value.status == 2


@pytest.mark.simulation
@pytest.mark.timeout(300)
def test_in_its_own_world_each_version_has_its_own_judge_and_nothing_is_paired(tmp_path):
    never = TEXT.replace("area: ahead", "area: behind").replace("runs: 6", "runs: 3")
    assert never.count("behind") == 1
    newer, older = write(tmp_path / "n", TEXT), write(tmp_path / "o", never)
    done = studio(
        "evaluate", newer, "--against", older, "--own-world", "--seeds", "2,3", "--report", tmp_path / "r"
    )
    assert "each in its own world: +100.0%" in done.stdout
    assert "not paired); the older one: 0 of 2" in done.stdout
    assert "McNemar" not in done.stdout
    assert "path_length_m: median" in done.stdout
    assert "in its own world" in (tmp_path / "r" / "report.html").read_text()


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["--own-world"], "name the older version with --against"),
        (["--against", ".", "--own-world", "--gate", "no-worse"], "it needs pairs"),
        (["--against", ".", "--own-world", "--judged-by", "."], "leave out one of both"),
    ],
)
def test_what_only_pairs_could_answer_is_refused(tmp_path, options, text):
    folder = str(write(tmp_path / "p", TEXT))
    done = studio("evaluate", folder, *[folder if each == "." else each for each in options])
    assert done.returncode == 2
    assert text in " ".join(done.stderr.replace("│", " ").split())


@pytest.mark.simulation
@pytest.mark.timeout(300)
def test_a_slower_version_is_worse_on_the_same_seeds(tmp_path):
    newer, older = write(tmp_path / "n", TEXT, action=SLOW), write(tmp_path / "o", TEXT)
    done = studio("evaluate", newer, "--against", older, "--report", tmp_path / "r", "--gate", "no-worse")
    assert "only the older version succeeds: seeds" in done.stdout
    assert "McNemar p =" in done.stdout
    assert "path_length_m: -" in done.stdout
    assert (tmp_path / "r" / "against" / "runs.jsonl").read_bytes().count(b"\n") == 6
    assert done.returncode in {0, 1}
    assert ("FAILS" in done.stdout) == (done.returncode == 1)
    assert studio("evaluate", newer, "--gate", "no-worse").returncode == 2
