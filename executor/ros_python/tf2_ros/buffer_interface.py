"""The interface of buffers: transforms and converts objects that have a frame and a stamp."""

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
    """No function is registered for this type."""

    def __init__(self, errstr: str) -> None:
        super().__init__(errstr)
        self.errstr = errstr


class NotImplementedException(Exception):  # noqa: N818 - its name in tf2
    """This buffer does not implement look-ups."""

    def __init__(self) -> None:
        self.errstr = "CanTransform or LookupTransform not implemented"
        super().__init__(self.errstr)


class TransformRegistration:
    """Stores a transform function for each type: a function of the object and a `TransformStamped`."""

    _functions: ClassVar[dict[Any, Callable[[Any, Any], Any]]] = {}

    def add(self, key: Any, callback: Callable[[Any, Any], Any]) -> None:
        """Registers the transform function of the type `key`."""
        self._functions[key] = callback

    def get(self, key: Any) -> Callable[[Any, Any], Any]:
        """Returns the transform function of a type.

        Raises:
            TypeException: no function is registered for the type.
        """
        return _found(self._functions, key)


class ConvertRegistration:
    """Stores conversions between types: direct ones, and those by way of a message."""

    _to_message: ClassVar[dict[Any, Callable[[Any], Any]]] = {}
    _from_message: ClassVar[dict[Any, Callable[[Any], Any]]] = {}
    _direct: ClassVar[dict[Any, Callable[[Any], Any]]] = {}

    def add_to_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Registers the conversion of a type to a message."""
        self._to_message[key] = callback

    def add_from_msg(self, key: Any, callback: Callable[[Any], Any]) -> None:
        """Registers the conversion of a message to a type."""
        self._from_message[key] = callback

    def add_convert(self, key: tuple[Any, Any], callback: Callable[[Any], Any]) -> None:
        """Registers the conversion of the first type to the second."""
        self._direct[key] = callback

    def get_to_msg(self, key: Any) -> Callable[[Any], Any]:
        """Returns the function that `add_to_msg` registered."""
        return _found(self._to_message, key)

    def get_from_msg(self, key: Any) -> Callable[[Any], Any]:
        """Returns the function that `add_from_msg` registered."""
        return _found(self._from_message, key)

    def get_convert(self, key: tuple[Any, Any]) -> Callable[[Any], Any]:
        """Returns the function that `add_convert` registered."""
        return _found(self._direct, key)


class BufferInterface:
    """Transforms objects; subclasses implement `lookup_transform`."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Any = None, new_type: Any = None
    ) -> Any:
        """Returns an object transformed into another frame, at the time of the stamp in its header.

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
        """Returns an object transformed into another frame at another time.

        Between the two times it is assumed to be at rest in `fixed_frame`.
        """
        header = object_stamped.header
        wait = timeout or Duration()
        found = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, wait
        )
        return self._transformed(object_stamped, found, new_type)

    def lookup_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        """Returns a transform; subclasses implement it."""
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
        """Returns a transform between two times; subclasses implement it."""
        raise NotImplementedException

    def can_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        """Returns whether a transform is known; subclasses implement it."""
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
        """Returns whether a transform between two times is known; subclasses implement it."""
        raise NotImplementedException

    def _transformed(self, thing: Any, transform: Any, new_type: Any) -> Any:
        result = self.registration.get(type(thing))(thing, transform)
        return result if new_type is None else convert(result, new_type)


def Stamped(obj: Any, stamp: Any, frame_id: str) -> Any:  # noqa: N802 - its name in tf2
    """Sets the stamp and the frame of an object, and returns the object."""
    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj


def convert(a: Any, b_type: Any) -> Any:
    """Returns an object converted to another type; a copy if it has that type already.

    Raises:
        TypeException: no conversion is registered.
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
