"""Voices of working machines: gears under load, stepper motors, rotor blades, rolling wheels, jets.

Levels are RMS, relative to the strongest part of the voice; levels, slopes and patterns are tuned, frequencies are
those of real devices.
"""

from __future__ import annotations

import numpy as np

from scene2hap.audio.sources.synth.signals import (
    DURATION_S,
    N_SAMPLES,
    SAMPLE_RATE_HZ,
    Take,
    noise,
    partials,
    phase,
    ringing,
    times,
    unit_rms,
    wander,
)
from scene2hap.common.arrays import Floats


def geared(
    take: Take,
    *,
    motor_hz: float,
    output_hz: float,
    load: float = 0.2,
    rumble: float = 0.2,
    thump_hz: float = 0.0,
    slack: float = 0.05,
    on_mains: bool = False,
) -> Floats:
    """An electric motor that drives slower parts by a gear or a belt: paddles, rollers, chains, drums, needles.

    An induction motor `on_mains` turns at `motor_hz` at a mains frequency of 50 Hz.
    The output loads the motor once per turn, by the share `load`; `rumble` is the level of rolling or sliding parts.
    With a `thump_hz`, a body that rings at that pitch is struck once per turn of the output, give or take the share
    `slack` of a turn.
    """
    speed_hz = take.mains_speed_hz(motor_hz) if on_mains else take.shaft_hz(motor_hz)
    turn = phase(speed_hz * (1.0 + 0.003 * wander(take.rng)))
    output = turn * (output_hz / motor_hz)
    tone = unit_rms(partials(turn, take.roll_off(6), take.rng))
    y = tone * (1.0 + load * np.cos(output))
    y += rumble * (0.6 + 0.8 * take.drive) * noise(take.rng, 40.0, 1500.0, -6.0)
    if thump_hz:
        # A whole number, so that the first strike of a loop follows the last.
        n = max(1, round(output[-1] / (2.0 * np.pi)))
        struck = (np.arange(n) + 0.5 + slack * take.rng.uniform(-1.0, 1.0, n)) / n
        at = np.interp(struck * output[-1], output, times())
        y += 0.3 * unit_rms(ringing(at, take.rng.uniform(0.7, 1.0, n), thump_hz, 3.0 / thump_hz))
    return y


def stepper(take: Take, *, slowest_hz: float = 90.0, fastest_hz: float = 260.0, move_s: float = 0.4) -> Floats:
    """Stepper motors, as in printers: each move has its own speed, and a step is a jerk, hence a tone at the step rate.

    Speeds change within some 20 ms, as controllers ramp them.
    """
    n_moves = int(np.ceil(DURATION_S / move_s)) + 1
    # Speeds are drawn around a middle one, since most moves of a machine are alike.
    low, high = np.log(slowest_hz), np.log(fastest_hz * (0.85 + 0.15 * take.drive))
    speeds = np.exp(take.rng.triangular(low, 0.5 * (low + high), high, n_moves))
    ends = np.cumsum(move_s * take.rng.uniform(0.6, 1.4, n_moves))
    f = speeds[np.minimum(np.searchsorted(ends, times()), n_moves - 1)]
    ramp = np.hanning(round(0.02 * SAMPLE_RATE_HZ))
    padded = np.pad(f, len(ramp) // 2, mode="edge")
    smooth = np.convolve(padded, ramp / ramp.sum(), mode="same")[len(ramp) // 2 :][:N_SAMPLES]
    return unit_rms(partials(phase(smooth), take.roll_off(5), take.rng)) + 0.1 * noise(take.rng, 60.0, 1500.0, -3.0)


def rotor_slap(take: Take, *, rotor_hz: float = 6.4, blades: int = 4, body_hz: float = 63.0) -> Floats:
    """A helicopter: a slap as each blade passes, at blades times rotor speed; one blade runs slightly out of track."""
    rate_hz = blades * take.speed_hz(rotor_hz)
    n = round(rate_hz * DURATION_S / blades) * blades
    at = np.arange(n) / n * DURATION_S
    strength = 1.0 + 0.2 * np.cos(2.0 * np.pi * np.arange(n) / blades)
    slap = ringing(at, strength, body_hz, 2.0 / body_hz)
    turbine = partials(phase(take.about(95.0)), [1.0, 0.3], take.rng)
    return unit_rms(slap) + 0.15 * unit_rms(turbine) + (0.1 + 0.1 * take.drive) * noise(take.rng, 60.0, 1500.0, -3.0)


def rolling(take: Take, *, passing_hz: float = 50.0) -> Floats:
    """Wheels on a track: the rumble of rough surfaces, and a tone of passing supports, at the rate speed / spacing.

    A train at 30 m/s over sleepers 0.6 m apart gives 50 Hz.
    """
    speed_hz = take.speed_hz(passing_hz) * (1.0 + 0.01 * wander(take.rng, 0.5))
    passing = partials(phase(speed_hz), [1.0, 0.4, 0.2], take.rng)
    return (0.6 + 0.8 * take.drive) * noise(take.rng, 40.0, 1500.0, -5.0) + unit_rms(passing)


def jet(take: Take, *, low_hz: float = 50.0, tilt_db: float = -5.0, pump: float = 0.0) -> Floats:
    """Steam, paint or water through a nozzle: turbulent noise that changes by `tilt_db` from octave to octave.

    `pump` is the level of a magnet pump on the mains, which strikes once per cycle, since a diode passes only one half
    wave.
    """
    y = (0.6 + 0.8 * take.drive) * noise(take.rng, low_hz, 4000.0, tilt_db) * (1.0 + 0.05 * wander(take.rng, 2.0))
    return y + pump * unit_rms(partials(phase(take.mains_hz), take.roll_off(5), take.rng)) if pump else y
