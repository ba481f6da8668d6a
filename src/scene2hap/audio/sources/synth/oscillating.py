"""Things that hum, swing to and fro, or fire: magnets, vibration motors, blades, pistons.

Levels are RMS, relative to the strongest part of the voice; levels, slopes and wanders are tuned, frequencies are those
of real devices.
"""

from __future__ import annotations

import numpy as np

from scene2hap.audio.sources.synth.rotating import MAINS_HZ, fan
from scene2hap.audio.sources.synth.signals import (
    DURATION_S,
    Signal,
    Take,
    noise,
    partials,
    phase,
    ringing,
    times,
    unit_rms,
    wander,
)


def mains_hum(take: Take) -> Signal:
    """Magnets and cores on the mains: iron is pulled by the square of the field, hence twice its frequency."""
    phi = phase(2.0 * MAINS_HZ)
    hum = partials(phi, take.roll_off(8), take.rng)
    leak = np.cos(2.0 * np.pi * MAINS_HZ * times())
    return (
        unit_rms(hum) * (1.0 + 0.03 * wander(take.rng, 0.5))
        + 0.1 * unit_rms(leak)
        + (0.03 + 0.05 * take.drive) * noise(take.rng, 60.0, 1500.0, -3.0)
    )


def microwave(take: Take) -> Signal:
    """A microwave oven: its transformer, the fan that cools it, and a turntable that loads both six times a minute."""
    cooling = fan(take, shaft_hz=44.0, blades=5, rotor=0.4, blade=0.5, flow=0.5)
    turntable = 1.0 + 0.06 * np.cos(2.0 * np.pi * 0.1 * times() + take.rng.uniform(0.0, 2.0 * np.pi))
    return (unit_rms(mains_hum(take)) + 0.5 * unit_rms(cooling)) * turntable


def vibration_motor(take: Take, *, motor_hz: float = 182.0) -> Signal:
    """An eccentric mass on a small motor: nearly a sine, whose speed wavers as the hand or table under it gives."""
    phi = phase(take.shaft_hz(motor_hz) * (1.0 + 0.004 * wander(take.rng, 4.0)))
    return partials(phi, [1.0, 0.1 + 0.15 * take.drive, 0.06], take.rng) * (
        1.0 + 0.06 * wander(take.rng, 5.0)
    ) + 0.03 * noise(take.rng, 100.0, 2000.0, -3.0)


def reciprocating(take: Take, *, stroke_hz: float, rattle: float = 0.1) -> Signal:
    """A head, blade or piston that goes to and fro, and rattles in its guide at both ends of the stroke."""
    phi = phase(take.shaft_hz(stroke_hz) * (1.0 + 0.002 * wander(take.rng, 2.0)))
    stroke = partials(phi, take.roll_off(8, 0.5), take.rng)
    ends = noise(take.rng, 100.0, 2500.0, -3.0) * np.cos(phi) ** 4
    return unit_rms(stroke) + rattle * (0.5 + take.drive) * unit_rms(ends)


def combustion(take: Take, *, firing_hz: float, loud_order: int = 2) -> Signal:
    """A piston engine: firings that vary from one to the next, through an exhaust, over a crankshaft.

    `loud_order` is the multiple of the firing rate that body and exhaust carry best; for a four-stroke engine of one
    cylinder, order 2 is its crankshaft.
    """
    rate_hz = take.shaft_hz(firing_hz)
    n = round(rate_hz * DURATION_S)
    # A whole number of firings; the jitter of one per cent of a cycle is what keeps an idle from sounding like a tone.
    at = (np.arange(n) + 0.01 * take.rng.standard_normal(n)) / n * DURATION_S
    strength = 1.0 + 0.1 * np.clip(take.rng.standard_normal(n), -2.0, 2.0)
    resonance_hz = loud_order * n / DURATION_S
    exhaust = ringing(at, strength, resonance_hz, 2.5 / resonance_hz)
    crank = partials(phase(resonance_hz), [1.0, 0.3], take.rng)
    intake = noise(take.rng, 60.0, 1500.0, -3.0)
    return unit_rms(exhaust) + 0.4 * unit_rms(crank) + (0.1 + 0.15 * take.drive) * intake
