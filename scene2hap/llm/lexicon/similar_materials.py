"""Materials of everyday objects that the material table lacks, each with a similar material of the table.

The lexicon answers with the real name ("firm food"), since a carrot is no rubber. It uses the constants of the most
similar material in the table. All choices are assumed; stiffness counts first, then density.
"""

from __future__ import annotations

from scene2hap.materials import Material, lookup

STAND_INS = {
    "soft food": "soft tissue",  # meat, tomato: 10 to 100 kPa
    "firm food": "rubber",  # raw carrot, potato, apple: 1 to 10 MPa
    "baked food": "foam",  # bread crumb: below 100 kPa, mostly air
    "plant": "rubber",  # leaves and fresh stems: 1 to 100 MPa, about as heavy as water
    "wax": "ldpe",  # paraffin: 0.1 to 0.3 GPa, 900 kg/m3
    "water": "soft tissue",  # equally dense, and almost without shear stiffness
}


def constants(word: str) -> Material:
    """Return the constants of a material of the table, or of its stand-in. Raises: UnknownMaterial."""
    return lookup(STAND_INS.get(" ".join(word.lower().split()), word))
