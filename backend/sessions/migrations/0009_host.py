"""The host on which an executor runs, and longer addresses, which name it."""

from __future__ import annotations

from django.db import migrations, models


class Migration(migrations.Migration):
    dependencies = [("executor_sessions", "0008_warm")]

    # The release before writes no host: the database does, as long as both serve.
    operations = [
        migrations.AddField(
            model_name="session",
            name="host",
            field=models.CharField(blank=True, db_default="", default="", max_length=270),
        ),
        migrations.AlterField(
            model_name="session", name="address", field=models.CharField(blank=True, max_length=400)
        ),
    ]
