"""Finds subscriptions of actions to what nobody publishes, and calls of what nobody serves.

Only names that the source states for sure count. Where a launch file of the project starts nodes, nobody
knows their topics, so nothing is said.
"""

from __future__ import annotations

from difflib import SequenceMatcher
from typing import TYPE_CHECKING, Final

from translator.diagnostic import Place, diagnostic
from translator.endpoints import Endpoint, endpoints
from translator.package.launch_files import launch_files
from translator.ros_nodes import ros_endpoints
from translator.settings import NO_UNIVERSE
from translator.shared_modules import shared_modules
from translator.world_topics import world_of

if TYPE_CHECKING:
    from translator.check.context import Context
    from translator.diagnostic import Diagnostic
    from translator.world_topics import World

_GIVES: Final = {
    "subscription": "publisher",
    "client": "service",
    "action client": "action server",
}
# Each node of rclpy serves these.
_OF_PARAMETERS: Final = ("parameters", "parameter_types", "parameters_atomically", "type_description")


def check_nobody(context: Context) -> None:
    """Reports ends of topics, services and actions that have no other end here."""
    project = context.project
    if project.settings.universe == NO_UNIVERSE or launch_files(project.files):
        return
    made = {node.type for tree_id in context.reachable for node in project.trees[tree_id].walk()}
    used = [name for name in project.actions if name in made]
    sources = {project.actions[name].path: (name, project.actions[name].source) for name in used}
    for module in shared_modules(project, used):
        sources.setdefault(module.path, (module.name, module.source))
    opened = [(name, end) for path, (name, source) in sources.items() for end in endpoints(source, path)]
    if not any(end.kind in _GIVES for _, end in opened):
        return
    world = world_of(project)
    if world is None:
        return
    others = [end for _, end in opened] + list(ros_endpoints(project.trees.values()))
    for path, raw in project.files.items():
        if path.endswith(".py") and path not in sources:
            others += endpoints(raw.decode("utf-8", "replace"), path)
    for name, end in opened:
        if end.kind in _GIVES and end.known and not _has_other_end(end, others, world):
            context.found.append(_finding(name, end, world))


def _has_other_end(end: Endpoint, others: list[Endpoint], world: World) -> bool:
    topic = _absolute(end.name)
    if topic is None or topic.rpartition("/")[2].endswith(_OF_PARAMETERS):
        return True
    if end.kind == "subscription" and any(each.topic == topic for each in world.published):
        return True
    if end.kind != "subscription" and topic in world.served:
        return True
    gives = [each for each in others if each.kind == _GIVES[end.kind]]
    return any(not each.known or _absolute(each.name) in {topic, None} for each in gives)


def _finding(name: str, end: Endpoint, world: World) -> Diagnostic:
    place = Place(end.path, line=end.line)
    topic = _absolute(end.name)
    if end.kind != "subscription":
        return diagnostic("BT0625", place, name=name, topic=topic)
    alike = [each for each in world.published if each.type == end.type and each.sensor]
    if not alike:
        return diagnostic("BT0624", place, name=name, topic=topic)
    near = max(alike, key=lambda each: SequenceMatcher(None, topic or "", each.topic).ratio())
    values = {"sensor": near.sensor, "other": near.topic, "said": end.name, "universe": world.path}
    return diagnostic("BT0623", place, name=name, topic=topic, **values)


def _absolute(name: str) -> str | None:
    """Returns the full name for a node without a namespace; None for a name below the node's own."""
    return None if name.startswith("~") else name if name.startswith("/") else f"/{name}"
