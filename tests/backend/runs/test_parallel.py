"""Many runs that are kept at the same time; `test_postgresql` runs this on PostgreSQL, too."""

from __future__ import annotations

import io
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
from django.db import connection

from backend.config.environment import environment
from backend.runs import writes
from backend.runs.errors import RunQuotaError
from backend.runs.facts import Facts
from backend.runs.models import Run, RunPart

pytestmark = pytest.mark.django_db(transaction=True)
KEEPS = 50
FIT = 10
SIZE = 3000


def test_fifty_parallel_keeps_hold_the_quota(people, monkeypatch):
    limits = environment().model_copy(update={"max_user_run_bytes": FIT * SIZE + SIZE // 2})
    monkeypatch.setattr("backend.runs.queries.environment", lambda: limits)
    everyone = threading.Barrier(KEEPS)

    def keep(number):
        try:
            everyone.wait(60)
            file = io.BytesIO(number.to_bytes(2, "little") * (SIZE // 2))
            fetched = writes.Fetched(file, Facts(0.0, 1.0))
            writes.keep(fetched, people.project, {"name": str(number)}, acting_user=people.editor.user)
        except RunQuotaError:
            return False
        finally:
            connection.close()
        return True

    with ThreadPoolExecutor(KEEPS) as pool:
        kept = list(pool.map(keep, range(KEEPS)))
    assert sum(kept) == FIT
    names = {str(number) for number, was_kept in enumerate(kept) if was_kept}
    assert set(Run.objects.values_list("name", flat=True)) == names
    assert set(Run.objects.values_list("size", flat=True)) == {SIZE}
    assert RunPart.objects.count() == FIT
