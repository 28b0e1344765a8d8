"""The frames of SDF: what a name means in a world or a model, and where that is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor.sdf.dialect import SdfError, line_of
from executor.sdf.includes import MERGED, PLACEMENT, file_of, is_before
from executor.sdf.values import pose_in, text_of
from executor.world.geometry.transforms import IDENTITY, Pose, compose, inverse

if TYPE_CHECKING:
    from collections.abc import Iterator

    from lxml import etree

ROOT_NAMES: Final = ("", "__model__", "__root__", "world")
SEPARATOR: Final = "::"


class Scope:
    """The names of a world or of a model.

    Attributes:
        element: the `<world>` or `<model>`.
        links: its links by name, in their order.
        joints: its joints.
        frames: its `<frame>` elements.
        models: the scopes of the models in it.
    """

    def __init__(self, element: etree._Element, parent: Scope | None = None) -> None:
        self.element = element
        self.parent = parent
        self.file = file_of(element)
        self.links = self._named("link")
        self.joints = self._named("joint")
        self.frames = self._named("frame")
        self.models = {name: Scope(model, self) for name, model in self._named("model").items()}
        self._known: dict[str, Pose] = {}

    @property
    def name(self) -> str:
        """The name of the world or model."""
        return self.element.get("name") or str(self.element.tag)

    @property
    def path(self) -> tuple[str, ...]:
        """The names of the models from the outermost model to this one."""
        above = self.parent.path if self.parent is not None and self.parent.element.tag == "model" else ()
        return (*above, self.name)

    def walk(self) -> Iterator[Scope]:
        """Yields this scope and those of all models in it."""
        yield self
        for model in self.models.values():
            yield from model.walk()

    def pose_of(self, element: etree._Element, base: str = "", asked: tuple[str, ...] = ()) -> Pose:
        """Returns the pose of an element of this scope in the scope's frame.

        Its values are relative to the frame `base` unless it names another one.

        Raises:
            SdfError: the pose is malformed, or names a frame that does not exist.
        """
        pose = element.find("pose")
        if pose is not None:
            said = pose.get("relative_to")
            if not said and is_before(pose, 1, 7):
                said = pose.get("frame")
            base = said or base
        return compose(self.frame(base, asked, element), pose_in(pose, self.file))

    def frame(self, name: str, asked: tuple[str, ...] = (), at: etree._Element | None = None) -> Pose:
        """Returns the pose of a link, joint, frame or model in the frame of this scope.

        Raises:
            SdfError: there is no such frame, or the frames form a ring.
        """
        if name in ROOT_NAMES:
            return IDENTITY
        if name not in self._known:
            if name in asked:
                raise self._wrong(f"the frame {name!r} goes round in a circle", at)
            self._known[name] = self._found(name, (*asked, name), at)
        return self._known[name]

    def _found(self, name: str, asked: tuple[str, ...], at: etree._Element | None) -> Pose:
        head, separator, rest = name.partition(SEPARATOR)
        if separator and head in self.models:
            return compose(self.frame(head, asked, at), self.models[head].frame(rest, (), at))
        if (link := self.links.get(name)) is not None:
            return self.pose_of(link, "", asked)
        if (joint := self.joints.get(name)) is not None:
            return self.pose_of(joint, text_of(joint, "child"), asked)
        if (frame := self.frames.get(name)) is not None:
            return self.pose_of(frame, frame.get("attached_to") or "", asked)
        if (model := self.models.get(name)) is not None:
            made = self.pose_of(model.element, "", asked)
            placed = model.element.get(PLACEMENT)
            return compose(made, inverse(model.frame(placed, (), model.element))) if placed else made
        for merged in self.models.values():
            if merged.element.get(MERGED) and merged.has(name):
                return compose(self.frame(merged.name, asked, at), merged.frame(name, (), at))
        raise self._wrong(f"the frame {name!r} does not exist", at)

    def has(self, name: str) -> bool:
        """Returns whether a name means something here."""
        return any(name in names for names in (self.links, self.joints, self.frames, self.models))

    def link_of(  # noqa: PLR0911 - one for each kind of name
        self, name: str, at: etree._Element, asked: tuple[str, ...] = ()
    ) -> tuple[Scope, str] | None:
        """Returns the link to which a name is attached, with its scope; None for the world.

        Raises:
            SdfError: there is no such name, or no link.
        """
        if name == "world":
            return None
        if name in asked:
            raise self._wrong(f"the frame {name!r} goes round in a circle", at)
        asked = (*asked, name)
        head, separator, rest = name.partition(SEPARATOR)
        if separator and head in self.models:
            return self.models[head].link_of(rest, at)
        if name in self.links:
            return self, name
        if (joint := self.joints.get(name)) is not None:
            return self.link_of(text_of(joint, "child"), at, asked)
        if (frame := self.frames.get(name)) is not None:
            return self.link_of(frame.get("attached_to") or "__model__", at, asked)
        if name in self.models:
            return self.models[name].link_of("__model__", at)
        if name == "__model__":
            return self._canonical(at, asked)
        for merged in self.models.values():
            if merged.element.get(MERGED) and merged.has(name):
                return merged.link_of(name, at)
        what = f"the {at.tag} {at.get('name')!r}"
        raise self._wrong(f"{what} names the link {name!r}, which does not exist", at)

    def _canonical(self, at: etree._Element, asked: tuple[str, ...]) -> tuple[Scope, str] | None:
        said = self.element.get("canonical_link")
        if said:
            return self.link_of(said, at, asked)
        for child in self.element:
            name = child.get("name", "")
            if child.tag == "link" and name in self.links:
                return self, name
            if child.tag == "model" and name in self.models:
                return self.models[name].link_of("__model__", at)
        raise self._wrong(f"the model {self.name!r} has no link", at)

    def in_top(self) -> Pose:
        """Returns the pose of this model in the outermost model."""
        above = self.parent
        if above is None or above.element.tag != "model":
            return IDENTITY
        return compose(above.in_top(), above.frame(self.name))

    def _named(self, tag: str) -> dict[str, etree._Element]:
        found: dict[str, etree._Element] = {}
        for element in self.element.findall(tag):
            name = element.get("name", "")
            if not name or name in found:
                text = f"the {tag} {name!r} is defined twice" if name else f"a {tag} needs a name"
                raise self._wrong(text, element)
            found[name] = element
        return found

    def _wrong(self, message: str, at: etree._Element | None) -> SdfError:
        place = self.element if at is None else at
        return SdfError(message, file_of(place), line_of(place))
