"""The paper's law: amplitude falls exponentially with distance, at the rate of the bending wavenumber.

    Gamma(R) = exp(-k |R - R0|)         k^4 = rho h omega^2 / D         D = E h^3 / (12 (1 - nu^2))

The law is a style, legible rather than physical: exp(-k r) is only the evanescent near field of a driven plate, while
the travelling wave decays far more slowly. Participants of the paper's second study preferred it to no propagation and
to full propagation, so it is the default.

Source: Jingu, AliAbbasi et al., Scene2Hap, CHI 2026, section "Vibration Propagation and Attenuation".
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.common.calls import clear_construction
from scene2hap.errors import ConfigError
from scene2hap.haptics import Bands
from scene2hap.propagation.bands.band_rms import BandRms, band_rms
from scene2hap.propagation.domain import THIN_WAVELENGTHS, OutsideDomain, check_choice, check_thin
from scene2hap.propagation.paths.live_law import GammaAt, GammaOver, LiveLaw, LivePaths, floored
from scene2hap.propagation.paths.prepared_paths import Arrivals, arrivals_at, cheapest_arrivals
from scene2hap.propagation.plate import Plate, require_plate
from scene2hap.propagation.points import as_points
from scene2hap.propagation.protocol import Body, ContactNetwork, Excitation, require_hops, require_input
from scene2hap.scene.objects import Contact

if TYPE_CHECKING:
    from scene2hap.contact.graph import ContactGraph

REFERENCE_HZ = 250.0
"""Frequency at which the loss of a contact of weight w is exactly w; elsewhere it follows the law like any distance."""


@clear_construction
@dataclass(frozen=True)
class ExponentialPlate:
    """The paper's law, the default model: amplitude falls exponentially with distance, over any number of objects.

    Parameters:
    frequency : dominant frequency of a source under `Bands.dominant()`: "tactile", the peak after conversion, at which
        the hand feels it; or "raw", the peak of the audio file, as in the paper.
    max_hops : contacts that vibration may cross, None for any number; 1 (phone to desk) is the paper's reach.
    interface_loss_db : loss of a contact at 250 Hz, >= 0 [dB]; at other frequencies it follows the law like any
        distance. 0, the default, is the paper's.
    floor_db : lower bound of the level wherever a source arrives at all, <= 0 [dB]; None for the law without a bound.
        The law silences a thin sheet of metal within 10 cm; with a bound the sheet is felt.
    outside_domain : "warn" once per object, "raise" or "ignore" where the wavelength is below six thicknesses
        (`domain.THIN_WAVELENGTHS`). The law is a style that suits any object, so the default is "ignore".
    Raises: ConfigError: a setting out of bounds.
    """

    frequency: Literal["tactile", "raw"] = "tactile"
    max_hops: int | None = None
    interface_loss_db: float = 0.0
    floor_db: float | None = None
    outside_domain: OutsideDomain = "ignore"
    kind: Literal["exponential_plate"] = "exponential_plate"
    least_wavelength_in_thicknesses: ClassVar[float] = THIN_WAVELENGTHS

    def __post_init__(self) -> None:
        if self.frequency not in ("tactile", "raw"):
            raise ConfigError(f"frequency is {self.frequency!r}; it must be 'tactile' or 'raw'.")
        require_hops(self.max_hops)
        checks.number("interface_loss_db", self.interface_loss_db, "dB", at_least=0.0, error=ConfigError)
        if self.floor_db is not None:
            checks.number("floor_db", self.floor_db, "dB", at_most=0.0, error=ConfigError, hint="None is no floor.")
        if self.outside_domain != "ignore":
            check_choice(self.outside_domain)

    def plate_transfer(
        self, plate: Plate, drive_m: ArrayLike, points_m: ArrayLike, frequencies_hz: ArrayLike
    ) -> NDArray[np.complex128]:
        """Return the amplitude at points of one plate over that at the driven point: Gamma, real and positive.

        Parameters: drive_m : (2,) [m]; points_m : (n_points, 2) [m], from the plate's corner along length and width;
        frequencies_hz : (n_frequencies,) [Hz], >= 0.
        Returns: (n_points, n_frequencies) complex128 [-], in [0, 1].
        """
        require_plate(plate)
        offsets = as_points(points_m, 2) - as_points(drive_m, 2)
        distance = np.hypot(offsets[:, 0], offsets[:, 1])
        k = np.atleast_1d(plate.wavenumber_rad_m(frequencies_hz))
        gamma: NDArray[np.complex128] = np.exp(-np.outer(distance, k)).astype(np.complex128)
        return gamma

    def prepare(self, network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands) -> PreparedLaw:
        """Prepare the field of a scene: the cheapest path from every source to every object.

        Since k = c sqrt(omega) on every plate, the cheapest path is the same at all frequencies, and one search per
        source serves all bands. A rigid body passes vibration on undiminished.

        Raises: ModelDomainError, warns: ThinPlateWarning, for an object outside the domain, if so configured.
        """
        require_input(network, excitations, bands)
        costs = PathCosts.of(self, network.bodies, network.contacts)
        source_ids = tuple(excitation.source_id for excitation in excitations)
        arrivals = cheapest_arrivals(costs.cost_per_m, network.contacts, costs.crossing_cost, source_ids, self.max_hops)
        return self.over(arrivals, network, excitations, bands)

    def over(
        self, arrivals: Mapping[str, Arrivals], network: ContactNetwork, excitations: Sequence[Excitation], bands: Bands
    ) -> PreparedLaw:
        """Return the field of a scene whose paths from the sources, in the order of `excitations`, are known.

        Raises, warns: see `prepare`.
        """
        cost_per_m = self._costs_per_m(network.bodies, excitations, bands)
        source_ids = tuple(excitation.source_id for excitation in excitations)
        gamma: Callable[[Floats], Floats]
        if bands.kind == "dominant":
            gamma = self._gamma_at(excitations)
        else:
            gamma = partial(band_rms, edges_hz=bands.widths_hz())
        return PreparedLaw(source_ids, arrivals, cost_per_m, gamma, self._floor)

    def live(
        self, graph: ContactGraph, bodies: Mapping[str, Body], excitations: Sequence[Excitation], bands: Bands
    ) -> LiveLaw:
        """Return the law's field over a contact graph that changes between queries; see `LiveModel`.

        Raises, warns: see `prepare`; for all bodies at once.
        """
        source_ids = tuple(excitation.source_id for excitation in excitations)
        costs_per_m = self._costs_per_m(bodies, excitations, bands)
        paths = LivePaths(graph, costs_per_m, self.crossing_cost, source_ids, self.max_hops)
        is_dominant = bands.kind == "dominant"
        gamma = self._gamma_at(excitations) if is_dominant else GammaOver(BandRms(bands.edges_hz))
        return LiveLaw(paths, source_ids, gamma, self._floor)

    def _costs_per_m(
        self, bodies: Mapping[str, Body], excitations: Sequence[Excitation], bands: Bands
    ) -> dict[str, float]:
        """Return the cost of a metre through each body, after checking that thin-plate theory holds for it."""
        if self.outside_domain != "ignore":
            top_hz = max(bands.edges_hz, default=max((self.frequency_hz(item) for item in excitations), default=0.0))
            for object_id, body in bodies.items():
                if isinstance(body, Plate):
                    check_thin(body, top_hz, self.outside_domain, object_id)
        return {object_id: cost_per_m(body) for object_id, body in bodies.items()}

    def crossing_cost(self, weight: float) -> float:
        """Return the cost of crossing a contact of a weight (0..1), beside `cost_per_m` [s^(1/2)]; infinite at 0."""
        loss = self.interface_loss_db * math.log(10) / 20
        return (loss - math.log(weight)) / math.sqrt(2 * math.pi * REFERENCE_HZ) if weight > 0 else math.inf

    def _gamma_at(self, excitations: Sequence[Excitation]) -> GammaAt:
        return GammaAt(np.array([self.frequency_hz(item) for item in excitations]))

    @property
    def _floor(self) -> float:
        return 0.0 if self.floor_db is None else 10 ** (self.floor_db / 20)

    def frequency_hz(self, excitation: Excitation) -> float:
        """Return the frequency [Hz] at which the law is evaluated for a source under `Bands.dominant()`."""
        return excitation.frequency_raw_hz if self.frequency == "raw" else excitation.frequency_tactile_hz


def cost_per_m(body: Body) -> float:
    """Return the cost of a metre through a body, k / sqrt(omega) [s^(1/2)/m]; 0 for a rigid body."""
    return body.wavenumber_per_root_omega if isinstance(body, Plate) else 0.0


class PathCosts(NamedTuple):
    """The paper's law as costs for a search of paths; see `cheapest_arrivals`."""

    cost_per_m: dict[str, float]
    crossing_cost: list[float]
    max_hops: int | None

    @classmethod
    def of(cls, model: object, bodies: Mapping[str, Body], contacts: Sequence[Contact]) -> PathCosts:
        """The costs of `model` if it is an `ExponentialPlate`; those of the default one for other models."""
        law = model if isinstance(model, ExponentialPlate) else ExponentialPlate()
        costs_per_m = {object_id: cost_per_m(body) for object_id, body in bodies.items()}
        return cls(costs_per_m, [law.crossing_cost(contact.weight) for contact in contacts], law.max_hops)


@dataclass(frozen=True, eq=False)
class PreparedLaw:
    """A prepared field whose gains depend on the cost of the cheapest path alone, as those of the paper's law.

    arrivals : of the sources at each object; gamma : attenuation (n_points, n_sources, n_bands) [-] at path costs
    (n_points, n_sources); floor : least attenuation wherever a source arrives at all [-].
    """

    source_ids: tuple[str, ...]
    arrivals: Mapping[str, Arrivals]
    cost_per_m: Mapping[str, float]
    gamma: Callable[[Floats], Floats]
    floor: float = 0.0

    def attenuation(self, object_id: str, points_m: ArrayLike) -> Floats:
        """Gains at points of one object; see `PropagationField`."""
        costs = arrivals_at(self.arrivals, self.cost_per_m, self.source_ids, object_id, points_m)
        return floored(self.gamma(costs), costs, self.floor)
