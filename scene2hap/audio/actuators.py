"""The response of an actuator, and its bounded inverse.

A resonant actuator responds as a resonator of one degree of freedom, with 0 dB at its resonance:

    |R(f)| = 1 / sqrt(1 + Q^2 (f / f_0 - f_0 / f)^2)

A measured response (points, or a CSV file) is interpolated over the logarithm of frequency and scaled to a maximum of
0 dB. The inverse is bounded: otherwise frequencies that an actuator hardly renders would use up the head-room.
Symbols: f_0 [Hz] resonance, Q [-] quality factor.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from numpy.typing import ArrayLike

from scene2hap.audio.clip import Samples
from scene2hap.common import checks
from scene2hap.common.arrays import Floats
from scene2hap.common.calls import settings_misfit
from scene2hap.common.csv_tables import csv_reader, with_point
from scene2hap.common.files import read_small_text
from scene2hap.errors import ConfigError, reason_of
from scene2hap.haptics import ActuatorProfile

MAX_BOOST_DB = 12.0
"""Largest gain of the inverse [dB] (assumed: a factor of four in amplitude)."""

ACTUATORS: Mapping[str, ActuatorProfile] = {
    profile.name: profile
    for profile in (
        ActuatorProfile(),
        # Nominal 160 Hz in two independent open builds. No data sheet is available, so Q and band are assumed.
        ActuatorProfile("drake_hf", 40.0, 800.0, 160.0, 3.0),
        # A moving coil on a soft suspension; assumed typical.
        ActuatorProfile("voice_coil", 30.0, 1000.0, 70.0, 0.8),
        # A coin-sized linear resonant actuator; resonance and Q typical of data sheets, assumed.
        ActuatorProfile("lra", 130.0, 230.0, 175.0, 12.0),
    )
}
"""The built-in profiles by name."""


def actuator_profile(spec: object) -> ActuatorProfile:
    """Return a profile from configuration: a name, the path of a CSV file, a mapping of its fields, or an instance.

    Raises: ConfigError: no such name or file, or fields that are out of bounds.
    """
    if isinstance(spec, ActuatorProfile):
        return spec
    if isinstance(spec, Mapping):
        return _from_fields(spec)
    if isinstance(spec, str | Path):
        if str(spec) in ACTUATORS:
            return ACTUATORS[str(spec)]
        if str(spec).lower().endswith(".csv"):
            return read_response_csv(spec)
    near = checks.did_you_mean(spec, ACTUATORS)
    given = checks.represented(spec)
    problem = f"actuator is {given}; it must be one of {', '.join(ACTUATORS)}, or a CSV file of Hz and dB. {near}"
    raise ConfigError(problem.rstrip())


def read_response_csv(path: str | Path) -> ActuatorProfile:
    """Read the profile of a measured actuator: rows of frequency [Hz] and level [dB], with an optional heading.

    Raises: ConfigError: the file cannot be read, or a row is not two finite numbers with rising frequencies.
    """
    path = Path(path)
    try:
        lines = [line for line in read_small_text(path).splitlines() if not line.lstrip().startswith("#")]
        rows = [list(map(with_point, row)) for row in csv_reader("\n".join(lines)) if row]
    except (OSError, ValueError, csv.Error) as cause:
        raise ConfigError(
            f"{path} cannot be read: {reason_of(cause)}. Give a CSV file with columns Hz and dB."
        ) from cause
    if rows and not _is_number(rows[0][0]):
        rows = rows[1:]
    points = tuple(_point(path, row) for row in rows)
    if len(points) < 2:
        raise ConfigError(f"{path} has fewer than two rows of numbers; a response needs at least two.")
    try:
        return ActuatorProfile(path.stem, points[0][0], points[-1][0], response_db=points)
    except ConfigError as cause:
        raise ConfigError(f"{path}: {cause}") from cause


def _point(path: Path, row: list[str]) -> tuple[float, float]:
    try:
        return float(row[0]), float(row[1])
    except (ValueError, IndexError) as cause:
        raise ConfigError(
            f"{path} has a row {checks.represented('; '.join(row))}; every row must be a frequency [Hz] and a level "
            "[dB], separated by a comma, or by a semicolon or a tab if decimals follow a comma."
        ) from cause


def response_db(profile: ActuatorProfile, frequencies_hz: ArrayLike) -> Floats:
    """Return the response of the actuator, in the shape of `frequencies_hz` [dB]; its maximum is 0."""
    f = np.maximum(np.asarray(frequencies_hz, dtype=np.float64), np.finfo(float).tiny)
    if profile.response_db:
        points = np.array(profile.response_db)
        return np.asarray(np.interp(np.log(f), np.log(points[:, 0]), points[:, 1]) - points[:, 1].max())
    if profile.resonance_hz is None or profile.q is None:
        return np.zeros_like(f)
    # Near 0 Hz the response of a resonator goes to 0; a floor keeps its logarithm finite.
    r = np.maximum(f / profile.resonance_hz, 1e-3)
    return np.asarray(-10.0 * np.log10(1.0 + (profile.q * (r - 1.0 / r)) ** 2))


def is_flat(profile: ActuatorProfile) -> bool:
    """Return True if the response is the same at all frequencies, so that no equalization is needed."""
    return not profile.response_db and (profile.resonance_hz is None or profile.q is None)


def inverse_db(profile: ActuatorProfile, frequencies_hz: ArrayLike) -> Floats:
    """Return the gain that compensates the response, 0..`MAX_BOOST_DB` [dB]; 0 outside the actuator's band."""
    f = np.asarray(frequencies_hz, dtype=np.float64)
    usable = (f >= profile.min_frequency_hz) & (f <= profile.max_frequency_hz)
    return np.where(usable, np.minimum(-response_db(profile, f), MAX_BOOST_DB), 0.0)


def equalize_loop(loop_samples: Samples, sample_rate_hz: float, profile: ActuatorProfile) -> Samples:
    """Filter a loop (n_samples,) by the inverse of the actuator, without delay or transient, and without scaling.

    A loop is periodic, so that weighting its Fourier coefficients is exact.
    """
    if is_flat(profile):
        return loop_samples
    spectrum = scipy.fft.rfft(loop_samples.astype(np.float64))
    f = np.fft.rfftfreq(len(loop_samples), 1.0 / sample_rate_hz)
    gain = 10 ** (inverse_db(profile, f) / 20)
    return scipy.fft.irfft(spectrum * gain, len(loop_samples)).astype(np.float32)


def _from_fields(fields: Mapping[str, Any]) -> ActuatorProfile:
    known = dict(fields)
    base = known.pop("kind", None)
    try:
        if base is None:
            return ActuatorProfile(**known)
        profile = actuator_profile(base)
        return ActuatorProfile(**{**vars(profile), **known})
    except TypeError as cause:
        reason = settings_misfit(ActuatorProfile, known) or f"{cause}."
        raise ConfigError(f"actuator does not take {checks.shown(fields)}: {reason}") from cause


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
