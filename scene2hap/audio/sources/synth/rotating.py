"""Voices of rotating machines: imbalance once per turn, passing blades and vanes, flow, load.

Levels are RMS, relative to the strongest part of the voice. All levels, slopes and random variations are tuned by ear
and by spectrum to plausible machines; frequencies follow from the speeds of real machines.
"""

from __future__ import annotations

import numpy as np

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


def motor(take: Take, *, shaft_hz: float = 48.0) -> Floats:
    """An electric motor: shaft, harmonics, and a weak magnetic pull at twice the mains frequency."""
    phi = phase(take.mains_speed_hz(shaft_hz) * (1.0 + 0.003 * wander(take.rng)))
    shaft = partials(phi, take.roll_off(8), take.rng)
    pull = np.cos(2.0 * np.pi * 2.0 * take.mains_hz * times())
    return (
        unit_rms(shaft) * (1.0 + 0.05 * wander(take.rng, 3.0))
        + 0.25 * unit_rms(pull)
        + (0.1 + 0.1 * take.drive) * noise(take.rng, 40.0, 1500.0, -4.0)
    )


def compressor(take: Take, *, slip: float = 0.018) -> Floats:
    """A refrigerator's piston compressor: a two-pole induction motor, slightly slower than the mains frequency.

    Its second order beats slowly against the magnetic pull at twice the mains frequency. Gas and oil load it unevenly.
    """
    shaft_hz = take.mains_hz * (1.0 - take.about(slip, 0.3))
    phi = phase(shaft_hz * (1.0 + 0.0005 * wander(take.rng, 0.3)))
    strokes = partials(phi, take.roll_off(10), take.rng) * (1.0 + 0.25 * wander(take.rng, 5.0))
    pull = np.cos(2.0 * np.pi * 2.0 * take.mains_hz * times())
    flow = noise(take.rng, 100.0, 2500.0, -3.0) * (1.0 + 0.3 * wander(take.rng, 5.0))
    return unit_rms(strokes) + 0.2 * unit_rms(pull) + (0.2 + 0.25 * take.drive) * flow


def fan(
    take: Take, *, shaft_hz: float, blades: int, rotor: float = 1.0, blade: float = 0.5, flow: float = 0.5
) -> Floats:
    """A fan: rotor imbalance once per turn, blades passing, and the broadband noise of the flow, louder when driven."""
    phi = phase(take.speed_hz(shaft_hz) * (1.0 + 0.003 * wander(take.rng)))
    turns = partials(phi, [1.0, 0.25, 0.11, 0.06], take.rng)
    passing = partials(blades * phi, take.roll_off(4), take.rng)
    breeze = noise(take.rng, 40.0, 3000.0, -3.5) * (1.0 + 0.05 * wander(take.rng, 2.0))
    return rotor * unit_rms(turns) + blade * unit_rms(passing) + flow * (0.6 + 0.6 * take.drive) * breeze


def spinner(take: Take, *, drum_hz: float = 18.5, belt_ratio: float = 11.5) -> Floats:
    """A washing machine at spin: an unbalanced drum, and its motor, which the belt turns `belt_ratio` times as fast.

    The laundry loads the motor once per turn of the drum; the belt revolves about every second turn.
    """
    drum_speed = take.shaft_hz(drum_hz) * (1.0 + 0.003 * wander(take.rng, 0.5))
    drum = phase(drum_speed)
    motor_tone = partials(belt_ratio * drum, take.roll_off(5), take.rng)
    load = 1.0 + 0.25 * np.cos(drum) + 0.1 * np.cos(0.45 * drum) + 0.05 * wander(take.rng)
    return (
        unit_rms(motor_tone) * load
        + (0.4 + 0.3 * take.drive) * unit_rms(partials(drum, [1.0, 0.5, 0.25], take.rng))
        + 0.25 * noise(take.rng, 40.0, 1500.0, -4.0)
    )


def washing(take: Take, *, drum_hz: float = 0.85, slosh: float = 0.5, thump_hz: float = 60.0) -> Floats:
    """A washing machine before it spins: a motor hums at twice the mains frequency, and a drum lifts the laundry.

    The laundry falls once per turn of the drum, on a tub that rings at `thump_hz`; `slosh` is the level of the water.
    """
    hum = partials(phase(2.0 * take.mains_hz), take.roll_off(5, 1.5), take.rng)
    n = max(1, round(take.about(drum_hz) * DURATION_S))
    at = (np.arange(n) + 0.5 + 0.08 * take.rng.uniform(-1.0, 1.0, n)) / n * DURATION_S
    load = 1.0 + 0.2 * np.cos(2.0 * np.pi * n * times() / DURATION_S)
    falls = ringing(at, take.rng.uniform(0.6, 1.0, n), thump_hz, 4.0 / thump_hz)
    water = noise(take.rng, 60.0, 1200.0, -3.0) * load * (1.0 + 0.2 * wander(take.rng, 3.0))
    return unit_rms(hum) * load + 0.35 * unit_rms(falls) + slosh * (0.4 + 0.4 * take.drive) * water


def pump(take: Take, *, shaft_hz: float = 48.0, vanes: int = 6) -> Floats:
    """A centrifugal pump: pressure pulses as its vanes pass the outlet, shaft imbalance, and rushing water."""
    phi = phase(take.mains_speed_hz(shaft_hz) * (1.0 + 0.002 * wander(take.rng)))
    pulses = partials(vanes * phi, take.roll_off(4), take.rng)
    shaft = partials(phi, [1.0, 0.35, 0.2], take.rng)
    return unit_rms(pulses) + 0.5 * unit_rms(shaft) + (0.2 + 0.2 * take.drive) * noise(take.rng, 60.0, 1200.0, -3.0)


def power_tool(
    take: Take, *, motor_hz: float, spindle_hz: float, spindle: float = 0.4, teeth: int = 7, segments: int = 24
) -> Floats:
    """A universal motor behind a gear: motor and spindle imbalance, gear mesh (teeth) and commutator (segments).

    The cut material loads the motor twice per turn of the spindle. `spindle` is the spindle's level; above 1 it
    dominates, as the disc of a grinder does. A tool on the motor's own shaft has a level of 0, since a shaft has one
    imbalance: two of random phases would cancel each other in some takes.
    """
    motor_speed = take.speed_hz(motor_hz) * (1.0 + 0.004 * wander(take.rng, 2.0))
    turn = phase(motor_speed)
    cut = turn * (spindle_hz / motor_hz)
    armature = partials(turn, take.roll_off(4), take.rng)
    whine = partials(turn, [0.0] * (teeth - 1) + [1.0] + [0.0] * (segments - teeth - 1) + [0.5], take.rng)
    return (
        unit_rms(armature) * (1.0 + 0.15 * take.drive * np.cos(2.0 * cut))
        + spindle * unit_rms(partials(cut, [1.0, 0.5, 0.25], take.rng))
        + (0.1 + 0.1 * take.drive) * unit_rms(whine)
        + 0.15 * noise(take.rng, 80.0, 3000.0, -3.0)
    )
