"""A batch of seeds in a supervisor of its own."""

import pytest

from executor.evaluation.cluster.batch import run_batch
from executor.evaluation.cluster.parcel import pack
from executor.evaluation.fingerprint import fingerprint
from executor.evaluation.plan import make_plan
from executor.evaluation.pool.worker import Limits
from tests.executor.evaluation.projects import DRIVE, project

TEXT = "duration_s: 1\nruns: 2\njudge: {success: [{never: collision}]}\n"
CRASHES = DRIVE.replace("twist = Twist()", "import os\n        os._exit(3)")


@pytest.mark.simulation
@pytest.mark.timeout(200)
def test_a_batch_returns_each_run_and_what_the_machine_is():
    batch = run_batch(pack(make_plan(project(TEXT, action=CRASHES), "main")), [4, 7], Limits(30.0))
    assert [(each.outcome.seed, each.outcome.outcome) for each in batch.done] == [
        (4, "crashed"),
        (7, "crashed"),
    ]
    assert (batch.lost, batch.fingerprint["id"]) == ("", fingerprint()["id"])
    assert batch.node


@pytest.mark.timeout(200)
def test_a_supervisor_that_fails_says_why():
    batch = run_batch(b"no parcel", [1], None)
    assert batch.done == ()
    assert batch.lost.startswith("its supervisor ended with exit code 1: msgspec")


@pytest.mark.simulation
@pytest.mark.timeout(200)
def test_the_runs_of_a_batch_do_not_see_the_token_of_the_cluster(monkeypatch):
    monkeypatch.setenv("RAY_AUTH_TOKEN", "secret")
    monkeypatch.setenv("RAYS_OF_LIGHT", "7")
    names = 'sorted(name for name in os.environ if name.startswith("RAY"))'
    tells = DRIVE.replace("twist = Twist()", f"import os\n        raise RuntimeError({names})")
    (done,) = run_batch(pack(make_plan(project(TEXT, action=tells), "main")), [4], Limits(30.0)).done
    assert "['RAYS_OF_LIGHT']" in done.outcome.why
