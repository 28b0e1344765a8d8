"""Serializers of projects: the OpenAPI document, and the first check of requests."""

from __future__ import annotations

import base64
import binascii
from typing import Any, Final

from drf_spectacular.utils import extend_schema_field
from rest_framework import serializers

from backend.core.limits import LIMITS
from backend.core.rest.fields import (
    ObjectField,
    StrictBooleanField,
    StrictIntegerField,
    StrictSerializer,
    TextField,
)
from backend.projects.storage.changes import Content, FileChange
from backend.projects.storage.names import MAX_NAME_LENGTH, MAX_PATH_LENGTH
from translator.nav2.distributions import DISTRIBUTIONS

MAX_REVISION = 2**31 - 1


class StepSerializer(serializers.Serializer[Any]):
    """A node on the path of a finding's reason."""

    tree = serializers.CharField()
    node = serializers.CharField()
    label = serializers.CharField()  # type: ignore[assignment]
    results = serializers.ListField(child=serializers.CharField(), help_text="What it can return.")
    role = serializers.CharField(help_text="reads, writes or commands; empty for a node on the way.")
    what = serializers.CharField(help_text="The key or topic.")


class DiagnosticSerializer(serializers.Serializer[Any]):
    """One finding of the translator."""

    code = serializers.CharField()
    severity = serializers.ChoiceField(choices=["error", "warning", "note"])
    message = serializers.CharField()
    hint = serializers.CharField()
    values = serializers.DictField(child=serializers.CharField())
    tree = serializers.CharField()
    node = serializers.CharField()
    port = serializers.CharField()
    file = serializers.CharField()
    line = serializers.IntegerField(allow_null=True)
    column = serializers.IntegerField(allow_null=True)
    path = StepSerializer(many=True)


class PortSerializer(serializers.Serializer[Any]):
    """A port that an action declares."""

    name = serializers.CharField()
    direction = serializers.ChoiceField(choices=["input", "output", "inout"])
    type = serializers.CharField()
    default = serializers.CharField(allow_null=True)
    required = serializers.BooleanField()  # type: ignore[assignment]
    description = serializers.CharField()


class ChildrenSerializer(serializers.Serializer[Any]):
    """The numbers of children that a kind of node may have; `null` as the largest means any number."""

    min = serializers.IntegerField()
    max = serializers.IntegerField(allow_null=True)


class ActionSerializer(serializers.Serializer[Any]):
    """The declarations in the source of an action."""

    name = serializers.CharField()
    path = serializers.CharField()
    doc = serializers.CharField()
    kind = serializers.CharField()
    children = ChildrenSerializer()
    open = serializers.BooleanField()
    line = serializers.IntegerField()
    ports = PortSerializer(many=True)
    imports = serializers.ListField(child=serializers.CharField())
    diagnostics = DiagnosticSerializer(many=True)


CHECKED: Final = "false: the project could not be checked, so that its actions are not known."


class ReportSerializer(serializers.Serializer[Any]):
    """The findings of the translator about a project."""

    diagnostics = DiagnosticSerializer(many=True)
    actions = ActionSerializer(many=True)
    ros_distro = serializers.ChoiceField(
        choices=DISTRIBUTIONS,
        allow_null=True,
        help_text="The one that the project states, or else the one that has the nodes of Nav2 in its trees; "
        "null if the project cannot be read.",
    )
    checked = serializers.BooleanField(help_text=CHECKED)


class FileSerializer(serializers.Serializer[Any]):
    """A current file; `content` is null if the file is not text, or is left out."""

    path = serializers.CharField()
    revision = serializers.IntegerField()
    size = serializers.IntegerField()
    sha256 = serializers.CharField()
    updated_at = serializers.DateTimeField()
    content = serializers.CharField(allow_null=True)
    left_out = serializers.BooleanField(
        help_text="The file is large: its content must be downloaded. Trees and settings are never left out."
    )


class FileInfoSerializer(serializers.Serializer[Any]):
    """A file without its content."""

    path = serializers.CharField()
    revision = serializers.IntegerField()
    size = serializers.IntegerField()
    sha256 = serializers.CharField()


class ProjectSummarySerializer(serializers.Serializer[Any]):
    """A project in a list."""

    id = serializers.UUIDField()
    name = serializers.CharField()
    description = serializers.CharField()
    main_tree = serializers.CharField()
    universe = serializers.CharField()
    revision = serializers.IntegerField()
    size = serializers.IntegerField()
    created_at = serializers.DateTimeField()
    updated_at = serializers.DateTimeField()
    archived_at = serializers.DateTimeField(allow_null=True)
    deleted_at = serializers.DateTimeField(allow_null=True)
    role = serializers.ChoiceField(
        choices=["viewer", "editor", "owner"], help_text="What the user who asked may do with it."
    )
    owner = serializers.CharField()
    root_diagram = ObjectField(allow_null=True)
    conditions = serializers.ListField(
        child=serializers.CharField(),
        help_text="Types of the tree that are conditions.",
    )


class ProjectListSerializer(serializers.Serializer[Any]):
    """A page of projects; `next_offset` is null on the last page."""

    items = ProjectSummarySerializer(many=True)
    total = serializers.IntegerField()
    next_offset = serializers.IntegerField(allow_null=True)


class ProjectDetailSerializer(ProjectSummarySerializer, ReportSerializer):
    """An opened project."""

    settings = ObjectField()
    files = FileSerializer(many=True)


class ProposalSerializer(serializers.Serializer[Any]):
    """A universe for an imported project, and the topics of its actions that ask for it."""

    universe = serializers.CharField()
    topics = serializers.CharField(help_text="Separated by a comma and a space.")


class ImportedProjectSerializer(ProjectDetailSerializer):
    """An imported project."""

    proposal = ProposalSerializer(
        allow_null=True, help_text="null: the file names its universe, or its actions ask for none."
    )
    one_block = serializers.CharField(
        allow_blank=True,
        help_text="Why a tree of py_trees is one block; empty if it is a tree of blocks.",
    )


class ProjectListQuerySerializer(serializers.Serializer[Any]):
    """The query of a list."""

    search = serializers.CharField(required=False, default="", allow_blank=True, max_length=200)
    sort = serializers.ChoiceField(
        choices=["name", "-name", "updated_at", "-updated_at", "created_at", "-created_at"],
        required=False,
        default="-updated_at",
    )
    shelf = serializers.ChoiceField(
        choices=["current", "archived", "deleted"], required=False, default="current"
    )
    limit = serializers.IntegerField(required=False, default=500, min_value=1, max_value=500)
    offset = serializers.IntegerField(required=False, default=0, min_value=0, max_value=MAX_REVISION)


class CreateProjectSerializer(StrictSerializer):
    """A new project."""

    name = TextField(required=False, default="", max_length=MAX_NAME_LENGTH)
    template = TextField(required=False, default="empty", max_length=MAX_NAME_LENGTH)


class DuplicateProjectSerializer(StrictSerializer):
    """The name of the copy. Without a name, the copy gets the same name with a number."""

    name = TextField(required=False, default="", max_length=MAX_NAME_LENGTH)


class EditProjectSerializer(StrictSerializer):
    """Fields of `project.json` to change; `settings` replaces all settings."""

    base_revision = StrictIntegerField(min_value=1, max_value=MAX_REVISION)
    name = TextField(required=False, max_length=MAX_NAME_LENGTH)
    description = TextField(required=False, max_length=LIMITS["description_characters"])
    settings = ObjectField(required=False)


class FileChangeSerializer(StrictSerializer):
    """New content, a new path, both, or the deletion of one file."""

    path = TextField(max_length=MAX_PATH_LENGTH)
    base_revision = StrictIntegerField(
        min_value=0, max_value=MAX_REVISION, help_text="0: the file must not exist yet."
    )
    content = TextField(required=False)
    content_base64 = TextField(required=False)
    delete = StrictBooleanField(required=False, default=False)
    rename_to = TextField(required=False, default="", max_length=MAX_PATH_LENGTH)

    def validate(self, attrs: dict[str, Any]) -> dict[str, Any]:
        """Returns the change with its decoded content."""
        if "content" in attrs and "content_base64" in attrs:
            raise serializers.ValidationError({"content": "Give content or content_base64, not both."})
        attrs["bytes"] = _content(attrs)
        return attrs


def _content(attrs: dict[str, Any]) -> Content | None:
    if "content" in attrs:
        return Content.of(attrs["content"].encode())
    if "content_base64" not in attrs:
        return None
    try:
        return Content.of(base64.b64decode(attrs["content_base64"], validate=True))
    except (binascii.Error, ValueError) as error:
        raise serializers.ValidationError({"content_base64": "This is not base64."}) from error


class ChangesSerializer(StrictSerializer):
    """One user action on several files; it is carried out completely or not at all."""

    message = TextField(required=False, default="", max_length=500)
    files = FileChangeSerializer(many=True, allow_empty=False)


def file_changes(data: dict[str, Any]) -> list[FileChange]:
    """Converts the checked request to file changes."""
    return [
        FileChange(f["path"], f["base_revision"], f["bytes"], delete=f["delete"], rename_to=f["rename_to"])
        for f in data["files"]
    ]


class ChangesDoneSerializer(ReportSerializer):
    """The project after the change: all files, and the translator's findings."""

    revision = serializers.IntegerField()
    files = FileInfoSerializer(many=True)


class TheirsSerializer(serializers.Serializer[Any]):
    """The version of the file on the server."""

    revision = serializers.IntegerField()
    content = serializers.CharField(allow_null=True)
    updated_at = serializers.DateTimeField()


class MineSerializer(serializers.Serializer[Any]):
    """The version of the file in the request."""

    content = serializers.CharField(allow_null=True)


class ConflictSerializer(serializers.Serializer[Any]):
    """Both versions of a file; `theirs` is null if the file was removed."""

    path = serializers.CharField()
    base_revision = serializers.IntegerField()
    theirs = TheirsSerializer(allow_null=True)
    mine = MineSerializer()


class OverlayFileSerializer(StrictSerializer):
    """A file with the content of the editor."""

    path = TextField(max_length=MAX_PATH_LENGTH)
    content = TextField()


class CheckSerializer(StrictSerializer):
    """Files that differ from the stored ones, for a check before saving."""

    files = OverlayFileSerializer(many=True, required=False, default=list)


class DistributionSerializer(CheckSerializer):
    """The ROS distribution that a project shall be for, and its unsaved files."""

    ros_distro = serializers.ChoiceField(choices=DISTRIBUTIONS)


class WrittenFileSerializer(serializers.Serializer[Any]):
    """A file as it shall be; `content` is null if it goes."""

    path = serializers.CharField()
    content = serializers.CharField(allow_null=True)


class DistributionChangeSerializer(serializers.Serializer[Any]):
    """The result of a change of the ROS distribution; nothing is written."""

    files = WrittenFileSerializer(many=True)
    lacks = serializers.ListField(
        child=serializers.CharField(),
        help_text="Nodes and ports of the trees that Nav2 does not have there; they stay as they are.",
    )
    kept = serializers.ListField(
        child=serializers.CharField(), help_text="Nodes whose source was changed by hand; it stays."
    )


class InspectActionSerializer(StrictSerializer):
    """The source of an action."""

    source = TextField(max_length=2_000_000)  # type: ignore[assignment]
    filename = TextField(max_length=MAX_PATH_LENGTH)


class RevisionFileSerializer(serializers.Serializer[Any]):
    """The change of a file in a revision."""

    path = serializers.CharField()
    change = serializers.ChoiceField(choices=["written", "deleted", "renamed"])
    renamed_from = serializers.CharField()


class RevisionSerializer(serializers.Serializer[Any]):
    """One revision of a project."""

    number = serializers.IntegerField()
    message = serializers.CharField()
    label = serializers.CharField()  # type: ignore[assignment]
    author = serializers.CharField()
    created_at = serializers.DateTimeField()
    files = RevisionFileSerializer(many=True)


class RevisionListSerializer(serializers.Serializer[Any]):
    """Revisions, the newest first; `next_before` is null on the last page."""

    items = RevisionSerializer(many=True)
    next_before = serializers.IntegerField(allow_null=True)


class RevisionListQuerySerializer(serializers.Serializer[Any]):
    """The query of a history."""

    path = serializers.CharField(required=False, default="", max_length=MAX_PATH_LENGTH)
    before = serializers.IntegerField(required=False, min_value=1, max_value=MAX_REVISION)
    limit = serializers.IntegerField(required=False, default=100, min_value=1, max_value=500)


class LabelSerializer(StrictSerializer):
    """A name for a revision; an empty name removes the label."""

    label = TextField(max_length=100)  # type: ignore[assignment]


class RestoreRevisionSerializer(StrictSerializer):
    """The files to restore; without any, all files are restored."""

    paths = serializers.ListField(
        child=TextField(max_length=MAX_PATH_LENGTH),
        required=False,
        default=list,
        max_length=LIMITS["files_per_project"],
    )


class FileDiffSerializer(serializers.Serializer[Any]):
    """A file that differs; `diff` is null if one of the versions is not text."""

    path = serializers.CharField()
    change = serializers.ChoiceField(choices=["added", "removed", "changed"])
    diff = serializers.CharField(allow_null=True)


class DiffSerializer(serializers.Serializer[Any]):
    """The differences between two revisions."""

    older = serializers.IntegerField()
    newer = serializers.IntegerField()
    files = FileDiffSerializer(many=True)


class DiffQuerySerializer(serializers.Serializer[Any]):
    """The revision to compare with; by default the previous one."""

    against = serializers.IntegerField(required=False, min_value=0, max_value=MAX_REVISION)


class DraftSerializer(serializers.Serializer[Any]):
    """A draft: text that this user has typed and not saved."""

    path = serializers.CharField()
    base_revision = serializers.IntegerField()
    content = serializers.CharField(allow_blank=True)
    updated_at = serializers.DateTimeField()


class DraftListSerializer(serializers.Serializer[Any]):
    """The drafts of a project."""

    items = DraftSerializer(many=True)


class SaveDraftSerializer(StrictSerializer):
    """A draft to store."""

    base_revision = StrictIntegerField(min_value=0, max_value=MAX_REVISION)
    content = TextField()


class AppSerializer(serializers.Serializer[Any]):
    """The project in the form that the executor runs."""

    app_zip_base64 = serializers.CharField()
    tick_hz = serializers.FloatField()
    on_finish = serializers.ChoiceField(choices=["stop", "repeat"])
    on_error = serializers.ChoiceField(choices=["stop", "failure"])
    time = serializers.ChoiceField(choices=["exact", "live"])
    universe = serializers.SerializerMethodField()
    robot = serializers.CharField(allow_null=True)
    revision = serializers.IntegerField(help_text="The revision of the project; a recording names it.")

    @extend_schema_field(
        {
            "oneOf": [
                {"type": "string"},
                {
                    "type": "object",
                    "properties": {
                        "document": {"type": "string"},
                        "assets_zip_base64": {"type": "string"},
                        "file": {"type": "string", "description": "What errors call the document."},
                    },
                    "required": ["document", "assets_zip_base64", "file"],
                },
            ]
        }
    )
    def get_universe(self, app: dict[str, Any]) -> Any:
        """Returns the universe: its id, or a document with its assets."""
        return app["universe"]
