"""Voices of oscillating machines: magnets, vibration motors, blades, pistons.

Levels are RMS, relative to the strongest part of the voice; levels, slopes and random variations are tuned, frequencies
are those of real devices.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from scene2hap.audio.sources.synth.rotating import fan
from scene2hap.audio.sources.synth.signals import (
    DURATION_S,
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


def mains_hum(take: Take) -> Floats:
    """Magnets and cores on the mains: the force on iron follows the square of the field, hence twice its frequency."""
    phi = phase(2.0 * take.mains_hz)
    hum = partials(phi, take.roll_off(8), take.rng)
    leak = np.cos(2.0 * np.pi * take.mains_hz * times())
    return (
        unit_rms(hum) * (1.0 + 0.15 * wander(take.rng, 3.0))
        + 0.1 * unit_rms(leak)
        + (0.05 + 0.06 * take.drive) * noise(take.rng, 60.0, 1500.0, -1.5)
    )


def microwave(take: Take) -> Floats:
    """A microwave oven: its transformer, the fan that cools it, and a turntable and a stirrer that load both."""
    cooling = fan(take, shaft_hz=44.0, blades=5, rotor=0.4, blade=0.5, flow=0.5)
    # A stirrer turns in the field and loads the magnetron; the load depends on the oven's content.
    stirrer = 1.0 + 0.27 * np.cos(phase(take.about(1.6) * (1.0 + 0.02 * wander(take.rng))))
    turntable = 1.0 + 0.03 * np.cos(2.0 * np.pi * 0.1 * times() + take.rng.uniform(0.0, 2.0 * np.pi))
    return (unit_rms(mains_hum(take)) + 0.5 * unit_rms(cooling)) * turntable * stirrer


def vibration_motor(take: Take, *, motor_hz: float = 182.0) -> Floats:
    """An eccentric mass on a small motor: nearly a sine; its speed wavers as the hand or table under it yields."""
    phi = phase(take.speed_hz(motor_hz) * (1.0 + 0.004 * wander(take.rng, 4.0)))
    return partials(phi, [1.0, 0.1 + 0.15 * take.drive, 0.06], take.rng) * (
        1.0 + 0.06 * wander(take.rng, 5.0)
    ) + 0.03 * noise(take.rng, 100.0, 2000.0, -3.0)


def ringing_motor(
    take: Take,
    *,
    motor_hz: float = 182.0,
    on_s: float = 1.0,
    off_s: float = 0.5,
    spin_up_s: float = 0.05,
    spin_down_s: float = 0.08,
) -> Floats:
    """A vibration motor that is switched on and off, so that its speed and its force rise and fall.

    A small DC motor follows its voltage as w(t) = 1 - exp(-t / spin_up_s), as a share of full speed, and coasts down as
    exp(-t / spin_down_s). The force of an eccentric mass is m r omega^2. Time constants are those of coin motors; the
    pattern is assumed.
    """
    since_s = times() % (on_s + off_s)
    reached = 1.0 - np.exp(-on_s / spin_up_s)
    w = np.where(since_s < on_s, 1.0 - np.exp(-since_s / spin_up_s), reached * np.exp(-(since_s - on_s) / spin_down_s))
    phi = phase(take.speed_hz(motor_hz) * w)
    return np.asarray(partials(phi, [1.0, 0.1 + 0.15 * take.drive, 0.06], take.rng) * w**2)


def reciprocating(
    take: Take, *, stroke_hz: float, rattle: float = 0.1, speed: Callable[[Take, float], float] = Take.shaft_hz
) -> Floats:
    """A reciprocating head, blade or piston, which rattles in its guide at both ends of the stroke.

    `speed` is the law of its drive: any motor, an induction motor (`Take.mains_speed_hz`), or a magnet on the mains
    (`Take.magnet_hz`).
    """
    phi = phase(speed(take, stroke_hz) * (1.0 + 0.002 * wander(take.rng, 2.0)))
    stroke = partials(phi, take.roll_off(8, 0.5), take.rng)
    ends = noise(take.rng, 100.0, 2500.0, -3.0) * np.cos(phi) ** 4
    return unit_rms(stroke) + rattle * (0.5 + take.drive) * unit_rms(ends)


def combustion(
    take: Take, *, firing_hz: float, loud_order: int = 2, revs: float = 0.0, rev_s: float = 2.5, roar: float = 0.0
) -> Floats:
    """A piston engine: irregular firings through an exhaust, and a crankshaft.

    `loud_order` is the multiple of the firing rate at which body and exhaust resonate. For a four-stroke engine of one
    cylinder, order 2 is the speed of the crankshaft. The throttle varies the speed by the share `revs`, once in `rev_s`
    seconds. The strength of firings grows with the square of the speed. `roar` is the level of an open exhaust.
    """
    rate_hz = take.speed_hz(firing_hz)
    n = round(rate_hz * DURATION_S)
    speed, angle = _throttle(take, n, revs, rev_s)
    # A whole number of firings. Without the jitter of one per cent of a cycle, idling would sound like a tone.
    at = np.interp(np.arange(n) + 0.01 * take.rng.standard_normal(n), angle, times())
    strength = 1.0 + 0.1 * np.clip(take.rng.standard_normal(n), -2.0, 2.0)
    strength *= np.interp(at, times(), speed) ** 2
    resonance_hz = loud_order * n / DURATION_S
    # At a high drive, a firing decays faster, so that more of its harmonics are heard.
    exhaust = ringing(at, strength, resonance_hz, (2.0 - 1.6 * take.drive) / resonance_hz)
    crank = partials(2.0 * np.pi * loud_order * angle, take.roll_off(6), take.rng) * speed**2
    intake = noise(take.rng, 60.0, 1500.0, -3.0) * speed**2
    if roar:
        intake = intake + roar * noise(take.rng, 150.0, 1500.0) * speed**2
    return unit_rms(exhaust) + 0.4 * unit_rms(crank) + (0.15 + 0.3 * take.drive) * intake


def _throttle(take: Take, n_firings: int, revs: float, rev_s: float) -> tuple[Floats, Floats]:
    """Return the speed relative to its mean (n,) [-], and the number of firings until each sample (n,) [-]."""
    n_revs = max(1, round(DURATION_S / rev_s))
    turn = 2.0 * np.pi * (n_revs * times() / DURATION_S + take.rng.uniform())
    speed = 1.0 + revs * np.sin(turn + 0.5 * np.sin(turn))
    speed /= speed.mean()
    angle = np.cumsum(speed) - speed[0]
    return speed, angle * (n_firings / (angle[-1] + speed[-1]))
