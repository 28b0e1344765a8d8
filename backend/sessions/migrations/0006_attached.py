"""A session that follows a program outside has no project, but the address of the program."""

from __future__ import annotations

from django.conf import settings
from django.db import migrations, models
from django.db.models import Q

LIVE = ("queued", "starting", "ready")


class Migration(migrations.Migration):
    dependencies = [
        ("executor_sessions", "0005_kind"),
        migrations.swappable_dependency(settings.AUTH_USER_MODEL),
    ]

    operations = [
        migrations.AddField(
            model_name="session",
            name="target",
            field=models.CharField(blank=True, default="", max_length=260),
        ),
        migrations.AlterField(
            model_name="session",
            name="project",
            field=models.ForeignKey(
                null=True,
                on_delete=models.CASCADE,
                related_name="sessions",
                to="projects.project",
            ),
        ),
        migrations.AlterField(
            model_name="session",
            name="kind",
            field=models.CharField(
                choices=[
                    ("interactive", "Interactive"),
                    ("evaluation", "Evaluation"),
                    ("attached", "Attached"),
                ],
                default="interactive",
                max_length=16,
            ),
        ),
        migrations.AddConstraint(
            model_name="session",
            constraint=models.UniqueConstraint(
                condition=Q(state__in=LIVE, kind="attached"),
                fields=["user", "target"],
                name="session_target_unique",
            ),
        ),
        migrations.AddConstraint(
            model_name="session",
            constraint=models.CheckConstraint(
                condition=Q(kind="attached", project=None) | (~Q(kind="attached") & Q(project__isnull=False)),
                name="session_project_or_target",
            ),
        ),
    ]
