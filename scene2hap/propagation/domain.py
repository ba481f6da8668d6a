"""The domain of the thin-plate kernels: valid frequencies, and plates that are thin compared with the wavelength."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene2hap.common.arrays import floats
from scene2hap.common.warning import warn_of
from scene2hap.errors import ConfigError, ModelDomainError
from scene2hap.propagation.plate import Plate, require_frequencies, require_plate

THIN_WAVELENGTHS = 6.0
"""Shortest wavelength for which thin-plate theory is used, in thicknesses. There its frequencies are already 15 % above
those of Mindlin's plate, which includes shear (6.5 % at ten thicknesses). Waves in furniture are longer up to 1 kHz.

Source: the usual engineering rule; Cremer, Heckl, Petersson, Structure-Borne Sound.
"""

_LEAST_HZ = 1e-100
"""Frequency below which k^4 would underflow to 0."""


class ThinPlateWarning(UserWarning):
    """A plate is thick compared with its shortest bending wave, so thin-plate theory makes it too stiff."""


class SlowPlateWarning(UserWarning):
    """Computing the modes of a plate takes more than about a second; they are cached afterwards."""


@lru_cache(maxsize=4096)
def warn_if_slow(plate: Plate, size: int, most: int, what: str) -> None:
    """Issue a `SlowPlateWarning`, once per plate, if `size` exceeds `most`, which takes about a second."""
    if size > most:
        warn_of(
            f"{size} {what} of a plate of {plate.length_m:g} × {plate.width_m:g} × {plate.thickness_m:g} m are worked "
            f"out; more than {most} take over a second. A lower top frequency or InfinitePlate is quicker.",
            SlowPlateWarning,
        )


def as_frequencies(frequencies_hz: ArrayLike, *, positive_because: str = "") -> NDArray[np.float64]:
    """Convert frequencies to (n_frequencies,) float64 [Hz], >= 0; a single one may be a bare number.

    Parameters: positive_because : why 0 Hz is an error; empty if 0 Hz is valid.
    Raises: ModelDomainError: another shape; a frequency below 0 or above 1e9 Hz, or 0 where 0 Hz is an error.
    """
    f = np.atleast_1d(floats("frequencies_hz", frequencies_hz, "Hz", error=ModelDomainError))
    if f.ndim != 1:
        raise ModelDomainError(f"frequencies_hz has shape {f.shape}; it must be (n_frequencies,) [Hz].")
    require_frequencies("frequencies_hz", f)
    if positive_because and (f == 0).any():
        raise ModelDomainError(f"frequencies_hz holds 0 Hz; it must be above 0 [Hz], since {positive_because}.")
    return f


def off_zero(plate: Plate, frequencies_hz: NDArray[np.float64]) -> NDArray[np.float64]:
    """Replace 0 Hz in frequencies (n_frequencies,) by a small one, since a loose plate has a limit there but no value.

    The small frequency is a millionth of the frequency at which k L = 1 on the longer side L. The lowest resonance of a
    held plate is 3.5 times the latter (a cantilever), so the plate's deflection is the static one to 1e-13.
    """
    slow_hz = (plate.wavenumber_per_root_omega * max(plate.extent_m)) ** -2 / (2 * np.pi)
    off: NDArray[np.float64] = np.where(frequencies_hz > 0, np.maximum(frequencies_hz, _LEAST_HZ), 1e-6 * slow_hz)
    return off


def floored_loss(plate: Plate, loss_floor: float) -> float:
    """Return the loss factor of a plate, at least `loss_floor` [-].

    Raises: ModelDomainError: both are 0, since a resonance is then infinite.
    """
    eta = max(plate.material.loss_factor, loss_floor)
    if eta == 0:
        raise ModelDomainError(
            f"material {plate.material.name!r} has a loss factor of 0 and so has loss_floor; a resonance would be "
            "infinite. Give one of them a value above 0; 0.01 suits assembled objects."
        )
    return eta


OutsideDomain = Literal["warn", "raise", "ignore"]
"""Reaction of a model to an object outside its domain."""


def check_choice(outside_domain: str) -> None:
    """Raise a ConfigError unless `outside_domain` is "warn", "raise" or "ignore"."""
    if outside_domain not in get_args(OutsideDomain):
        raise ConfigError(f"outside_domain is {outside_domain!r}; it must be 'warn', 'raise' or 'ignore'.")


def check_thin(plate: Plate, top_hz: float, outside_domain: OutsideDomain = "warn", object_id: str = "") -> None:
    """Warn once per plate and object, or raise, if six thicknesses exceed the wavelength at the top frequency.

    Parameters: object_id : of the plate, empty for a plate alone.
    Raises: ModelDomainError; warns: ThinPlateWarning.
    """
    if outside_domain == "ignore" or top_hz <= _thin_limit_hz(plate):
        return
    whose = f"object {object_id!r}: " if object_id else ""
    if outside_domain == "raise":
        raise ModelDomainError(whose + _too_thick(plate))
    _warn_once(plate, whose)


def warn_if_thick(plate: Plate, frequencies_hz: NDArray[np.float64]) -> None:
    """See `check_thin`, for a plate alone at frequencies (n_frequencies,) [Hz]. Raises: ModelDomainError: no plate."""
    require_plate(plate)
    check_thin(plate, float(frequencies_hz.max(initial=0.0)))


def _thin_limit_hz(plate: Plate) -> float:
    return plate.frequency_hz(2 * math.pi / (THIN_WAVELENGTHS * plate.thickness_m))


@lru_cache(maxsize=4096)
def _warn_once(plate: Plate, whose: str) -> None:
    warn_of(whose + _too_thick(plate), ThinPlateWarning)


def _too_thick(plate: Plate) -> str:
    return (
        f"a plate of {1e3 * plate.thickness_m:g} mm {plate.material.name} is thick beside its bending waves above "
        f"{_thin_limit_hz(plate):.3g} Hz (wavelength below {THIN_WAVELENGTHS:g} thicknesses): its answers there come "
        "from a plate that is too stiff. Keep below that frequency, or treat it as a RigidBody."
    )
