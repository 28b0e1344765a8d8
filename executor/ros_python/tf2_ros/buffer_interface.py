"""What every buffer can do with things that have a frame and a stamp."""

from __future__ import annotations

from copy import deepcopy
from typing import TYPE_CHECKING, Any, ClassVar

from rclpy.duration import Duration
from std_msgs.msg import Header

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.time import Time

__all__ = [
    "BufferInterface",
    "ConvertRegistration",
    "NotImplementedException",
    "Stamped",
    "TransformRegistration",
    "TypeException",
    "convert",
]


class TypeException(Exception):  # noqa: N818 - its name in tf2
    """Nobody said how this type is transformed or converted."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(Exception):  # noqa: N818 - its name in tf2
    """This buffer cannot look transforms up."""

    def __init__(self) -> None:
        self.errstr = "CanTransform or LookupTransform not implemented"
        super().__init__(self.errstr)


class TransformRegistration:
    """How things of a type are transformed: a function of the thing and a `TransformStamped`."""

    _functions: ClassVar[dict[Any, Callable[[Any, Any], Any]]] = {}

    def add(self, key: Any, callback: Callable[[Any, Any], Any]) -> None:
        """Says how things of the type `key` are transformed."""
        self._functions[key] = callback

    def get(self, key: Any) -> Callable[[Any, Any], Any]:
        """Returns how things of a type are transformed.

        Raises:
            TypeException: nobody said so.
        """
        return _found(self._functions, key)


class ConvertRegistration:
    """How things of one type become things of another, directly or by way of a message."""

    _to_message: ClassVar[dict[Any, Callable[[Any], Any]]] = {}
    _from_message: ClassVar[dict[Any, Callable[[Any], Any]]] = {}
    _direct: ClassVar[dict[Any, Callable[[Any], Any]]] = {}

    def add_to_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Says how things of a type become a message."""
        self._to_message[key] = callback

    def add_from_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Says how a message becomes a thing of a type."""
        self._from_message[key] = callback

    def add_convert(self, key: tuple[Any, Any], callback: Callable[[Any], Any]) -> None:
        """Says how things of the first type become things of the second."""
        self._direct[key] = callback

    def get_to_msg(self, key: Any) -> Callable[[Any], Any]:
        """Returns what `add_to_msg` was given."""
        return _found(self._to_message, key)

    def get_from_msg(self, key: Any) -> Callable[[Any], Any]:
        """Returns what `add_from_msg` was given."""
        return _found(self._from_message, key)

    def get_convert(self, key: tuple[Any, Any]) -> Callable[[Any], Any]:
        """Returns what `add_convert` was given."""
        return _found(self._direct, key)


class BufferInterface:
    """Transforms things; how transforms are looked up is left to `lookup_transform`."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = None, new_type: Any = None
    ) -> Any:
        """Returns a thing with a header in another frame, at the time of its stamp.

        `tf2_geometry_msgs` must be imported for the types of `geometry_msgs`.
        """
        header = object_stamped.header
        wait = timeout or Duration()
        found = self.lookup_transform(target_frame, header.frame_id, header.stamp, wait)
        return self._transformed(object_stamped, found, new_type)

    def transform_full(  # noqa: PLR0913, PLR0917 - as in tf2
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time,
        fixed_frame: str,
        timeout: Any = None,
        new_type: Any = None,
    ) -> Any:
        """Returns a thing in another frame at another time, as if it stayed in `fixed_frame` in between."""
        header = object_stamped.header
        wait = timeout or Duration()
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, wait
        )
        return self._transformed(object_stamped, found, new_type)

    def lookup_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        """Returns a transform; a buffer says how."""
        raise NotImplementedException

    def lookup_transform_full(  # noqa: PLR0913, PLR0917 - as in tf2
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> Any:
        """Returns a transform over time; a buffer says how."""
        raise NotImplementedException

    def can_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        """Tells whether there is a transform; a buffer says how."""
        raise NotImplementedException

    def can_transform_full(  # noqa: PLR0913, PLR0917 - as in tf2
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> Any:
        """Tells whether there is a transform over time; a buffer says how."""
        raise NotImplementedException

    def _transformed(self, thing: Any, transform: Any, new_type: Any) -> Any:
        result = self.registration.get(type(thing))(thing, transform)
        return result if new_type is None else convert(result, new_type)


def Stamped(obj: Any, stamp: Any, frame_id: str) -> Any:  # noqa: N802 - its name in tf2
    """Gives a thing a header."""
    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


def convert(a: Any, b_type: Any) -> Any:
    """Returns a thing as one of another type; a copy if it is of that type already.

    Raises:
        TypeException: nobody said how.
    """
    registered = ConvertRegistration()
    direct = registered._direct.get((type(a), b_type))
    if direct is not None:
        return direct(a)
    if type(a) is b_type:
        return deepcopy(a)
    return registered.get_from_msg(b_type)(registered.get_to_msg(type(a))(a))


def _found(functions: dict[Any, Any], key: Any) -> Any:
    if key not in functions:
        raise TypeException(f"Type {key} is not loaded or supported")
    return functions[key]
