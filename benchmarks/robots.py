"""Time of a frame while a robot moves, from its MJCF file.

    pip download gymnasium-robotics metaworld --no-deps && unzip -q '*.whl'
    python benchmarks/robots.py gymnasium_robotics/envs/assets/kitchen_franka/kitchen_assets/kitchen_env_model.xml

Every third of a second all motors get new commands by chance. Processor time of `link.update` in 300 frames at 60 Hz,
contacts from geometry. Needs: pip install 'scene2hap[mujoco]'
"""

from __future__ import annotations

import argparse
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from scene2hap import HapticSession, MuJoCoLink, bake
from scene2hap.scene.engines.mujoco import snapshot

N_FRAMES, FRAME_S, N_FRAMES_OF_A_COMMAND = 300, 1 / 60, 20


def frames_ms(model: Any, data: Any, session: HapticSession) -> np.ndarray:
    """Processor time of each update [ms] while the motors of a model get commands by chance."""
    import mujoco

    draw = np.random.default_rng(1)
    link = MuJoCoLink(model, data, session, hands={})
    low, high = np.where(model.actuator_ctrllimited[:, None] > 0, model.actuator_ctrlrange, (-1.0, 1.0)).T
    spent = []
    for frame in range(N_FRAMES):
        if frame % N_FRAMES_OF_A_COMMAND == 0:
            data.ctrl[:] = draw.uniform(low, high)
        for _ in range(round(FRAME_S / model.opt.timestep)):
            mujoco.mj_step(model, data)
            link.collect()
        start = time.thread_time()
        link.update()
        spent.append(1e3 * (time.thread_time() - start))
    return np.array(spent)


def main() -> None:
    import mujoco

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", type=Path, help="MJCF files")
    warnings.simplefilter("ignore")
    print("| model | objects | with a hinge | triangles | p50 [ms] | p99 [ms] | worst [ms] |")
    print("|---|---|---|---|---|---|---|")
    for path in parser.parse_args().models:
        model = mujoco.MjModel.from_xml_path(str(path))
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        scene = snapshot(model, data)
        spent = frames_ms(model, data, HapticSession(scene, bake(scene)))
        n_hinges = sum(item.hinge is not None for item in scene.objects)
        n_triangles = sum(len(item.geometry.mesh.faces) for item in scene.objects)
        times = " | ".join(f"{each:.2f}" for each in (*np.quantile(spent, (0.5, 0.99)), spent.max()))
        print(f"| {path.stem} | {len(scene.objects)} | {n_hinges} | {n_triangles} | {times} |")


if __name__ == "__main__":
    main()
