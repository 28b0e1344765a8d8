"""Paths of evaluations, below `/api/v1/`."""

from backend.accounts.api.viewsets import resource_router
from backend.evaluations import views

router = resource_router()
router.register("projects/<uuid:project_id>/evaluations", views.Evaluations, basename="evaluations")
urlpatterns = router.urls
