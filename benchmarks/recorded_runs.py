"""Starts and stops found in synthetic recordings of known machines, and in sounds without a start or a stop.

python benchmarks/recorded_runs.py [--draws 300] [--seed 0]

Machines are drawn by `tests/support/starting_machines.py`: start or stop of 0.5 to 8 s, four shapes, 60 to 300 Hz, one
to six harmonics, machine hiss 30 to 6 dB below, room noise 40 to 20 dB below. In half of the machines the pitch moves.
Level and speed are compared while the machine is within 20 dB of steady running.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from scene2hap.audio.recorded_runs import recorded_runs
from sound_draws import recordings
from starting_machines import RATE_HZ, RISES, errors, machine, without_runs


class Row(NamedTuple):
    """A machine: whether its pitch moves, and the errors of the result; NaN if nothing was found."""

    spins: bool
    has_false_end: bool
    time_error: float = np.nan
    level_error_db: float = np.nan
    speed_error: float = np.nan
    is_pitch_right: bool = False


def drawn(rng: np.random.Generator) -> Row:
    """Draw one machine and search its recording."""
    lasts_s = float(np.exp(rng.uniform(np.log(0.5), np.log(8.0))))
    is_start, spins, shape = rng.random() < 0.5, rng.random() < 0.5, str(rng.choice(sorted(RISES)))
    way: dict[str, Any] = {"start_s": lasts_s, "rise": shape} if is_start else {"stop_s": lasts_s, "fall": shape}
    take = machine(
        **way,
        spins=spins,
        frequency_hz=float(rng.uniform(60, 300)),
        n_harmonics=int(rng.integers(1, 7)),
        hiss_db=float(rng.uniform(-30, -6)),
        room_db=float(rng.uniform(-40, -20)),
        steady_s=max(4.0, lasts_s),
        seed=int(rng.integers(2**31)),
    )
    found = recorded_runs(take.samples, RATE_HZ)
    curve, other = (found.start_up, found.wind_down) if is_start else (found.wind_down, found.start_up)
    if curve is None:
        return Row(spins, other is not None)
    begin_s = found.first / RATE_HZ - curve.lasts_s if is_start else found.end / RATE_HZ
    is_right = bool(curve.speed) and curve.keeps_pitch != spins
    return Row(spins, other is not None, curve.lasts_s / lasts_s - 1, *errors(take, curve, begin_s), is_right)


def spread(name: str, values: list[float], most: float, form: str) -> str:
    """Row of the table: share of values within a bound, median and 95th percentile."""
    off: NDArray[np.float64] = np.abs(values)
    middle, high = np.percentile(off, (50, 95))
    within = np.mean(off <= most)
    return f"| {name} | within {most:{form}} | {within:.1%} | {middle:{form}} | {high:{form}} |"


def false_ends(n_seeds: int) -> Counter[str]:
    """Number of sounds in which a start or a stop is found although they have none, by kind."""
    sounds = [(name, x, RATE_HZ) for seed in range(n_seeds) for name, x in without_runs(seed).items()]
    sounds += [(name, x, rate) for name, (x, rate) in recordings().items()]
    found = [(name, recorded_runs(x, rate)) for name, x, rate in sounds]
    print(f"\nOf {len(sounds)} sounds without a start or a stop, {len(recordings())} of them recordings:", end=" ")
    return Counter(name for name, one in found if one.start_up is not None or one.wind_down is not None)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=300, help="recordings of machines")
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    rows = [drawn(rng) for _ in range(arguments.draws)]
    found = [row for row in rows if not np.isnan(row.time_error)]
    moving = [row for row in found if row.spins]
    right = [row for row in moving if row.is_pitch_right]
    n_false = sum(row.has_false_end for row in rows)
    print(f"{len(found)} of {len(rows)} starts and stops found; {n_false} at an end that has none.\n")
    print("| | | share | median error | 95th percentile |\n|---|---|---|---|---|")
    print(spread("time", [row.time_error for row in found], 0.15, ".1%"))
    print(spread("level [dB]", [row.level_error_db for row in found], 3.0, ".1f"))
    print(spread("pitch that moves", [row.speed_error for row in right], 0.05, ".1%"))
    still = [row for row in found if not row.spins]
    n_still = sum(row.is_pitch_right for row in still)
    print(f"\nPitch right for {len(right)} of {len(moving)} that move, and for {n_still} of {len(still)} that stay.")
    false = false_ends(max(1, arguments.draws // 20))
    print(", ".join(f"{name} {n}" for name, n in false.items()) or "none is found.")


if __name__ == "__main__":
    main()
