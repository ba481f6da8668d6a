"""Plain data of design time and play time: states, haptics of an object, actuators, bands."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from scene2hap.common import checks
from scene2hap.common.calls import clear_construction
from scene2hap.contact_needs import is_unknown as is_unknown, stated, unmet
from scene2hap.errors import ConfigError, Scene2HapError
from scene2hap.materials import Material

LONGEST_PASSAGE_S, LONGEST_TURN_S = 30.0, 86_400.0
"""Bounds of a state's times [s]: slower starts and stops cannot be felt, and no machine cools for a day."""


@clear_construction
@dataclass(frozen=True)
class SourceState:
    """One way in which an object vibrates, such as "on", "ringing" or "boiling".

    Parameters:
    name : name of the state, unique within its object.
    intensity : strength of the vibration at the object itself, above 0, up to 1 [-]: 1 is a washing machine at full
        spin, 0.5 a ringing phone on the palm, 0.1 a refrigerator's hum.
    sentence : at most 15 words that begin with the category; used to generate sounds.
    keywords : "category verb"; used to search for sounds.
    needs_contact : the object that it must touch to vibrate (a pan on a stove), as an id or in everyday words, which
        are matched by meaning (`scene2hap.contact_needs`). None, "", "none" and "null" mean no condition.
    start_up_s, wind_down_s : times from switching on to full strength, and from switching off to silence, 0..30 [s].
    spins : True if its pitch rises and falls at start and stop, like a motor's; otherwise only its strength changes.
    on_s, off_s : on-time and off-time of its cycle, as with a thermostat, 0.1..86400 [s]. None, None : it runs as long
        as it is switched on.
    """

    name: str
    intensity: float
    sentence: str
    keywords: str
    needs_contact: str | None = None
    start_up_s: float = 0.0
    wind_down_s: float = 0.0
    spins: bool = False
    on_s: float | None = None
    off_s: float | None = None

    def __post_init__(self) -> None:
        for name in ("start_up_s", "wind_down_s"):
            time_s = checks.number(
                name, getattr(self, name), "s", at_least=0.0, at_most=LONGEST_PASSAGE_S, error=ConfigError
            )
            object.__setattr__(self, name, time_s)
        checks.flag("spins", self.spins, error=ConfigError)
        if (self.on_s is None) != (self.off_s is None):
            raise ConfigError(
                f"on_s is {self.on_s} and off_s is {self.off_s} of state {self.name!r}; give both, or neither."
            )
        for name in ("on_s", "off_s") if self.on_s is not None else ():
            time_s = checks.number(
                name, getattr(self, name), "s", at_least=0.1, at_most=LONGEST_TURN_S, error=ConfigError
            )
            object.__setattr__(self, name, time_s)
        intensity = checks.number("intensity", self.intensity, "-", above=0.0, at_most=1.0, error=ConfigError)
        object.__setattr__(self, "intensity", intensity)
        for name in ("name", "sentence", "keywords"):
            checks.text(name, getattr(self, name), error=ConfigError)
        if self.needs_contact is not None:
            checks.text("needs_contact", self.needs_contact, error=ConfigError)
        object.__setattr__(self, "needs_contact", stated(self.needs_contact))


def unmet_needs(object_id: str, states: Sequence[SourceState], categories: Mapping[str, str]) -> tuple[str, ...]:
    """Return a sentence for each state of an object that needs a contact which no object in the scene can provide.

    `categories` has the category of each object of the scene by id; "" or "unknown" if unknown.
    """
    return tuple(
        f"state {state.name!r} needs contact with {state.needs_contact!r}, which no other object here is; "
        "it is silent until such an object is added"
        for state in states
        if state.needs_contact is not None and unmet(state.needs_contact, categories, object_id)
    )


@clear_construction
@dataclass(frozen=True)
class ObjectHaptics:
    """Inferred properties of one object.

    `estimated_size_m` is length, width and thickness of the dominant surface [m], corrected if the mesh is implausible.
    `material` is None if unknown; vibration then does not spread through the object. `mass_kg` is the mass of the whole
    object [kg], None if unknown; it decides the force of a source and the motion of compact bodies. `feet` is the
    material of its feet, such as rubber; None if it is `material` or unknown.
    `confidence` is 0..1. `reasons` explain category, size and vibration. `provenance` names the backend, the model and
    the prompt version of the answer, by component.
    """

    object_category: str
    material_category: str
    material: Material | None
    estimated_size_m: tuple[float, float, float]
    usage: str
    vibrates: bool
    states: tuple[SourceState, ...] = ()
    confidence: float = 1.0
    # Not shown: their paragraphs hide the other fields of an object at the prompt, and of a whole bundle even more.
    reasons: Mapping[str, str] = field(default_factory=dict, repr=False)
    provenance: Mapping[str, str] = field(default_factory=dict, repr=False)
    mass_kg: float | None = None
    feet: Material | None = None

    if TYPE_CHECKING:

        def __init__(
            self,
            object_category: str,
            material_category: str,
            material: Material | None,
            estimated_size_m: Iterable[float],
            usage: str,
            vibrates: bool,
            states: Iterable[SourceState] = (),
            confidence: float = 1.0,
            reasons: Mapping[str, str] = ...,
            provenance: Mapping[str, str] = ...,
            mass_kg: float | None = None,
            feet: Material | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        for name in ("object_category", "material_category", "usage"):
            checks.text(name, getattr(self, name), error=ConfigError)
        size = checks.vector("estimated_size_m", self.estimated_size_m, "m", size=3, at_least=0.0, error=ConfigError)
        if self.material is not None and size[2] <= 0.0:
            raise ConfigError(
                f"estimated_size_m of {self.object_category!r} is {list(size)} m; the thickness must be above 0 [m], "
                "or nothing spreads through it. Give the thickness that a real one has."
            )
        object.__setattr__(self, "estimated_size_m", size)
        if self.feet is not None and not isinstance(self.feet, Material):
            raise ConfigError(f"feet is {checks.represented(self.feet)}; it must be a Material or None.")
        if self.mass_kg is not None:
            object.__setattr__(self, "mass_kg", checked_mass_kg(self.mass_kg, ConfigError))
        confidence = checks.number("confidence", self.confidence, "-", at_least=0.0, at_most=1.0, error=ConfigError)
        object.__setattr__(self, "confidence", confidence)
        wanted = "a list, as [SourceState('on', 0.5, 'fan humming', 'fan humming')]"
        object.__setattr__(
            self, "states", checks.instances("states", self.states, SourceState, wanted, error=ConfigError)
        )
        if self.vibrates and not self.states:
            raise ConfigError(f"{self.object_category!r} vibrates but has no state; give it at least one SourceState.")


LEAST_MASS_KG, MOST_MASS_KG = 1e-6, 1e7
"""Bounds on a mass: a grain of sand, and a loaded train."""


def checked_mass_kg(mass_kg: object, error: type[Scene2HapError]) -> float:
    """Check the mass of an object, and return it [kg]. Raises: error: it is out of bounds."""
    return checks.number("mass_kg", mass_kg, "kg", at_least=LEAST_MASS_KG, at_most=MOST_MASS_KG, error=error)


@clear_construction
@dataclass(frozen=True)
class VibrationDescription:
    """The request to a sound source: one state of one object.

    A synthesizer uses `size_m` [m] and `material` to shape the sound; `seed` makes its output repeatable. `own_word` is
    the author's word for the object, as "windmill" of a turbine, or ""; sources that search by name prefer it. `name`
    is the object's whole name if a source has a sound of this name (`audio.protocol.NamedSounds`), else "".
    """

    object_category: str
    state: str
    sentence: str
    keywords: str
    intensity: float
    size_m: tuple[float, float, float]
    material: str = ""
    seed: int = 0
    own_word: str = ""
    name: str = ""

    def __post_init__(self) -> None:
        for name in ("object_category", "state", "sentence", "keywords", "material", "own_word", "name"):
            checks.text(name, getattr(self, name), error=ConfigError)
        checks.seed(self.seed)


_HERTZ = "It is in Hz, not in kHz."


@clear_construction
@dataclass(frozen=True)
class ActuatorProfile:
    """Properties of an actuator: name, usable band and resonance [Hz], response, and limits.

    `q` is the quality factor of the resonance [-]; None, or no resonance, means a flat response. `response_db` is a
    measured response as points (frequency [Hz], level [dB]) in rising order of frequency; it replaces the resonance.
    `audio.actuators` converts either into a curve and its inverse. Its limits are `max_amplitude`, the largest sample,
    0..1 [-], and `max_rms` [-] over any window of `rms_window_s`, the time over which it warms up [s].
    Raises: ConfigError: a limit that the safety layer cannot keep, or invalid points.
    """

    name: str = "flat"
    min_frequency_hz: float = 10.0
    max_frequency_hz: float = 1000.0
    resonance_hz: float | None = None
    q: float | None = None
    response_db: tuple[tuple[float, float], ...] = ()
    max_amplitude: float = 1.0
    max_rms: float = 1.0
    rms_window_s: float = 1.0

    if TYPE_CHECKING:

        def __init__(
            self,
            name: str = "flat",
            min_frequency_hz: float = 10.0,
            max_frequency_hz: float = 1000.0,
            resonance_hz: float | None = None,
            q: float | None = None,
            response_db: Iterable[Iterable[float]] = (),
            max_amplitude: float = 1.0,
            max_rms: float = 1.0,
            rms_window_s: float = 1.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        checks.text("name", self.name, error=ConfigError)
        points = tuple(
            self._point(i, point)
            for i, point in enumerate(checks.items("response_db", self.response_db, at_most=100_000, error=ConfigError))
        )
        if len(points) == 1:
            raise ConfigError("response_db has one point; it must be at least two points with rising frequencies.")
        for (one, _), (other, _) in pairwise(points):
            if one >= other:
                raise ConfigError(
                    f"response_db has {other:g} Hz after {one:g} Hz; its points must have rising frequencies."
                )
        peak = checks.number("max_amplitude", self.max_amplitude, "-", above=0.0, at_most=1.0, error=ConfigError)
        checks.number("max_rms", self.max_rms, "-", at_least=0.02 * peak, at_most=1.0, error=ConfigError)
        checks.number("rms_window_s", self.rms_window_s, "s", at_least=0.1, at_most=3600.0, error=ConfigError)
        checks.number("max_frequency_hz", self.max_frequency_hz, "Hz", at_least=20.0, error=ConfigError, hint=_HERTZ)
        low = checks.number("min_frequency_hz", self.min_frequency_hz, "Hz", above=0.0, error=ConfigError)
        checks.number("max_frequency_hz", self.max_frequency_hz, "Hz", above=low, error=ConfigError)
        if self.resonance_hz is not None:
            checks.number("resonance_hz", self.resonance_hz, "Hz", at_least=1.0, error=ConfigError, hint=_HERTZ)
        if self.q is not None:
            checks.number("q", self.q, "-", above=0.0, error=ConfigError)
        object.__setattr__(self, "response_db", points)

    @staticmethod
    def _point(index: int, point: Sequence[float]) -> tuple[float, float]:
        frequency, level = checks.vector(f"response_db[{index}]", point, "-", size=2, error=ConfigError)
        checks.number(f"response_db[{index}][0]", frequency, "Hz", above=0.0, error=ConfigError)
        return frequency, level


@clear_construction
@dataclass(frozen=True)
class Bands:
    """The frequency bands of the gains.

    They are either true bands between neighbouring edges [Hz], or `Bands.dominant()`: one band for each source, around
    its own dominant frequency.

    Parameters: octaves : 0..2, width of the band of `Bands.dominant()` [octaves]; at 0 the frequency itself, as in the
    paper.
    Raises: ConfigError: edges that do not rise; a width out of bounds, or together with edges.
    """

    edges_hz: tuple[float, ...]
    kind: Literal["edges", "dominant"] = "edges"
    octaves: float = 0.0

    if TYPE_CHECKING:

        def __init__(
            self,
            edges_hz: Iterable[float],
            kind: Literal["edges", "dominant"] = "edges",
            octaves: float = 0.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        octaves = checks.number("octaves", self.octaves, "octaves", at_least=0.0, at_most=2.0, error=ConfigError)
        object.__setattr__(self, "octaves", octaves)
        if octaves and self.kind != "dominant":
            raise ConfigError(f"octaves is {octaves:g} beside edges_hz; only Bands.dominant(octaves=...) takes it.")
        if self.kind == "dominant":
            object.__setattr__(self, "edges_hz", ())
            return
        edges = tuple(
            checks.number(f"edges_hz[{i}]", edge, "Hz", above=0.0, error=ConfigError)
            for i, edge in enumerate(checks.items("edges_hz", self.edges_hz, error=ConfigError))
        )
        if len(edges) < 2 or any(low >= high for low, high in pairwise(edges)):
            raise ConfigError(f"edges_hz is {list(edges)}; it must be at least two rising frequencies [Hz].")
        object.__setattr__(self, "edges_hz", edges)

    @classmethod
    def dominant(cls, octaves: float = 0.0) -> Bands:
        """Make one band for each source: its own dominant frequency, or a width of `octaves` around it.

        At a single frequency, a model that resonates may hit or miss a resonance after a change of material that nobody
        feels. The rms over a third or half of an octave is steadier. A law that is smooth in frequency, such as
        `ExponentialPlate`, uses the frequency itself.
        """
        return cls((), "dominant", octaves)

    def around_hz(self, frequency_hz: float) -> tuple[float, float]:
        """Return the lower and upper edge of a source's band around its dominant frequency [Hz]."""
        half = 2.0 ** (self.octaves / 2)
        return frequency_hz / half, frequency_hz * half

    @classmethod
    def third_octaves(cls, low_hz: float = 10.0, high_hz: float = 1000.0) -> Bands:
        """Make base-ten third octaves with edges from `low_hz` to `high_hz`; 10 to 1000 Hz give 20 bands.

        Source: IEC 61260-1 (2014), section 5: the ratio of neighbouring edges is 10^(1/10).
        """
        low = checks.number("low_hz", low_hz, "Hz", above=0.0, at_least=1e-3, error=ConfigError)
        high = checks.number("high_hz", high_hz, "Hz", above=low, at_most=1e9, error=ConfigError)
        n = max(1, round(10 * math.log10(high / low)))
        return cls(tuple(float(edge) for edge in np.geomspace(low, high, n + 1)))

    @property
    def n_bands(self) -> int:
        """Number of gains per source."""
        return 1 if self.kind == "dominant" else len(self.edges_hz) - 1

    def widths_hz(self) -> NDArray[np.float64]:
        """Return the lower and upper edge of each band (n_bands, 2) [Hz]; empty for `Bands.dominant()`."""
        edges: Sequence[float] = self.edges_hz
        return np.array([edges[:-1], edges[1:]], dtype=np.float64).T.reshape(-1, 2)
