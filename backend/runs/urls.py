"""Paths of stored runs, below `/api/v1/`."""

from backend.accounts.api.viewsets import resource_router
from backend.runs import views

router = resource_router()
router.register("projects/<uuid:project_id>/runs", views.Runs, basename="runs")
urlpatterns = router.urls
