"""Masses of the lexicon in real scenes compared with published average weights, as tables in Markdown.

python benchmarks/masses.py [FOLDER of scenes]

Published weights are used as found, and no parameter was tuned to them. They are averages over all sizes of a type.
Walls, floors and object types without a published weight are left out. The third table compares products of a stated
size.
"""

from __future__ import annotations

import argparse
import math
import warnings
from pathlib import Path

import numpy as np

from scene2hap import Box, Pose, SceneObject, SceneSnapshot, bake, load_scene

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

PRODUCTS: tuple[tuple[str, tuple[float, float, float], float, str], ...] = (
    ("bar stool", (0.4, 0.91, 0.45), 6.5, "IKEA INGOLF bar stool"),
    ("upright piano", (1.53, 1.21, 0.61), 228, "Yamaha U1 data sheet"),
    ("grand piano", (1.46, 0.99, 1.51), 261, "Yamaha GB1K"),
    ("digital piano", (1.326, 0.154, 0.295), 11.5, "Yamaha P-45"),
    ("monitor", (0.611, 0.525, 0.185), 6.6, "Dell U2720Q with stand"),
    ("television", (1.23, 0.78, 0.25), 17, "Samsung 55 inch Q60 with stand"),
    ("laptop", (0.304, 0.016, 0.212), 1.29, "MacBook Air 13 M1"),
    ("keyboard", (0.442, 0.025, 0.127), 0.5, "Dell KB216"),
    ("computer mouse", (0.062, 0.038, 0.113), 0.09, "Logitech M100"),
    ("desktop computer", (0.169, 0.367, 0.308), 7.9, "Dell XPS 8940"),
    ("laser printer", (0.381, 0.216, 0.357), 8.56, "HP LaserJet M404"),
    ("dishwasher", (0.598, 0.845, 0.6), 48, "Bosch SMS 60 cm"),
    ("vacuum cleaner", (0.34, 1.06, 0.39), 7.9, "Dyson Ball Animal 2"),
    ("robot vacuum", (0.335, 0.092, 0.335), 3.1, "Roomba 600"),
    ("standing fan", (0.45, 1.2, 0.45), 5.0, "pedestal fan 16 inch"),
    ("bicycle", (1.8, 1.1, 0.6), 16, "city bike"),
    ("treadmill", (1.87, 1.37, 0.91), 92, "NordicTrack T6.5S"),
    ("exercise bike", (1.24, 1.31, 0.78), 48, "Schwinn IC4"),
    ("sewing machine", (0.416, 0.29, 0.17), 5.9, "Brother CS6000i"),
    ("cordless drill", (0.2, 0.2, 0.08), 1.6, "Bosch GSR 18V"),
    ("acoustic guitar", (0.4, 1.03, 0.12), 2.0, "dreadnought"),
    ("electric guitar", (0.32, 0.98, 0.05), 3.6, "Stratocaster"),
    ("bookshelf speaker", (0.18, 0.303, 0.278), 5.6, "KEF Q150"),
    ("subwoofer", (0.33, 0.34, 0.356), 12.2, "SVS SB-1000"),
    ("suitcase", (0.45, 0.67, 0.27), 3.7, "Samsonite medium"),
    ("ironing board", (1.3, 0.9, 0.4), 6.0, "Brabantia B/C"),
    ("mirror", (0.65, 1.5, 0.04), 11.5, "IKEA NISSEDAL 65x150"),
    ("rug", (3.0, 0.01, 2.0), 15, "machine woven 2.5 kg/m2"),
    ("toaster", (0.29, 0.19, 0.17), 1.4, "2-slice"),
    ("blender", (0.22, 0.52, 0.184), 4.8, "Vitamix 5200"),
    ("electric kettle", (0.22, 0.25, 0.16), 1.1, "1.7 litre"),
    ("coffee machine", (0.33, 0.204, 0.084), 2.3, "Nespresso Essenza Mini"),
    ("stand mixer", (0.36, 0.36, 0.24), 11.8, "KitchenAid Artisan"),
    ("rice cooker", (0.34, 0.21, 0.25), 3.6, "Zojirushi NS-ZCC10"),
    ("trash can", (0.52, 0.66, 0.33), 5.0, "simplehuman 45 l"),
    ("lawn mower", (1.6, 1.0, 0.6), 44, "Honda HRX217"),
    ("game console", (0.39, 0.104, 0.26), 4.5, "PlayStation 5"),
    ("tablet", (0.25, 0.0075, 0.174), 0.487, "iPad 9"),
    ("hair dryer", (0.2, 0.27, 0.09), 0.6, "household"),
    ("electric toothbrush", (0.03, 0.24, 0.03), 0.13, "Oral-B"),
    ("alarm clock", (0.1, 0.1, 0.05), 0.2, "bedside"),
    ("radiator", (1.0, 0.6, 0.1), 33, "type 22 600x1000, Stelrad"),
    ("wash basin", (0.6, 0.2, 0.46), 15, "ceramic 60 cm"),
    ("mattress", (1.53, 0.25, 2.03), 31, "queen spring"),
    ("bunk bed", (2.06, 1.57, 0.97), 50, "IKEA MYDAL"),
    ("crib", (1.23, 0.88, 0.66), 17, "IKEA SNIGLAR"),
    ("water dispenser", (0.31, 0.98, 0.31), 16, "floor standing"),
    ("safe", (0.415, 0.453, 0.491), 39, "SentrySafe SFW123"),
    ("cutting board", (0.45, 0.075, 0.45), 10.5, "maple butcher block 3 inch"),
    ("cast iron skillet", (0.41, 0.057, 0.31), 3.6, "Lodge 12 inch"),
    ("wheelbarrow", (1.4, 0.65, 0.6), 14, "steel 85 l"),
    ("stroller", (0.9, 1.05, 0.6), 10, "Bugaboo Cameleon"),
    ("projector", (0.3, 0.09, 0.23), 2.4, "Epson EX3280"),
    ("record player", (0.452, 0.157, 0.352), 8.0, "AT-LP120X"),
    ("air purifier", (0.22, 0.36, 0.22), 3.6, "Levoit Core 300"),
    ("dehumidifier", (0.35, 0.55, 0.25), 15, "20 l a day"),
    ("door", (0.83, 2.0, 0.04), 17, "hollow-core interior leaf"),
    ("picture frame", (0.53, 0.73, 0.035), 2.6, "IKEA RIBBA 50x70"),
    ("chest freezer", (0.81, 0.85, 0.53), 37, "200 l"),
    ("gas grill", (1.32, 1.13, 0.69), 52, "Weber Spirit II E-310"),
    ("chainsaw", (0.4, 0.27, 0.25), 4.1, "Stihl MS 170 head"),
    ("high chair", (0.58, 0.9, 0.62), 3.6, "IKEA ANTILOP"),
    ("bathroom scale", (0.3, 0.025, 0.3), 1.7, "glass"),
    ("table tennis table", (2.74, 0.76, 1.525), 75, "indoor 19 mm"),
    ("table", (2.4, 0.75, 1.0), 60, "solid wood conference/farm table for ten"),
    ("side table", (0.4, 0.45, 0.4), 4, "small"),
    ("rug", (1.2, 0.01, 0.8), 2.4, "small, 2.5 kg/m2"),
    ("television", (0.73, 0.48, 0.15), 4.5, "32 inch"),
    ("television", (1.67, 1.0, 0.3), 33, "75 inch"),
    ("mattress", (0.9, 0.2, 2.0), 15, "single foam/spring"),
    ("desk", (1.8, 0.74, 0.8), 45, "executive desk"),
    ("wardrobe", (0.8, 1.9, 0.5), 40, "two doors, small"),
    ("wardrobe", (2.5, 2.36, 0.6), 200, "IKEA PAX 250"),
    ("bookcase", (0.4, 1.06, 0.28), 14, "IKEA BILLY 40x106"),
    ("sofa", (3.2, 0.85, 2.0), 120, "corner sofa"),
    ("mirror", (0.4, 0.4, 0.02), 2, "small"),
    ("speaker", (0.2, 1.0, 0.3), 18, "floor-standing"),
    ("radiator", (2.0, 0.6, 0.1), 66, "type 22 600x2000"),
    ("cutting board", (0.3, 0.015, 0.2), 0.65, "beech"),
    ("refrigerator", (0.91, 1.78, 0.73), 120, "American side by side"),
    ("cabinet", (0.6, 0.72, 0.35), 17, "wall cabinet"),
    ("monitor", (0.81, 0.52, 0.25), 8.5, "34 inch ultrawide"),
)
"""Name, box of its size with the height in the middle [m], mass [kg] and product. Data sheets and listings, from
memory, written down before any was compared; the last eighteen are of unusual size."""
N_UNUSUAL = 18

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
    print_products()


def print_products() -> None:
    """The third table, of boxes of the size of products."""
    print("\n| name | size [m] | object type | inferred [kg] | product [kg] | factor |")
    print("|---|---|---|---|---|---|")
    factors: list[float] = []
    for name, size_m, product_kg, _ in PRODUCTS:
        item = SceneObject(name, pose=Pose((0.0, size_m[1] / 2, 0.0)), geometry=Box(size_m))
        floor = SceneObject("floor", pose=Pose((0.0, -0.05, 0.0)), geometry=Box((5.0, 0.1, 5.0)))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            one = bake(SceneSnapshot.build([item, floor])).objects[name]
        mass_kg = one.mass_kg or math.nan
        factors.append(abs(math.log(mass_kg / product_kg)))
        size, factor = " x ".join(f"{edge:g}" for edge in size_m), mass_kg / product_kg
        print(f"| {name} | {size} | {one.object_category} | {mass_kg:.3g} | {product_kg:.3g} | {factor:.2f} |")
    print_summary(factors[:-N_UNUSUAL])
    print("\nThe last eighteen, of unusual size:")
    print_summary(factors[-N_UNUSUAL:])


def print_summary(factors: list[float]) -> None:
    away = np.exp(np.array(factors))
    within = ", ".join(f"{100 * (away <= most).mean():.0f} % within a factor of {most:g}" for most in (1.5, 2.0, 3.0))
    print(f"\n{len(away)} objects: median factor {np.median(away):.2f}, {within}; worst {away.max():.2f}.")


if __name__ == "__main__":
    main()
