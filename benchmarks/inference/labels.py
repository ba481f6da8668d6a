"""Reading of the labels: category and material family of each object, and whether it vibrates by itself."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

HERE = Path(__file__).parent
FAMILIES = (
    "wood", "metal", "glass", "ceramic", "plastic", "fabric", "stone", "paper", "rubber", "plant", "food", "other",
)  # fmt: skip

Half = Literal["tuning", "held-out", "memory", "packs"]
NAME_LISTS: dict[Half, str] = {"memory": "names_from_memory.csv", "packs": "names_from_packs.csv"}


@dataclass(frozen=True)
class Label:
    """Label of one object; `categories` and `families` hold all accepted answers, the best first."""

    scene: str
    object_id: str
    name: str
    categories: tuple[str, ...]
    families: tuple[str, ...]
    vibrates: bool
    note: str

    @property
    def hard(self) -> bool:
        """Whether careful people may disagree on the vibration (a pan, a sink with its tap)."""
        return self.note.startswith("hard")


@dataclass(frozen=True)
class LabelledScene:
    """A labelled scene: path, half, accepted kinds of place, and labels.

    A list of names without a file has no `path`; `longest_m` gives the longest edge [m] of each named object.
    """

    scene: str
    path: str
    assets_root: str
    half: Half
    meaningful: bool
    places: tuple[str, ...]
    labels: dict[str, Label]
    longest_m: dict[str, float]


def read_rows(name: str) -> list[dict[str, str]]:
    """The rows of a CSV file of this folder."""
    with (HERE / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def label(row: dict[str, str]) -> Label:
    """Check a row and return its label. Raises: ValueError: unknown family, or `vibrates` is neither yes nor no."""
    families = tuple(row["material_family"].split("|"))
    if not set(families) <= set(FAMILIES) or row["vibrates"] not in ("yes", "no"):
        raise ValueError(f"label {row}: families are {', '.join(FAMILIES)}; vibrates is yes or no.")
    synonyms = [text for text in row["synonyms"].split("|") if text]
    return Label(
        scene=row["scene"],
        object_id=row["object_id"],
        name=row["name"],
        categories=(row["category"], *synonyms),
        families=families,
        vibrates=row["vibrates"] == "yes",
        note=row["note"],
    )


def labelled_scenes() -> list[LabelledScene]:
    """The scenes of `scenes.csv` with their labels, in the order of that file."""
    every = [label(row) for row in read_rows("labels.csv")]
    return [
        LabelledScene(
            scene=row["scene"],
            path=row["path"],
            assets_root=row["assets_root"],
            half="tuning" if row["half"] == "tuning" else "held-out",
            meaningful=row["names"] == "meaningful",
            places=tuple(row["places"].split("|")),
            labels={item.object_id: item for item in every if item.scene == row["scene"]},
            longest_m={},
        )
        for row in read_rows("scenes.csv")
    ]


def listed_names(half: Half) -> list[LabelledScene]:
    """Scenes of a list of names without files, one scene per pack."""
    rows = read_rows(NAME_LISTS[half])
    scenes = []
    for pack in dict.fromkeys(row["scene"] for row in rows):
        own = [row for row in rows if row["scene"] == pack]
        labels = {row["name"]: label({**row, "object_id": row["name"]}) for row in own}
        longest_m = {row["name"]: float(row["longest_m"]) for row in own}
        scenes.append(LabelledScene(pack, "", "", half, True, (), labels, longest_m))
    return scenes
