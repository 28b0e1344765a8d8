"""Executors with a network of their own use no ROS domain of the host."""

from __future__ import annotations

from typing import TYPE_CHECKING

from django.db import migrations

if TYPE_CHECKING:
    from django.apps.registry import Apps
    from django.db.backends.base.schema import BaseDatabaseSchemaEditor

SHARING = "process"
LIVE = ("queued", "starting", "ready")


def give_back_domains(apps: Apps, _editor: BaseDatabaseSchemaEditor) -> None:
    """Frees the domains of live sessions in containers; their executors keep what they have."""
    sessions = apps.get_model("executor_sessions", "Session").objects
    sessions.filter(state__in=LIVE).exclude(launcher=SHARING).update(ros_domain_id=None)


class Migration(migrations.Migration):
    dependencies = [("executor_sessions", "0006_attached")]

    # The release before starts sessions with a domain, and reads those without: both may serve at once.
    operations = [migrations.RunPython(give_back_domains, migrations.RunPython.noop)]
