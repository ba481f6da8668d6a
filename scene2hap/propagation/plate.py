"""Thin plates, with their constants and the wavenumber of their bending waves, and rigid bodies.

Letters: E [Pa] Young's modulus, nu [-] Poisson's ratio, rho [kg/m3] density, h [m] thickness,
D [N m] bending stiffness per width, omega [rad/s], k [rad/m].
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common import checks
from scene2hap.common.arrays import floats
from scene2hap.common.calls import clear_construction
from scene2hap.errors import ModelDomainError
from scene2hap.materials import Material, lookup
from scene2hap.scene.surface.outline import Outline

MAX_FREQUENCY_HZ = 1e9
"""Highest valid frequency [Hz], far beyond any vibration; assumed, so that squares of frequencies do not overflow."""

_SIZES_M = {"at_least": 1e-30, "at_most": 1e6}
"""Bounds on sizes [m], far beyond any object; assumed, so that third powers of sizes do not under- or overflow."""

_EDGES = {"free": "FFFF", "simply-supported": "SSSS", "clamped": "CCCC"}


@clear_construction
@dataclass(frozen=True)
class Plate:
    """A plate of one material: a rectangle, or the area within an outline.

    Parameters: length_m, width_m, thickness_m > 0 [m]; material : a Material, or its name in the table; boundary :
    "free", "simply-supported", "clamped", or four letters F, S, C for the edges x=0, x=length, y=0, y=width;
    object_mass_kg : mass of the whole object [kg], used where it moves as a whole, None for the plate's mass;
    mass_is_estimate : True if no scene or person gave the mass, so that it limits the thickness less; feet : material
    of the feet on which the object stands, None for its own; outline : outline of a plate that
    is not a rectangle, within length and width, with free edges; None for the rectangle. `MassSpringDamper` and
    `AutoFidelity` follow it, `ModalPlate` raises an error, and other models ignore edges.
    Raises: ModelDomainError: a dimension is not positive and finite, the boundary is not one of these, or an edge of a
    plate with an outline is not free.
    """

    length_m: float
    width_m: float
    thickness_m: float
    material: Material
    boundary: str = "free"
    object_mass_kg: float | None = None
    feet: Material | None = None
    outline: Outline | None = None
    mass_is_estimate: bool = False

    if TYPE_CHECKING:

        def __init__(
            self,
            length_m: float,
            width_m: float,
            thickness_m: float,
            material: Material | str,
            boundary: str = "free",
            object_mass_kg: float | None = None,
            feet: Material | None = None,
            outline: Outline | None = None,
            mass_is_estimate: bool = False,
        ) -> None: ...

    def __post_init__(self) -> None:
        if isinstance(self.material, str):
            object.__setattr__(self, "material", lookup(self.material))
        if not isinstance(self.material, Material):
            raise ModelDomainError(
                f"material is {checks.described(self.material)}; it must be a Material or a name in the table."
            )
        hint = "A mesh without thickness needs an estimated one (ObjectHaptics.estimated_size_m)."
        for name in ("length_m", "width_m", "thickness_m"):
            value = checks.number(
                name, getattr(self, name), "m", above=0.0, **_SIZES_M, error=ModelDomainError, hint=hint
            )
            object.__setattr__(self, name, value)
        if self.feet is not None and not isinstance(self.feet, Material):
            raise ModelDomainError(f"feet is {checks.described(self.feet)}; it must be a Material or None.")
        if self.object_mass_kg is not None:
            mass = checks.number("object_mass_kg", self.object_mass_kg, "kg", above=0.0, error=ModelDomainError)
            object.__setattr__(self, "object_mass_kg", mass)
        if not isinstance(self.boundary, str) or len(self.edges) != 4 or set(self.edges) - set("FSC"):
            raise ModelDomainError(
                f"boundary is {checks.represented(self.boundary)}; it must be one of {', '.join(map(repr, _EDGES))}, "
                "or four letters F, S, C for the edges x=0, x=length, y=0, y=width."
            )
        if self.outline is None:
            return
        if not isinstance(self.outline, Outline):
            raise ModelDomainError(
                f"outline is {checks.described(self.outline)}; it must be an Outline of rings of corners, or None."
            )
        if self.edges != "FFFF":
            raise ModelDomainError(
                f'boundary is {self.boundary!r}; a plate with an outline has free edges, boundary="free".'
            )
        x0, y0, x1, y1 = self.outline.box_m
        length, width = 1e-6 * self.length_m, 1e-6 * self.width_m
        if x0 < -length or y0 < -width or x1 > self.length_m + length or y1 > self.width_m + width:
            raise ModelDomainError(
                f"the outline reaches from ({x0:g}, {y0:g}) to ({x1:g}, {y1:g}) m; it must be within the plate's "
                f"(0, 0) to ({self.length_m:g}, {self.width_m:g}) m. Plate.of_outline takes these from it."
            )

    @classmethod
    def of_outline(cls, outline: Outline, thickness_m: float, material: Material, **others: Any) -> Plate:
        """Make the plate of an outline; its corner is that of the outline's box. Other parameters: see `Plate`.

        The outline is shifted so that its box starts at (0, 0): points on the plate are measured from there.
        """
        x0, y0, _, _ = outline.box_m
        length, width = outline.extent_m
        return cls(length, width, thickness_m, material, outline=outline.placed((1.0, 1.0), (-x0, -y0)), **others)

    @property
    def edges(self) -> str:
        """Four letters F, S, C for the edges x=0, x=length, y=0, y=width."""
        return _EDGES.get(self.boundary, self.boundary)

    @property
    def extent_m(self) -> tuple[float, float]:
        """Length and width of the plate, or of the box around its outline [m]."""
        return (self.length_m, self.width_m) if self.outline is None else self.outline.extent_m

    @property
    def area_m2(self) -> float:
        """Area [m2]."""
        return self.length_m * self.width_m if self.outline is None else self.outline.area_m2

    @property
    def mass_kg(self) -> float:
        """Mass of the plate alone [kg]."""
        return self.area_m2 * self.thickness_m * self.material.density_kg_m3

    @property
    def moving_mass_kg(self) -> float:
        """Mass of the whole object [kg], used where it moves as a whole."""
        return self.mass_kg if self.object_mass_kg is None else self.object_mass_kg

    @cached_property
    def bending_stiffness_nm(self) -> float:
        """D = E h^3 / (12 (1 - nu^2)) [N m].

        Source: Jingu, AliAbbasi et al., Scene2Hap, CHI 2026, third equation of the propagation model.
        """
        E, nu, h = self.material.youngs_modulus_pa, self.material.poisson_ratio, self.thickness_m
        return E * h**3 / (12 * (1 - nu**2))

    @cached_property
    def wavenumber_per_root_omega(self) -> float:
        """c in k = c sqrt(omega) [rad/m (rad/s)^-1/2]: the wavenumber's dependence on the plate."""
        rho, h = self.material.density_kg_m3, self.thickness_m
        return math.sqrt(math.sqrt(rho * h / self.bending_stiffness_nm))

    @overload
    def wavenumber_rad_m(self, frequency_hz: float) -> float: ...
    @overload
    def wavenumber_rad_m(self, frequency_hz: ArrayLike) -> NDArray[np.float64]: ...
    def wavenumber_rad_m(self, frequency_hz: ArrayLike) -> float | NDArray[np.float64]:
        """Return the wavenumber of free bending waves, k^4 = rho h omega^2 / D [rad/m].

        Parameters: frequency_hz : of any shape, 0..1e9 [Hz]; the wavenumbers have the same shape.
        Raises: ModelDomainError: a frequency out of bounds.

        Source: Scene2Hap, CHI 2026, second equation of the propagation model.
        """
        f = floats("frequency_hz", frequency_hz, "Hz", error=ModelDomainError)
        require_frequencies("frequency_hz", f)
        k: NDArray[np.float64] = self.wavenumber_per_root_omega * np.sqrt(2 * math.pi * f)
        return k

    def frequency_hz(self, wavenumber_rad_m: float) -> float:
        """Return the frequency at which free bending waves have a wavenumber [rad/m], the inverse of
        `wavenumber_rad_m`."""
        return (wavenumber_rad_m / self.wavenumber_per_root_omega) ** 2 / (2 * math.pi)


def require_frequencies(name: str, frequencies_hz: NDArray[np.float64]) -> None:
    """Raise a ModelDomainError unless all frequencies are 0 to `MAX_FREQUENCY_HZ` [Hz]."""
    is_good = (frequencies_hz >= 0) & (frequencies_hz <= MAX_FREQUENCY_HZ)
    if not is_good.all():
        first = frequencies_hz[~is_good][0]
        raise ModelDomainError(f"{name} holds {first:g} Hz; it must be 0 to {MAX_FREQUENCY_HZ:g} [Hz].")


def require_plate(plate: object) -> None:
    """Raise a ModelDomainError unless this is a plate."""
    if not isinstance(plate, Plate):
        raise ModelDomainError(
            f"plate is {checks.described(plate)}; it must be a Plate(length_m, width_m, thickness_m, material)."
        )


@clear_construction
@dataclass(frozen=True)
class RigidBody:
    """A compact body, such as a mug, that moves as a whole and does not bend.

    Parameters: mass_kg > 0 [kg]; size_m : length, width, thickness [m], 1e-30..1e6, of a box with the body's inertia in
    rocking, None for a body that does not rock; material : material of its contact surface, None if unknown.
    Raises: ModelDomainError: a mass that is not positive and finite, or a size out of bounds.
    """

    mass_kg: float
    size_m: tuple[float, float, float] | None = None
    material: Material | None = None

    if TYPE_CHECKING:

        def __init__(
            self, mass_kg: float, size_m: Iterable[float] | None = None, material: Material | None = None
        ) -> None: ...

    def __post_init__(self) -> None:
        mass = checks.number("mass_kg", self.mass_kg, "kg", above=0.0, error=ModelDomainError)
        object.__setattr__(self, "mass_kg", mass)
        if self.size_m is not None:
            hint = "None is a body that does not rock."
            size = checks.vector("size_m", self.size_m, "m", size=3, above=0.0, error=ModelDomainError, hint=hint)
            for i, side in enumerate(size):
                checks.number(f"size_m[{i}]", side, "m", **_SIZES_M, error=ModelDomainError, hint=hint)
            object.__setattr__(self, "size_m", size)

    @property
    def moving_mass_kg(self) -> float:
        """Mass [kg]; see `Plate.moving_mass_kg`."""
        return self.mass_kg
