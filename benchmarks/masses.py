"""Masses of the lexicon in real scenes compared with published average weights, as tables in Markdown.

python benchmarks/masses.py [FOLDER of scenes]

Published weights are used as found, and no parameter was tuned to them. Walls, floors and object types without a
published weight are left out.
"""

from __future__ import annotations

import argparse
import math
import warnings
from pathlib import Path

import numpy as np

from scene2hap import bake, load_scene

MRWA = "Merseyside Recycling and Waste Authority, Approved average weights"
PUBLISHED_KG: dict[str, tuple[float, str]] = {
    "night stand": (14.0, f"{MRWA}: bedside unit"),
    "chair": (7.0, f"{MRWA}: chair, kitchen, dining or wooden"),
    "desk": (27.0, f"{MRWA}: large desk"),
    "desk chair": (12.0, f"{MRWA}: office chair"),
    "armchair": (27.0, f"{MRWA}: armchair"),
    "recliner": (51.0, f"{MRWA}: recliner"),
    "wardrobe": (55.0, f"{MRWA}: wardrobe, double"),
    "bed": (78.0, f"{MRWA}: bed, double complete"),
    "coffee table": (14.0, f"{MRWA}: table small, coffee"),
    "side table": (14.0, f"{MRWA}: table small, coffee"),
    "dining table": (29.0, f"{MRWA}: table, large e.g. dining"),
    "table": (23.0, f"{MRWA}: table, medium e.g. kitchen"),
    "sofa": (42.0, f"{MRWA}: 3 seater sofa"),
    "tv cabinet": (17.0, f"{MRWA}: TV / hi-fi unit"),
    "sideboard": (35.0, f"{MRWA}: sideboard"),
    "dresser": (27.0, f"{MRWA}: chest of drawers"),
    "commode": (27.0, f"{MRWA}: chest of drawers"),
    "bookcase": (21.0, f"{MRWA}: bookcase, shelving unit"),
    "bookshelf": (21.0, f"{MRWA}: bookcase, shelving unit"),
    "cabinet": (20.0, f"{MRWA}: cabinet, display and kitchen"),
    "grandfather clock": (64.0, f"{MRWA}: grandfather clock"),
    "bench": (30.0, f"{MRWA}: bench, kitchen or garden"),
    "ottoman": (11.0, f"{MRWA}: blanket box, ottoman"),
    "washing machine": (70.5, "median of ten models named by homeownercosts.co.uk"),
    "refrigerator": (91.0, "middle of top-freezer models, 68 to 113 kg, ridleyroad.co.uk"),
    "toilet": (45.0, "middle of two-piece toilets, 80 to 120 lb, toiletseats.top"),
    "bathtub": (29.5, "fibreglass, 60 to 70 lb, ehow"),
}
"""Mass of a usual object of each type [kg] and its source."""

LIBRARY_M = 1.8
"""Real size divided by size in the library's files (SOURCE.md of lib_kenney_furniture)."""
LIBRARY_KG: dict[str, tuple[float, str]] = {
    "bedDouble": (78.0, f"{MRWA}: bed, double complete"),
    "bedSingle": (53.0, f"{MRWA}: bed, single complete"),
    "bench": (30.0, f"{MRWA}: bench, kitchen or garden"),
    "bookcaseClosed": (21.0, f"{MRWA}: bookcase, shelving unit"),
    "cabinetBed": (14.0, f"{MRWA}: bedside unit"),
    "cabinetBedDrawer": (14.0, f"{MRWA}: bedside unit"),
    "chair": (7.0, f"{MRWA}: chair, kitchen, dining or wooden"),
    "chairCushion": (7.0, f"{MRWA}: chair, kitchen, dining or wooden"),
    "chairDesk": (12.0, f"{MRWA}: office chair"),
    "chairRounded": (7.0, f"{MRWA}: chair, kitchen, dining or wooden"),
    "desk": (27.0, f"{MRWA}: large desk"),
    "dryer": (56.5, "middle of full-sized dryers, 45 to 68 kg, 70ku.net"),
    "kitchenCabinet": (20.0, f"{MRWA}: cabinet, display and kitchen"),
    "kitchenCabinetDrawer": (20.0, f"{MRWA}: cabinet, display and kitchen"),
    "kitchenFridge": (91.0, "middle of top-freezer models, 68 to 113 kg, ridleyroad.co.uk"),
    "kitchenStove": (91.0, "middle of freestanding gas ranges, 68 to 113 kg, 4336552.com"),
    "kitchenStoveElectric": (68.0, "middle of freestanding electric ranges, 45 to 91 kg, 4336552.com"),
    "loungeChair": (27.0, f"{MRWA}: armchair"),
    "loungeChairRelax": (51.0, f"{MRWA}: recliner"),
    "loungeSofa": (37.0, f"{MRWA}: 2 seater sofa"),
    "loungeSofaLong": (42.0, f"{MRWA}: 3 seater sofa"),
    "loungeSofaOttoman": (11.0, f"{MRWA}: blanket box, ottoman"),
    "sideTable": (14.0, f"{MRWA}: table small, coffee"),
    "sideTableDrawers": (14.0, f"{MRWA}: bedside unit"),
    "table": (23.0, f"{MRWA}: table, medium e.g. kitchen"),
    "tableCoffee": (14.0, f"{MRWA}: table small, coffee"),
    "tableCoffeeGlass": (14.0, f"{MRWA}: table small, coffee"),
    "tableCross": (23.0, f"{MRWA}: table, medium e.g. kitchen"),
    "tableRound": (23.0, f"{MRWA}: table, medium e.g. kitchen"),
    "toilet": (45.0, "middle of two-piece toilets, 80 to 120 lb, toiletseats.top"),
    "washer": (70.5, "median of ten models named by homeownercosts.co.uk"),
}
"""Usual mass of the furniture that a model shows [kg] and its source, by file name. Wrong inferred types count too."""

SCENES = (
    ("aws_house_bedroom/aws_house_bedroom.glb", 1.0),
    ("aws_house_living/aws_house_living.glb", 1.0),
    ("composed_bathroom_kenney/composed_bathroom_kenney.glb", 1.0),
    ("composed_kitchen_kaykit/composed_kitchen_kaykit.glb", 1.0),
    ("sketchfab_kitchen/scene.gltf", 0.01),  # made in centimetres
)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", default="../shared/scenes", type=Path)
    given = parser.parse_args()
    factors: list[float] = []
    print("| scene | object type | objects | inferred [kg] | published [kg] | factor |")
    print("|---|---|---|---|---|---|")
    for name, unit_m in SCENES:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            bundle = bake(load_scene(given.folder / name, unit_m=unit_m))
        found: dict[tuple[str, float], int] = {}
        for haptics in bundle.objects.values():
            if haptics.object_category in PUBLISHED_KG and haptics.mass_kg is not None:
                key = haptics.object_category, round(haptics.mass_kg, 2)
                found[key] = found.get(key, 0) + 1
        for (category, mass_kg), n in sorted(found.items()):
            published = PUBLISHED_KG[category][0]
            factor = mass_kg / published
            factors += [abs(math.log(factor))] * n
            print(f"| {bundle.snapshot.name} | {category} | {n} | {mass_kg:.3g} | {published:.3g} | {factor:.2f} |")
    print_summary(factors)
    print("\n| model | object type | inferred [kg] | published [kg] | factor |")
    print("|---|---|---|---|---|")
    factors = []
    for model, (published, _) in LIBRARY_KG.items():
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            bundle = bake(load_scene(given.folder / "lib_kenney_furniture" / f"{model}.glb", unit_m=LIBRARY_M))
        one = max(bundle.objects.values(), key=lambda haptics: haptics.mass_kg or 0.0)
        mass_kg = one.mass_kg or math.nan
        factors.append(abs(math.log(mass_kg / published)))
        print(f"| {model} | {one.object_category} | {mass_kg:.3g} | {published:.3g} | {mass_kg / published:.2f} |")
    print_summary(factors)


def print_summary(factors: list[float]) -> None:
    away = np.exp(np.array(factors))
    within = ", ".join(f"{100 * (away <= most).mean():.0f} % within a factor of {most:g}" for most in (1.5, 2.0, 3.0))
    print(f"\n{len(away)} objects: median factor {np.median(away):.2f}, {within}; worst {away.max():.2f}.")


if __name__ == "__main__":
    main()
