"""Paths of stored runs, below `/api/v1/`."""

from backend.accounts.api.viewsets import resource_router
from backend.runs import views, views_mine

router = resource_router()
router.register("projects/<uuid:project_id>/runs", views.Runs, basename="runs")
router.register("runs", views_mine.MyRuns, basename="my_runs")
urlpatterns = router.urls
