"""Run benchmarks and campaigns, and write their output into the pages of docs/figures.

python benchmarks/figures.py --list
python benchmarks/figures.py [NAME ...] [--busy]

Without names every figure is measured, which takes hours. A page holds blocks between `<!-- figure: NAME -->` and
`<!-- end -->`; each block states its command, commit, date and machine. A block is replaced only after its command has
ended with status 0. Its page is replaced as a whole. Text outside of blocks is written by hand.

Figures that contain times need an idle machine: above a load of 1 they are refused, unless --busy is given.
"""

from __future__ import annotations

import argparse
import datetime
import os
import platform
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGES = ROOT / "docs" / "figures"
MAX_LOAD = 1.0
SCENES = "../shared/scenes"
MOVERS = (
    f"{SCENES}/aws_house_bedroom/aws_house_bedroom.glb {SCENES}/composed_kitchen_kaykit/composed_kitchen_kaykit.glb "
    f"{SCENES}/composed_bathroom_kenney/composed_bathroom_kenney.glb {SCENES}/aws_house_living/aws_house_living.glb "
    f"{SCENES}/furniture_sim/dishwasher.xml"
)
IN_OTHER_UNITS = f"{SCENES}/messy_japanese_room/room.glb:0.1 {SCENES}/sketchfab_kitchen/scene.gltf:0.01"


@dataclass(frozen=True)
class Figure:
    """One block of a page and the command that makes it."""

    page: str
    command: str
    """Command line in the repository's folder, without `python`."""
    minutes: float
    """Approximate time on two cores."""
    has_times: bool = False
    is_text: bool = False
    """The output is plain text, not Markdown."""
    needs: str = ""

    @property
    def path(self) -> Path:
        return PAGES / f"{self.page}.md"

    @property
    def script(self) -> Path:
        return ROOT / shlex.split(self.command)[0]

    @property
    def options(self) -> list[str]:
        return shlex.split(self.command)[1:]


FIGURES = {
    "structure-packages": Figure("structure", "benchmarks/structure.py --part table", 0.1),
    "structure-way": Figure("structure", "benchmarks/structure.py --part way", 0.5),
    "structure-pictures": Figure("structure", "benchmarks/structure.py --part tree", 0.1),
    "surfaces": Figure("surfaces", "benchmarks/surfaces.py", 1, needs="scenes"),
    "contacts-by-hand": Figure("contacts", f"benchmarks/contacts.py {SCENES}", 1, needs="scenes"),
    "contacts-crowds": Figure("contacts", "benchmarks/crowds.py", 3, has_times=True),
    "contacts-trembling": Figure("contacts", "benchmarks/trembling.py", 1, has_times=False),
    "contacts-falling-boxes": Figure("contacts", "benchmarks/falling_boxes.py 1800", 2, has_times=True),
    "contacts-triangles": Figure(
        "contacts", f"stress/contacts.py {MOVERS} --moves 1500", 60, is_text=True, needs="scenes"
    ),
    "distinctness": Figure("conversion", "benchmarks/distinctness.py", 1),
    "kinds": Figure("conversion", "benchmarks/kinds.py --seeds 10", 10),
    "kinds-flat": Figure("conversion", "benchmarks/kinds.py --set flat --seeds 2 --first 11", 2),
    "kinds-workshop": Figure("conversion", "benchmarks/kinds.py --set workshop --seeds 2 --first 11", 2),
    "kinds-alike": Figure("conversion", "benchmarks/kinds.py --set compressors --seeds 2 --tactile svf_bandpass", 1),
    "kinds-one-filter": Figure("conversion", "benchmarks/kinds.py --seeds 2 --tactile svf_bandpass", 2),
    "many-scenes": Figure("many-scenes", "benchmarks/bake_many.py", 6, has_times=True, needs="scenes"),
    "many-scenes-200": Figure(
        "many-scenes",
        'benchmarks/bake_many.py --scenes 200 --runs "a pool of one" "a pool of two" "Dask, two workers"',
        7,
        has_times=True,
        needs="scenes",
    ),
    "many-scenes-killed": Figure("many-scenes", "stress/bake_many.py", 10, needs="scenes"),
    "scene-calls": Figure("many-scenes", "benchmarks/scene_calls.py", 8, needs="scenes"),
    "exports": Figure("exports", "benchmarks/export.py", 0.5, has_times=True, needs="scenes"),
    "voices": Figure("conversion", "benchmarks/voices.py", 0.2, needs="recordings"),
    "recordings": Figure("conversion", "benchmarks/recordings.py", 0.5, needs="recordings"),
    "conversion-cost": Figure("conversion", "benchmarks/convert.py", 7, has_times=True, is_text=True),
    "audio": Figure("audio", "stress/audio.py", 5, is_text=True, needs="recordings"),
    "recorded-runs": Figure("audio", "benchmarks/recorded_runs.py", 2, needs="recordings"),
    "accuracy": Figure("accuracy", "benchmarks/accuracy.py", 10, has_times=True),
    "auto-fidelity": Figure("propagation", "benchmarks/auto_fidelity.py --workers 2", 20, has_times=True),
    "propagation-cost": Figure("propagation", "benchmarks/propagation.py", 5, has_times=True),
    "stability-plates": Figure("stability", "stress/plates.py --plates 19000 --processes 2", 60, has_times=True),
    "stability": Figure("stability", "stress/propagation.py", 30, has_times=True),
    "frames-real-scenes": Figure(
        "frames", f"benchmarks/real_movers.py {MOVERS} --passes 3 --draws 3", 20, has_times=True, needs="scenes"
    ),
    "frames-other-units": Figure(
        "frames",
        f"benchmarks/real_movers.py {IN_OTHER_UNITS} --passes 3 --draws 3",
        5,
        has_times=True,
        needs="scenes",
    ),
    "frames-rooms-3": Figure("frames", "benchmarks/paper_loop.py 200 --defaults --seed 3", 10, has_times=True),
    "frames-rooms-71": Figure("frames", "benchmarks/paper_loop.py 200 --defaults --seed 71", 10, has_times=True),
    "playing-session": Figure("playing", "benchmarks/session.py", 5, has_times=True),
    "blas-threads": Figure("playing", "benchmarks/blas_threads.py", 6, has_times=True),
    "playing-two-contacts": Figure("playing", "benchmarks/paper_loop.py 300", 10, has_times=True),
    "playing-states": Figure("playing", "stress/states.py", 2),
    "playing-long": Figure("playing", "stress/session.py", 10, is_text=True),
    "sound-card": Figure("actuators", "stress/sound_card.py", 60, has_times=True, is_text=True, needs="sound server"),
    "sound-card-hour": Figure("actuators", "stress/soak.py", 60, has_times=True, is_text=True, needs="sound server"),
    "masses": Figure("inference", "benchmarks/masses.py", 1, needs="scenes"),
    "coupled": Figure("accuracy", "benchmarks/coupled.py", 5),
    "hand": Figure("propagation", "benchmarks/hand.py", 1, has_times=True),
    "outlines": Figure("accuracy", "benchmarks/outlines.py", 6, has_times=True),
    "outlines-order": Figure("accuracy", "benchmarks/outlines.py --order", 0.5),
    "coupled-draws": Figure("accuracy", "benchmarks/coupled_draws.py 12", 6),
    "auto-scenes": Figure(
        "propagation",
        "benchmarks/auto_scenes.py scene2hap/demo/kitchen.glb "
        + " ".join(
            f"{SCENES}/{name}/{name}.glb"
            for name in ("aws_house_bedroom", "aws_house_living", "composed_kitchen_kaykit", "composed_bathroom_kenney")
        ),
        2,
        has_times=True,
        needs="scenes",
    ),
    "bands": Figure("propagation", "benchmarks/bands.py", 1),
    "many-contacts": Figure("propagation", "benchmarks/many_contacts.py", 8, has_times=True),
    "model-choice": Figure("propagation", "benchmarks/model_choice.py", 2, has_times=True),
    "spawning-10": Figure("spawning", "benchmarks/spawning.py --alive 10", 0.5, has_times=True),
    "spawning-200": Figure("spawning", "benchmarks/spawning.py --alive 200", 0.5, has_times=True),
    "spawning-scene": Figure(
        "spawning",
        f"benchmarks/spawning.py --alive 50 --seed 2 --scene {SCENES}/aws_house_living/aws_house_living.glb",
        1,
        has_times=True,
        needs="scenes",
    ),
    "impacts": Figure("impacts", "benchmarks/impacts.py", 2, has_times=True),
    "impacts-scene": Figure(
        "impacts",
        f"benchmarks/impacts.py --seed 2 --scene {SCENES}/composed_kitchen_kaykit/composed_kitchen_kaykit.glb",
        2,
        has_times=True,
        needs="scenes",
    ),
    "landings": Figure("impacts", "stress/landings.py", 2),
    "irregular-frames": Figure("impacts", "benchmarks/irregular_frames.py", 2),
    "closing-speeds": Figure("impacts", "benchmarks/closing_speeds.py", 1),
    "engine-links": Figure("engines", "benchmarks/engine_links.py", 0.5, has_times=True),
    "bridge": Figure("bridge", "benchmarks/bridge.py", 1.5, has_times=True),
    "mixer": Figure("mixing", "benchmarks/mixer.py", 3, has_times=True),
    "inference": Figure("inference", "benchmarks/inference_eval.py", 3, has_times=False, needs="scenes"),
    "report-pages": Figure("report", "benchmarks/report_pages.py", 1, has_times=True, needs="scenes"),
    "import-time": Figure("starting", "benchmarks/import_time.py", 0.5, has_times=True, is_text=True),
}


def block(name: str) -> re.Pattern[str]:
    return re.compile(rf"(<!-- figure: {re.escape(name)} -->\n)(.*?)(<!-- end -->)", re.DOTALL)


def provenance(figure: Figure) -> str:
    """Command, commit, date and machine, as the first lines of a block."""
    commit = git("rev-parse", "--short=7", "HEAD") or "unknown"
    if git("status", "--porcelain", "--untracked-files=no", "--", "scene2hap", "benchmarks", "stress"):
        commit += " with local changes"
    load = f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    machine = f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores{load}"
    versions = f"Python {platform.python_version()}, numpy {version('numpy')}, scipy {version('scipy')}"
    return (
        f"`python {figure.command}`  \n"
        f"Commit {commit}, {datetime.date.today().isoformat()}; {machine}; {versions}; one BLAS thread.\n"
    )


def git(*words: str) -> str:
    """Output of git; empty without git or outside of a repository."""
    try:
        run = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return run.stdout.strip()


def output(figure: Figure) -> str:
    """Run the command with one BLAS thread, so that times are those of one core. Returns its output.

    Raises: subprocess.CalledProcessError: the command failed; its messages are on stderr.
    """
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, str(figure.script), *figure.options]
    printed = subprocess.run(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True, check=True).stdout
    return f"```\n{printed.strip()}\n```" if figure.is_text else printed.strip()


def refresh(name: str, figure: Figure) -> None:
    """Measure a figure and replace its page, as a whole or not at all."""
    page = figure.path.read_text(encoding="utf-8")
    if not block(name).search(page):
        raise SystemExit(f"{figure.path} has no block <!-- figure: {name} --> ... <!-- end -->; add one")
    made = f"{provenance(figure)}\n{output(figure)}\n"
    page = block(name).sub(lambda found: found[1] + made + found[3], page)
    draft = figure.path.with_suffix(".draft")
    draft.write_text(page, encoding="utf-8")
    draft.replace(figure.path)


def listed() -> str:
    rows = [f"{'name':24}{'page':14}{'minutes':>8}  times  command"]
    for name, one in FIGURES.items():
        rows.append(f"{name:24}{one.page:14}{one.minutes:>8g}  {'yes' if one.has_times else '':5}  {one.command}")
    return "\n".join(rows)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="figures to measure; default all")
    parser.add_argument("--list", action="store_true", help="list figures, their pages and commands")
    parser.add_argument("--busy", action="store_true", help="measure times although the machine is busy")
    arguments = parser.parse_args()
    if arguments.list:
        print(listed())
        return 0
    if unknown := set(arguments.names) - set(FIGURES):
        parser.error(f"no figure is called {', '.join(sorted(unknown))}; --list shows all")
    failed = []
    for name in arguments.names or FIGURES:
        figure = FIGURES[name]
        if figure.has_times and not arguments.busy and hasattr(os, "getloadavg") and os.getloadavg()[0] > MAX_LOAD:
            print(f"{name}: refused, the load is {os.getloadavg()[0]:.1f}; wait, or give --busy", file=sys.stderr)
            failed.append(name)
            continue
        print(f"{name}: about {figure.minutes:g} min", file=sys.stderr, flush=True)
        try:
            refresh(name, figure)
        except subprocess.CalledProcessError as problem:
            print(f"{name}: the command ended with status {problem.returncode}; page left as it is", file=sys.stderr)
            failed.append(name)
    return 1 if failed else 0


if __name__ == "__main__":
    raise SystemExit(main())
