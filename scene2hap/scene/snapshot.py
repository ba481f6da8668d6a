"""A scene as typed, frozen data: the input of inference and of playback.

Metres, right-handed. An object's mesh and its dominant surface are in the object's own frame; its pose places that
frame in the world. Scale and mirroring are baked into the mesh, so a pose is always rigid.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import ClassVar, SupportsIndex, overload

from pydantic import InstanceOf

from scene2hap.common import checks
from scene2hap.common.calls import clear_calls
from scene2hap.common.counted import counted
from scene2hap.common.html_tables import html_table, number
from scene2hap.errors import CallError, SceneError, UnknownObject
from scene2hap.scene.copies import as_copy
from scene2hap.scene.images import ImageSet
from scene2hap.scene.objects import (
    Contact,
    SceneData,
    SceneObject,
    UpAxis,
    require_placed,
    unknown_object,
    with_known_up,
    with_relative_heights,
)
from scene2hap.scene.plausibility import Finding
from scene2hap.scene.pose import Pose, vertical


class ObjectTuple(tuple[SceneObject, ...]):
    """A tuple of objects. Its error for a text as index explains how to find an object by its id."""

    __slots__ = ()

    @overload
    def __getitem__(self, key: SupportsIndex) -> SceneObject: ...
    @overload
    def __getitem__(self, key: slice) -> tuple[SceneObject, ...]: ...
    def __getitem__(self, key: SupportsIndex | slice) -> SceneObject | tuple[SceneObject, ...]:
        if isinstance(key, str):
            raise CallError(f"objects is a tuple, so that [{key!r}] finds nothing; write scene.object({key!r}).")
        return super().__getitem__(key)


def _require_object(item: object) -> None:
    if not isinstance(item, SceneObject):
        raise SceneError(f"an object is {checks.described(item)}; it must be a SceneObject(id, pose=, geometry=).")


_MOST_OBJECTS, _MOST_CONTACTS = 10_000_000, 100_000_000  # only an endless generator exceeds these


@clear_calls
@dataclass(frozen=True)
class SceneSnapshot(SceneData):
    """A scene as data that never changes: objects with names, poses and geometry, in metres.

    `SceneSnapshot.build(objects)` makes one in Python, `load_scene` reads one from a file.

    Parameters:
    name : for people. up_axis : "y" or "z".
    objects : at least one, each with an id of its own.
    contacts : given contacts; None to find contacts from geometry.
    images : of the whole scene; None until `capture_images`.
    Raises: SceneError: no object, two objects with one id, or a contact with an object that does not exist.
    """

    _CALL_HINT: ClassVar[str] = "To make a scene of objects, call SceneSnapshot.build(objects)."

    images: InstanceOf[ImageSet] | None = field(default=None, compare=False, repr=False)
    _by_id: Mapping[str, SceneObject] = field(init=False, repr=False, compare=False, default_factory=dict)

    def __post_init__(self) -> None:
        vertical(self.up_axis)
        checks.text("name", self.name, error=SceneError)
        objects = checks.items("objects", self.objects, at_most=_MOST_OBJECTS, error=SceneError)
        for item in objects:
            _require_object(item)
        object.__setattr__(self, "objects", ObjectTuple(with_known_up(item, self.up_axis) for item in objects))
        if not self.objects:
            raise SceneError(f"scene {self.name!r} has no object with a surface; nothing in it can be touched.")
        by_id = {item.id: item for item in self.objects}
        if len(by_id) < len(self.objects):
            twice = [key for key, n in Counter(item.id for item in self.objects).items() if n > 1]
            raise SceneError(f"object id {twice[0]!r} is used more than once; ids must be unique (names need not be).")
        object.__setattr__(self, "_by_id", by_id)
        if self.contacts is not None:
            contacts = checks.items("contacts", self.contacts, at_most=_MOST_CONTACTS, error=SceneError)
            object.__setattr__(self, "contacts", contacts)
            for contact in contacts:
                if not isinstance(contact, Contact):
                    given = checks.described(contact)
                    raise SceneError(f"a contact is {given}; it must be a Contact(a, b, point_m) of two object ids.")
                self.object(contact.a)
                self.object(contact.b)

    @classmethod
    def build(
        cls,
        objects: Iterable[SceneObject],
        *,
        name: str = "scene",
        up_axis: UpAxis = "y",
        contacts: Iterable[Contact] | None = None,
    ) -> SceneSnapshot:
        """Return a scene of objects made in Python. Missing surfaces, and heights, are measured for its up axis.

        Objects of equal geometry without looks and without a key get one `instance_key`, so that copies are inferred
        once.

        Raises: SceneError: as the constructor.
        Warns: UnitWarning: the sizes cannot be metres.
        """
        from scene2hap.scene.plausibility.units import warn_if_implausible

        if isinstance(objects, SceneObject | str | Mapping) or not isinstance(objects, Iterable):
            given = checks.described(objects)
            raise SceneError(f"objects is {given}; it must be a list of SceneObject, as SceneSnapshot.build([object]).")
        vertical(up_axis)
        keyed = []
        for item in objects:
            _require_object(item)
            require_placed(item)
            keyed.append(as_copy(item) if not item.instance_key and item.appearance is None else item)
        if contacts is not None:
            contacts = checks.items("contacts", contacts, at_most=_MOST_CONTACTS, error=SceneError)
        scene = cls(name, up_axis, tuple(keyed), contacts)
        scene = replace(scene, objects=with_relative_heights(scene.objects, up_axis))
        warn_if_implausible(scene, source="python")
        return scene

    def object(self, object_id: str) -> SceneObject:
        """Return the object with an id.

        Raises: UnknownObject: there is none; the message names the nearest ids.
        """
        if not isinstance(object_id, str) or object_id not in self._by_id:
            raise UnknownObject(unknown_object(object_id, self._by_id))
        return self._by_id[object_id]

    def with_poses(self, moved: Mapping[str, Pose]) -> SceneSnapshot:
        """Move some objects. Returns a scene with new heights, without given contacts and images."""
        for object_id in moved:
            self.object(object_id)
        objects = []
        for item in self.objects:
            pose = moved.get(item.id, item.pose)
            # Objects that stay keep the bounds that they have derived.
            is_same = pose == item.pose and item.images is None
            objects.append(item if is_same else replace(item, pose=pose, images=None))
        return SceneSnapshot(self.name, self.up_axis, with_relative_heights(objects, self.up_axis))

    def check(self) -> tuple[Finding, ...]:
        """Find likely mistakes: units, quaternions, masses, the up axis, floating or sunken objects."""
        from scene2hap.scene.plausibility.check import findings

        return tuple(findings(self))

    def __repr__(self) -> str:
        return f"SceneSnapshot({self.name!r}, {counted(len(self.objects), 'object')}, {self.up_axis} up)"

    def _repr_html_(self) -> str:
        def row(item: SceneObject) -> tuple[str, ...]:
            size = " × ".join(number(edge) for edge in item.size_m)
            return item.id, item.name, size, number(item.relative_height_m), number(item.mass_kg)

        count = len(self.objects)
        title = f"Scene {self.name}: {counted(count, 'object')}, {self.up_axis} up"
        columns = ("object", "name", "dominant surface [m]", "height above the lowest point [m]", "mass [kg]")
        return html_table(title, columns, map(row, self.objects), count)

    def to_json(self) -> str:
        """Return the whole scene as JSON; `from_json` restores it exactly."""
        from scene2hap.scene.json import dump

        return dump(self)

    @classmethod
    def from_json(cls, text: str) -> SceneSnapshot:
        """Return a scene from JSON.

        Raises: SceneError: the text is not JSON or not a scene; the message names the field.
        """
        from scene2hap.scene.json import parse

        return cls.of(parse(text))

    @classmethod
    def of(cls, data: SceneData) -> SceneSnapshot:
        """Build the scene from plain data. Raises: as the constructor."""
        return cls(data.name, data.up_axis, data.objects, data.contacts)
