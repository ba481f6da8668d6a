"""The interface of propagation models: how much of each source arrives at a point of an object.

A model works in two phases, since a scene is prepared seldom and evaluated often. ``prepare`` computes everything that
depends on the scene and its contacts, ``PropagationField.attenuation`` everything that depends on the touched point.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.errors import ConfigError, ModelDomainError
from scene2hap.haptics import Bands
from scene2hap.plugins import Members, lacking
from scene2hap.propagation.plate import Plate, RigidBody
from scene2hap.propagation.points import InRectangle, object_points
from scene2hap.scene.geometry import Vector
from scene2hap.scene.objects import VERTICAL, Contact, UpAxis
from scene2hap.scene.pose import Pose

if TYPE_CHECKING:
    from scene2hap.propagation.coupled.contact_stiffness import ContactLaw
    from scene2hap.propagation.coupled.hand import Hand
    from scene2hap.propagation.elastic_body import ElasticBody

Body = Plate | RigidBody


@clear_construction
@dataclass(frozen=True)
class Excitation:
    """A source, as input of a model: its dominant frequency before and after conversion [Hz], and its mass [kg]."""

    source_id: str
    frequency_raw_hz: float
    frequency_tactile_hz: float
    mass_kg: float = 1.0

    def __post_init__(self) -> None:
        checks.text("source_id", self.source_id, error=ModelDomainError)
        for name, unit in (("frequency_raw_hz", "Hz"), ("frequency_tactile_hz", "Hz"), ("mass_kg", "kg")):
            named = f"{name} of source {checks.represented(self.source_id)}"
            value = checks.number(
                named, getattr(self, name), unit, above=0.0, at_least=1e-9, at_most=1e12, error=ModelDomainError
            )
            object.__setattr__(self, name, value)


@clear_construction
@dataclass(frozen=True)
class ContactNetwork:
    """Input of a propagation model: the bodies of a scene by object id, their contacts and their poses.

    An object without a body, because its material is unknown, does not carry vibration; it may still be a source.
    `poses` places the frame of each body in the world: its origin is a corner of the plate's mid-plane, x runs along
    the length, y along the width. A plate without a pose has its corner at the world's origin and its sides along x, y.
    `up_axis` tells which object of a pair stands on the other; None if unknown. `middles_m` has the middle of the box
    around each object [m], world. Sessions give it for all objects, those without a body included.
    """

    bodies: Mapping[str, Body]
    contacts: Sequence[Contact] = field(default_factory=tuple)
    poses: Mapping[str, Pose] = field(default_factory=dict)
    up_axis: UpAxis | None = None
    middles_m: Mapping[str, Vector] = field(default_factory=dict)

    def __post_init__(self) -> None:
        bodies = self.bodies
        verb, wrong = ("has", next(iter(bodies.values()), None)) if isinstance(bodies, Mapping) else ("is", bodies)
        if wrong is not None and not isinstance(wrong, Plate | RigidBody):
            raise ModelDomainError(
                f"bodies {verb} {checks.described(wrong)}; it must be a mapping of object ids to Plate or RigidBody."
            )
        if self.up_axis not in (None, *VERTICAL):
            raise ModelDomainError(f"up_axis is {checks.represented(self.up_axis)}; it must be 'y', 'z' or None.")

    def on_body(self, object_id: str, points_m: ArrayLike) -> NDArray[np.float64]:
        """Convert world points to (n_points, 2) [m] along length and width of a body, from its corner.

        Points beside a body are moved to its nearest edge, as if a rigid leg led there. A body without size does not
        move them.
        """
        points = object_points(object_id, points_m)
        return self.placing(object_id)(points)

    def placing(self, object_id: str) -> Callable[[NDArray[np.float64]], NDArray[np.float64]]:
        """Return the conversion of `on_body` for one body, as a function of points (n_points, 3), without checks."""
        return placing_of(self.bodies.get(object_id), self.poses.get(object_id))


def sides_m(body: Body | None) -> tuple[float, float] | None:
    """Length and width of a body [m], None without a size."""
    if isinstance(body, Plate):
        return body.length_m, body.width_m
    return None if body is None or body.size_m is None else body.size_m[:2]


def placing_of(body: Body | None, pose: Pose | None) -> Callable[[NDArray[np.float64]], NDArray[np.float64]]:
    """See `ContactNetwork.placing`."""
    sides = sides_m(body)
    if sides is not None:
        return InRectangle(pose or Pose(), *sides)
    return lambda points_m: (points_m if pose is None else pose.to_own(points_m))[:, :2]


@runtime_checkable
class PropagationField(Protocol):
    """Interface of a prepared scene: the gain of every source at points of an object."""

    @property
    def source_ids(self) -> tuple[str, ...]:
        """Ids of the sources, in the order of the second axis of `attenuation`."""
        ...

    def attenuation(self, object_id: str, points_m: NDArray[np.float64], /) -> NDArray[np.float64]:
        """Return the response at points of one object over each source's free vibration.

        Parameters: points_m : (n_points, 3) float64 [m], world, on or near the object as it was when prepared.
        Returns: a new array (n_points, n_sources, n_bands) float64 [-], >= 0; 1 on the source itself, 0 where nothing
        arrives.
        """
        ...


@runtime_checkable
class ExpectantField(PropagationField, Protocol):
    """A field that is faster at objects announced by `expect`. Optional."""

    def expect(self, object_id: str, /) -> None:
        """Prepare an object for many queries. May take as long as many queries, and may run in one thread while another
        queries; results change by rounding only."""
        ...


@dataclass(frozen=True)
class Carrier:
    """A contact through which vibration enters an object.

    Parameters: by : the object on the other side; point_m : position in the world when the field was prepared [m];
    share : part of all power that enters the object, 0..1.
    """

    by: str
    point_m: tuple[float, float, float]
    share: float


@runtime_checkable
class CarryingField(PropagationField, Protocol):
    """A field in which a source arrives over all paths at once, so that no single path explains it."""

    def carriers(self, object_id: str, source_id: str, band: int, /) -> tuple[Carrier, ...]:
        """Contacts through which a source's vibration enters an object in a band, strongest first; shares sum to 1.

        Returns: empty where nothing arrives, and on the source itself.
        """
        ...


def checked_field(
    model: PropagationModel, field: PropagationField, excitations: Sequence[Excitation]
) -> PropagationField:
    """Return the field that a model prepared, after checking it.

    Raises: ModelDomainError: it is no `PropagationField`, or its sources are not those of `excitations`.
    """
    made_by = f"{type(model).__name__}.prepare"
    if problem := lacking(field, _FIELD):
        raise ModelDomainError(f"{made_by} gave no PropagationField: {problem}")
    ids = checks.items("source_ids", field.source_ids, error=ModelDomainError)
    requested = {x.source_id for x in excitations}
    if set(ids) != requested:
        raise ModelDomainError(
            f"{made_by} gave a field of the sources {checks.shown(list(ids))}; it must have those of its excitations, "
            f"{checks.shown(sorted(requested))}."
        )
    return field


_FIELD: Members = {"source_ids": None, "attenuation": ("object_id", "points_m")}


def checked_gains(found: ArrayLike, shape: tuple[int, int, int]) -> NDArray[np.float64]:
    """Return a field's result as an array.

    Raises: ModelDomainError: complex numbers, or another shape, which kernels do not check.
    """
    if np.iscomplexobj(found):
        raise ModelDomainError("the model's field answered with complex numbers; a gain is their magnitude, np.abs(h).")
    gains: NDArray[np.float64] = np.asarray(found, dtype=np.float64)
    if gains.shape != shape:
        raise ModelDomainError(
            f"the model's field answered with an array of shape {gains.shape}; it must be {shape}: points or hands, "
            "sources and bands."
        )
    return gains


@runtime_checkable
class PropagationModel(Protocol):
    """Interface of propagation models: `prepare` solves a scene once and returns a field that is queried often."""

    def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands, /) -> PropagationField:
        """Prepare the field of a whole scene, over as many contacts as the model allows.

        Parameters: network : bodies and contacts; excitations : the sources; bands : of the gains.
        Returns: the field, for any number of queries. Raises: ModelDomainError: the model does not hold in this scene.
        """
        ...


def follows_poses(model: object) -> bool:
    """Return True if a model declares that its gains depend on where objects are, also without contact.

    A session prepares such a model after every move, and passes it all objects.
    """
    # Looked up in the class, since a session asks in every frame, and a model of ours answers a name that it does not
    # have with a long message.
    return hasattr(type(model), "follows_poses") and bool(getattr(model, "follows_poses", False))


@runtime_checkable
class CoupledModel(PropagationModel, Protocol):
    """A model whose bodies are coupled at their contacts; see `substructuring`."""

    @property
    def contact(self) -> ContactLaw:
        """Stiffness of contacts."""
        ...

    @property
    def hand(self) -> Hand | None:
        """Hand that loads an object at the touched point; None for no load."""
        ...

    def elastic_body(self, plate: Plate, max_frequency_hz: float) -> ElasticBody:
        """Return a plate that is not compact as a body for coupling up to `max_frequency_hz` [Hz]."""
        ...


def require_input(network: object, excitations: object, bands: object) -> None:
    """Raise a ModelDomainError unless these are valid arguments of a model's `prepare`."""
    some = next(iter(excitations), None) if isinstance(excitations, Sequence) else excitations
    is_excitation = isinstance(some, Excitation) or (some is None and isinstance(excitations, Sequence))
    has_or_is = "is" if some is excitations else "has"
    for name, value, is_right, wanted in (
        ("network is", network, isinstance(network, ContactNetwork), "a ContactNetwork(bodies, contacts)"),
        (f"excitations {has_or_is}", some, is_excitation, "a list of Excitation"),
        ("bands is", bands, isinstance(bands, Bands), "Bands, as Bands.third_octaves()"),
    ):
        if not is_right:
            raise ModelDomainError(f"{name} {checks.described(value)}; it must be {wanted}.")


def require_hops(max_hops: int | None) -> None:
    """Raise a ConfigError unless `max_hops` is a whole number of contacts, at least 1, or None for any number."""
    if max_hops is not None:
        checks.whole("max_hops", max_hops, "contacts", at_least=1, at_most=2**31 - 1, error=ConfigError)
