"""Mass of an object of a given size, from the mass of a usual one.

    m = m_usual (a b) / (a_usual b_usual)

Furniture, screens and pictures of all sizes consist of boards and sheets of similar thickness. So their mass grows with
the largest side of the box around them.

Letters: m [kg], a >= b [m] the two longest edges of that box.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache

from scene2hap.llm.lexicon.table import ObjectRow, rows_of

FARTHEST = 2.0
"""The largest factor between an object's mass and the usual one. Assumed: kits of models exaggerate sizes."""


def usual_mass_kg(row: ObjectRow, whole_m: Sequence[float]) -> float | None:
    """Return the mass of an object [kg], None if the table has none for its noun.

    Parameters: whole_m : edges of the box around the object [m], in any order. The usual mass is returned unchanged
    where no size is known: of the object, or in `usual_boxes.csv` for the mass in the table.
    """
    usual_m2 = _usual_sides_m2().get(row.noun)
    if row.mass_kg is None or usual_m2 is None or len(whole_m) != 3:
        return row.mass_kg
    _, middle, longest = sorted(whole_m)
    if middle <= 0.0:
        return row.mass_kg
    return row.mass_kg * min(max(longest * middle / usual_m2, 1 / FARTHEST), FARTHEST)


@cache
def _usual_sides_m2() -> Mapping[str, float]:
    rows = rows_of("usual_boxes.csv")
    return {fields["noun"]: float(fields["longest_m"]) * float(fields["middle_m"]) for fields in rows}
