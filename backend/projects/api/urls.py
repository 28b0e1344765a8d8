"""Addresses of projects, below `/api/v1/`."""

from __future__ import annotations

from django.urls import path

from backend.projects.api import views, views_files, views_mine, views_revisions, views_sharing, views_trees

ONE = "projects/<uuid:project_id>"

urlpatterns = [
    path("projects", views.Projects.as_view()),
    path("projects/import", views_files.Import.as_view()),
    path(ONE, views.OneProject.as_view()),
    path(f"{ONE}/restore", views.Restore.as_view()),
    path(f"{ONE}/archive", views.Archive.as_view()),
    path(f"{ONE}/unarchive", views.Unarchive.as_view()),
    path(f"{ONE}/duplicate", views.Duplicate.as_view()),
    path(f"{ONE}/changes", views.Changes.as_view()),
    path(f"{ONE}/check", views.Check.as_view()),
    path(f"{ONE}/app", views.App.as_view()),
    path(f"{ONE}/xml", views_files.Xml.as_view()),
    path(f"{ONE}/package", views_files.Package.as_view()),
    path(f"{ONE}/package/preview", views_files.PackagePreview.as_view()),
    path(f"{ONE}/export", views_files.Export.as_view()),
    path(f"{ONE}/files/<path:path>", views_files.File.as_view()),
    path(f"{ONE}/revisions", views_revisions.Revisions.as_view()),
    path(f"{ONE}/revisions/<int:number>", views_revisions.Revision.as_view()),
    path(f"{ONE}/revisions/<int:number>/diff", views_revisions.RevisionDiff.as_view()),
    path(f"{ONE}/revisions/<int:number>/restore", views_revisions.RestoreRevision.as_view()),
    path(f"{ONE}/revisions/<int:number>/files/<path:path>", views_revisions.RevisionFile.as_view()),
    path(f"{ONE}/drafts", views_revisions.Drafts.as_view()),
    path(f"{ONE}/drafts/<path:path>", views_revisions.OneDraft.as_view()),
    path(f"{ONE}/shares", views_sharing.Shares.as_view()),
    path(f"{ONE}/transfer", views_sharing.Transfer.as_view()),
    path(f"{ONE}/shares/people/<str:username>", views_sharing.SharedPerson.as_view()),
    path(f"{ONE}/shares/groups/<uuid:group_id>", views_sharing.SharedGroup.as_view()),
    path(f"{ONE}/shares/links", views_sharing.Links.as_view()),
    path(f"{ONE}/shares/links/<uuid:link_id>", views_sharing.OneLink.as_view()),
    path("me/usage", views_mine.Usage.as_view()),
    path("me/data", views_mine.MyData.as_view()),
    path("trees/xml", views_trees.TreeXml.as_view()),
    path("trees/diagram", views_trees.TreeDiagram.as_view()),
    path("actions/inspect", views.InspectAction.as_view()),
]
