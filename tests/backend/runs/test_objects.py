"""Large recordings are objects of the store: kept, read by ranges, refused, replaced and deleted."""

from __future__ import annotations

from datetime import timedelta

import pytest
from django.utils import timezone

from backend.core.objects.errors import StoreError
from backend.core.objects.store import the_store
from backend.core.objects.sweep import sweep
from backend.runs import objects as placing
from backend.runs import queries, writes
from backend.runs.errors import RunQuotaError
from backend.runs.models import Run, RunPart
from tests.backend.runs.conftest import SAMPLE, keep

pytestmark = pytest.mark.usefixtures("manager")


@pytest.fixture
def small(objects, settings_of):
    """The store takes recordings of any size."""
    settings_of(**objects.settings, object_store_from_bytes=0)
    return objects


def read(people, run, **headers):
    address = f"/api/v1/projects/{people.project.id}/runs/{run.id}/recording"
    return people.owner.client.get(address, headers=headers)


def test_a_recording_is_one_object_and_is_read_as_before(people, small):
    assert keep(people.owner, people.project).status_code == 201
    run = Run.objects.get()
    assert small.keys() == {run.stored_at}
    assert not RunPart.objects.exists()
    assert read(people, run).getvalue() == SAMPLE
    part = read(people, run, range="bytes=10-99")
    assert (part.status_code, part.getvalue()) == (206, SAMPLE[10:100])


def test_a_refused_one_leaves_nothing(people, small, settings_of):
    settings_of(**small.settings, object_store_from_bytes=0, max_user_run_bytes=len(SAMPLE) + 1)
    assert keep(people.owner, people.project).status_code == 201
    assert keep(people.owner, people.project).status_code == 413
    assert len(small.keys()) == 1
    with pytest.raises(RunQuotaError), placing.placed(_file(), len(SAMPLE), Run.objects.get().sha256):
        raise RunQuotaError("no room")
    assert len(small.keys()) == 1


def _file():
    from io import BytesIO

    return BytesIO(SAMPLE)


def test_the_object_of_a_deleted_run_is_swept_after_a_day(people, small):
    kept, gone = (keep(people.owner, people.project, name=name).json()["id"] for name in ("a", "b"))
    writes.delete(people.project.id, gone, acting_user=people.owner.user)
    for hours, deleted in ((23, 0), (25, 1)):
        now = timezone.now() + timedelta(hours=hours)
        assert sweep(the_store(), placing.FOLDER, placing.named, now=now) == deleted
    assert small.keys() == {Run.objects.get(id=kept).stored_at}


def test_one_that_moves_while_it_is_read_is_read_on(people, small, monkeypatch):
    monkeypatch.setattr("backend.core.objects.store.PART_BYTES", 1000)
    keep(people.owner, people.project)
    run = Run.objects.get()
    key, reading = run.stored_at, queries.parts(run, 0, run.size)
    assert next(reading) == SAMPLE[:1000]
    RunPart.objects.create(run=run, number=0, data=SAMPLE)
    Run.objects.update(stored_at=None)
    del reading
    the_store().delete([key])
    assert b"".join(queries.parts(run, 0, run.size)) == SAMPLE
    RunPart.objects.all().delete()
    with pytest.raises(RunPart.DoesNotExist):
        list(queries.parts(Run.objects.get(), 0, run.size))


def test_a_store_that_does_not_answer_keeps_the_run_for_later(people, small, settings_of):
    settings_of(object_store="http://127.0.0.1:9/studio", object_store_from_bytes=0)
    assert keep(people.owner, people.project).json()["code"] == "object_store_unavailable"
    assert not Run.objects.exists()
    with pytest.raises(StoreError), placing.placed(_file(), len(SAMPLE), "0" * 64):
        raise AssertionError
