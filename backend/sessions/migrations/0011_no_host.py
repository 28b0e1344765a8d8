"""Executors run on the machine of the web server or in a cluster: sessions have no host any more."""

from __future__ import annotations

from django.db import migrations


class Migration(migrations.Migration):
    dependencies = [("executor_sessions", "0010_own_cluster")]

    # The release before does not have this column.
    operations = [migrations.RemoveField(model_name="session", name="host")]
