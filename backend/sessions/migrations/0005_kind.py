"""The kind of a session: a user works in it, or evaluations run in it."""

from __future__ import annotations

from django.conf import settings
from django.db import migrations, models
from django.db.models import Q

LIVE = ("queued", "starting", "ready")


class Migration(migrations.Migration):
    dependencies = [
        ("executor_sessions", "0004_lease"),
        migrations.swappable_dependency(settings.AUTH_USER_MODEL),
    ]

    operations = [
        migrations.RemoveConstraint(model_name="session", name="session_live_unique"),
        migrations.AddField(
            model_name="session",
            name="kind",
            field=models.CharField(
                choices=[("interactive", "Interactive"), ("evaluation", "Evaluation")],
                default="interactive",
                max_length=16,
            ),
        ),
        migrations.AddConstraint(
            model_name="session",
            constraint=models.UniqueConstraint(
                condition=Q(state__in=LIVE), fields=["project", "user", "kind"], name="session_live_unique"
            ),
        ),
    ]
