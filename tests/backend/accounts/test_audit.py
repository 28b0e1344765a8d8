"""The log drops old entries, and a server on localhost has no entries."""

from __future__ import annotations

from datetime import timedelta

from django.utils import timezone

from backend.accounts.audit import note
from backend.accounts.models import AuditEntry
from backend.projects.storage.writes import collect_garbage


def test_old_entries_go_and_young_ones_stay(person, settings_of):
    settings_of(audit_days=30)
    ada = person("ada").user
    AuditEntry.objects.all().delete()
    for days, action in ((31, "old.one"), (29, "young.one")):
        note(action, actor=ada)
        AuditEntry.objects.filter(action=action).update(at=timezone.now() - timedelta(days=days))
    collect_garbage()
    assert [row.action for row in AuditEntry.objects.all()] == ["young.one"]


def test_on_localhost_nothing_is_written(project):
    assert not AuditEntry.objects.exists()
