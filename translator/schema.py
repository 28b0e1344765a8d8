"""The diagram format as Pydantic models, the source of its JSON Schema.

`diagram.restore` reads and repairs documents. A document that these models accept needs no repair, except for
links between nodes, which a schema cannot describe.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from translator.enums import EnumsDocument
from translator.settings import Settings
from translator.tree import CONDITIONS  # noqa: TC001 - Pydantic reads the annotations

Coordinate = Annotated[float, Field(gt=-1e9, lt=1e9)]


class _Document(BaseModel):
    model_config = ConfigDict(extra="forbid")


class PortDocument(_Document):
    """A port of the tree, which callers set on their SubTree node."""

    name: str
    direction: Literal["input", "output", "inout"] = "input"
    type: str = Field(default="any", description="int, uint, double, bool, string, list[…] or any.")
    default: str | None = None
    required: bool = False
    description: str = ""


class NodeDocument(_Document):
    """One node of a diagram."""

    type: str = Field(min_length=1, description="A built-in node, an action of the project, or SubTree.")
    tree: str = Field(default="", description="The id of the tree that a SubTree calls.")
    name: str = Field(default="", description="The name of this instance.")
    ports: dict[str, str] = Field(default={}, description="Text by port: a literal, {key}, {=} or {@key}.")
    conditions: dict[Literal[CONDITIONS], str] = Field(  # type: ignore[valid-type]
        default={}, description="Scripts of pre- and post-conditions."
    )
    attributes: dict[str, str] = Field(
        default={}, description="Attributes of imported XML that are not known here, and _autoremap."
    )
    children: list[str] = Field(default=[], description="Ids of the children, in order of execution.")
    position: tuple[Coordinate, Coordinate] | None = Field(
        default=None, description="Where it is drawn; without it, the editor lays the tree out."
    )
    comment: str = ""
    color: str = ""
    disabled: bool = Field(default=False, description="Whether the node is skipped.")
    collapsed: bool = Field(default=False, description="Whether the branch is drawn folded.")
    silenced: dict[str, str] = Field(
        default={},
        description="Codes of findings that are not reported here, each with the reason; version 2.",
    )


class DiagramDocument(_Document):
    """One behaviour tree, `trees/<id>.json`."""

    format: Literal["bt-studio/diagram"]
    version: Literal[1, 2] = Field(description="2 if a node has `silenced`, else 1.")
    id: str = Field(min_length=1, description="The ID of the BehaviorTree.")
    root: str | None = Field(description="The id of the root node; null in an empty tree.")
    ports: list[PortDocument] = Field(default=[], description="The tree's ports as a SubTree.")
    attributes: dict[str, str] = Field(default={}, description="Attributes of an imported <BehaviorTree>.")
    nodes: dict[str, NodeDocument] = Field(description="The nodes by id; an id never changes.")
    drafts: list[str] = Field(default=[], description="Roots of pieces that are not connected.")
    layout: str = Field(default="vertical", description="vertical or horizontal.")
    conflicts: list[dict[str, Any]] = Field(
        default=[], description="Decisions that a merge has left; a tree with one does not run."
    )


SCHEMAS: dict[str, type[BaseModel]] = {
    "diagram": DiagramDocument,
    "enums": EnumsDocument,
    "project": Settings,
}


def json_schema(name: str) -> dict[str, Any]:
    """Returns the JSON Schema of a format."""
    schema = SCHEMAS[name].model_json_schema()
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": f"bt-studio/{name}/1", **schema}
