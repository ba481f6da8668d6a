"""What impacts cost the game's thread, how soon they are felt, and whether they click, as a table in Markdown.

OMP_NUM_THREADS=1 python benchmarks/impacts.py
OMP_NUM_THREADS=1 python benchmarks/impacts.py --scene kitchen.glb --seed 2

*Struck*: the game strikes what the hands touch, 100 times a second, within 0.6 m of them. *Landing*: as many cups as it
takes fall on it from 0.2 m again and again, so that 100 land each second, all moved in every update; the time is that
of the whole update, on the processor. Both in default settings, at 90 updates a second, on a lone table or on the floor
of a scene.

By a model that is prepared, in the demo's kitchen or the scene: strikes on objects that a hand touches elsewhere, how
many were felt, and how many with the next block; the time of `strike`; and by how much what was prepared ahead differs
from what the model prepares for the impact itself.
"""

from __future__ import annotations

import argparse
import gc
import os
import platform
import time

import numpy as np
from numpy.typing import NDArray
from spawning import bundle_of, on_floor, on_table, thing

from scene2hap import HapticBundle, HapticSession, Plate, Pose, SceneSnapshot, Touch, bake, load_scene
from scene2hap.demo import kitchen_path
from scene2hap.propagation import MODELS
from scene2hap.propagation.impact import burst_of
from scene2hap.session.struck import struck_later

UPDATES_HZ, IMPACTS_HZ, RATE_HZ, BLOCK, G = 90, 100, 48_000, 256, 9.81
FALL_M, CUP_M = 0.2, 0.1


def struck(session: HapticSession, touches: list[Touch], seconds: float, seed: int) -> tuple[NDArray, NDArray, int]:
    """Times [ms] of each update with its strikes, what was rendered, and how many were struck."""
    rng, due, n_struck = np.random.default_rng(seed), 0.0, 0
    times, heard = [], []
    for _ in range(round(seconds * UPDATES_HZ)):
        due += IMPACTS_HZ / UPDATES_HZ
        begin = time.thread_time()
        session.update(touches=touches)
        while due >= 1:
            due, n_struck = due - 1, n_struck + 1
            (x, y, z), (r, angle) = touches[0].point_m, (rng.uniform(0.02, 0.6), rng.uniform(0, 2 * np.pi))
            point, speed = (x + r * np.cos(angle), y, z + r * np.sin(angle)), float(rng.uniform(0.2, 3.0))
            session.strike(touches[0].object_id, point, speed_m_s=speed)
        times.append(1e3 * (time.thread_time() - begin))
        heard.append(session.render_s(1 / UPDATES_HZ)[:, 0])
    return np.array(times), np.concatenate(heard), n_struck


def falling(
    session: HapticSession, touches: list[Touch], spots: list[Pose], seconds: float
) -> tuple[NDArray, NDArray, int]:
    """The same with cups that fall; the last number is how often one came to rest."""
    fall_s = (2 * FALL_M / G) ** 0.5
    period_s = 2 * fall_s + 0.2
    n_cups = min(len(spots), round(IMPACTS_HZ * period_s))
    prefab = bundle_of(thing("cup", (CUP_M,) * 3, (0.0, 0.0, 0.0)), "ceramic", None)
    for n in range(n_cups):
        session.spawn(prefab, f"cup {n}", spots[n])
    session.wait_prepared()
    times, heard, n_landed = [], [], 0
    for step in range(round(seconds * UPDATES_HZ)):
        poses = {}
        for n in range(n_cups):
            t, before = ((step - late) / UPDATES_HZ + n * period_s / n_cups for late in (0, 1))
            n_landed += (before % period_s) < 2 * fall_s <= (t % period_s)
            # Up as it will come down, and at rest for a while.
            flight = min(t % period_s, 2 * fall_s)
            x, y, z = spots[n].position_m
            poses[f"cup {n}"] = Pose((x, y + max(0.0, FALL_M - G * (flight - fall_s) ** 2 / 2), z))
        begin = time.thread_time()
        session.update(poses, touches)
        times.append(1e3 * (time.thread_time() - begin))
        heard.append(session.render_s(1 / UPDATES_HZ)[:, 0])
    return np.array(times), np.concatenate(heard), n_landed


def latency_frames(session: HapticSession, touches: list[Touch], block: int) -> int:
    """From the impact to the first sample that is not 0, at most, over many impacts into silence."""
    worst = 0
    for _ in range(50):
        session.render_s(1.0)
        session.update(touches=touches)
        before = session.position
        session.strike(touches[0].object_id, touches[0].point_m)
        mix = session.render(block)[:, 0]
        worst = max(worst, int(np.flatnonzero(mix)[0]) + session.position - before - block if mix.any() else 1 << 30)
    return worst


def prepared_ahead(kind: str, scene: SceneSnapshot, bundle: HapticBundle, seed: int) -> str:
    """A row of strikes on objects that a hand touches elsewhere, by a model that is prepared."""
    rng, model = np.random.default_rng(seed), MODELS.build({"kind": kind})
    session = HapticSession(scene, bundle, {"propagation": model, "gain_limit_db": None})
    state, spent_ms, errors_db, n_next, n_struck = session._state, [], [], 0, 0
    ids = [x for x in state.graph.beside if isinstance(state.bodies.get(x), Plate)]
    session.update()
    session.wait_prepared()
    for object_id in rng.choice(ids, min(8, len(ids)), replace=False).tolist():
        item, pose = state.objects[object_id], state.poses[object_id]
        size = (item.surface.length_m, item.surface.width_m, 0.0)
        points = [pose.to_world(item.surface.pose.to_world([rng.uniform(0.05, 0.95, 3) * size]))[0] for _ in range(7)]
        hand, *struck = [tuple(point.tolist()) for point in points]
        session.update(touches=[Touch("left", object_id, hand)])
        session.wait_prepared()
        for point in struck:
            session.render_s(2.0)  # into silence
            begin = time.thread_time()
            impact = session.strike(object_id, point, speed_m_s=3.0)
            spent_ms.append(1e3 * (time.thread_time() - begin))
            n_next += bool(session.render(BLOCK)[:, 0].any())
            session.wait_prepared()
            burst = burst_of(state.bodies[object_id], state.on_plate(object_id, point), speed_m_s=3.0, is_finger=True)
            f, weights = burst.frequencies_hz, burst.accelerations_m_s2**2
            told = session._impacts._ahead.answer(object_id, point, [[(object_id, hand)]], f)
            if told is None:
                continue
            own = struck_later(model, state, object_id, point, [[(object_id, hand)]], f)()
            ratio = (weights * told.gains() ** 2).sum() / (weights * own**2).sum()
            errors_db.append(abs(10 * np.log10(ratio)))
            n_struck += bool(impact.felt)
    p50, p99 = np.percentile(spent_ms, (50, 99))
    level = f"{np.percentile(errors_db, 90):.2f} | {max(errors_db):.2f}" if errors_db else "- | -"
    return f"| {kind} | {n_struck} | {n_next} | {p50:.2f} | {p99:.2f} | {level} |"


def above_1_khz_db(heard: NDArray) -> float:
    """What lies above 1 kHz of all that was felt [dB]."""
    power = np.abs(np.fft.rfft(heard.astype(np.float64) * np.hanning(len(heard)))) ** 2
    f = np.fft.rfftfreq(len(heard), 1 / RATE_HZ)
    return float(10 * np.log10(power[f > 1000].sum() / power.sum()))


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--scene", help="a scene file with y up and a floor")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()

    print(
        f"Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores; {given.seconds:g} s each\n"
    )
    print("| impacts | reported | detected | felt | update p50 [ms] | p99 [ms] | worst [ms] | above 1 kHz [dB] |")
    print("|---|---|---|---|---|---|---|---|")
    for name in ("struck", "landing"):
        session, touches, spots = on_floor(given.scene, given.seed) if given.scene else on_table(200)
        for source_id in session.source_ids:
            session.set_source(source_id, on=False)
        session.update(touches=touches)
        gc.collect()
        gc.freeze()
        if name == "struck":
            times, heard, told = struck(session, touches, given.seconds, given.seed)
        else:
            times, heard, told = falling(session, touches, spots, given.seconds)
        p50, p99 = np.percentile(times, (50, 99))
        stats = session.stats
        cells = f"{told} | {stats.impacts} | {stats.impacts_felt}"
        print(f"| {name} | {cells} | {p50:.2f} | {p99:.2f} | {times.max():.2f} | {above_1_khz_db(heard):.0f} |")
    session, touches, _ = on_table(1)
    print(f"\nfrom the impact to its first sample: {latency_frames(session, touches, BLOCK)} frames of the next block")

    scene = load_scene(given.scene or kitchen_path())
    bundle = bake(scene)
    print(f"\n| model, in {scene.name} | felt | next block | strike p50 [ms] | p99 [ms] | off by p90 [dB] | most |")
    print("|---|---|---|---|---|---|---|")
    for kind in ("modal_plate", "auto", "infinite_plate", "mass_spring_damper"):
        print(prepared_ahead(kind, scene, bundle, given.seed))


if __name__ == "__main__":
    main()
