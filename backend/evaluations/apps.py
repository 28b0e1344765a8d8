"""The configuration of this Django app."""

from django.apps import AppConfig


class EvaluationsConfig(AppConfig):
    """The configuration of the app of evaluations."""

    name = "backend.evaluations"
    label = "evaluations"
    verbose_name = "Evaluations"

    def ready(self) -> None:
        """Connects the maintenance of sessions to the queue of evaluations."""
        from backend.evaluations.mine import data_of  # noqa: PLC0415 - models must be loaded
        from backend.evaluations.rounds import round_soon  # noqa: PLC0415
        from backend.projects.signals import data_asked  # noqa: PLC0415
        from backend.sessions.signals import sessions_maintained  # noqa: PLC0415

        data_asked.connect(data_of, dispatch_uid="data_of_evaluations")
        sessions_maintained.connect(round_soon, dispatch_uid="round_of_evaluations")
