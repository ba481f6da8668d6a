"""Names of Habitat templates that are hashes, from tables.

A table is CSV with a column of templates and one of names, or a JSON object that maps templates to names. The tables
below (HSSD's) are found in a dataset without a setting. The first table that has a template counts:

| file | templates | names |
|---|---|---|
| metadata/hssd_obj_semantics_condensed.csv | Object Hash | the semantic category, primary or condensed |
| metadata/object_categories_filtered.csv | id | clean_category |
| metadata/fpmodels-with-decomposed.csv | id | main_category |
| semantics/objects.csv | id | wnsynsetkey, main_category |

Source: the tables of hssd/hssd-hab, as `MetadataInterface` of partnr-planner (habitat_llm) reads them.
"""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from scene2hap.common import checks
from scene2hap.common.csv_tables import csv_reader
from scene2hap.common.printable import writable
from scene2hap.common.warning import warn_of
from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene.files import decoded, read_bytes
from scene2hap.scene.formats.habitat.dataset import plain_name
from scene2hap.scene.formats.habitat.folder import DatasetFolder, read_object

Names = Mapping[str, str] | str | os.PathLike[str]
"""Names by template, or the path of a table of them."""

_KEYS = ("template_name", "template", "id", "handle", "object hash")
_NAMES = ("name", "object_name", "clean_category", "category", "main_category", "wnsynsetkey")
_OF_DATASETS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (
        "metadata/hssd_obj_semantics_condensed.csv",
        ("primary semantic category", "semantic category primary", "semantic category condensed"),
    ),
    ("metadata/object_categories_filtered.csv", ("clean_category",)),
    ("metadata/fpmodels-with-decomposed.csv", ("main_category",)),
    ("semantics/objects.csv", ("wnsynsetkey", "main_category")),
)
_NO_NAME = frozenset({"", "unknown", "undefined", "unlabeled", "nan", "none", "null", "na", "n a", "n/a"})
# The end of a WordNet key: washer.n.03.
_SENSE = re.compile(r"\.[a-z]\.\d+")
_MOST_BYTES = 1 << 26
"""Largest size of a table [bytes] (assumed: ten times that of HSSD's)."""


class ObjectNames:
    """Object names by template."""

    def __init__(self, given: Names | None, folder: DatasetFolder) -> None:
        """Read the caller's table and the dataset's tables.

        Raises: SceneFormatError, SceneError: the caller's table is not valid, or cannot be read.
        """
        self._tables = [] if given is None else [_given(given)]
        for place, columns in _OF_DATASETS:
            file = folder.path / place
            # If a table of the dataset is broken, objects lack its names, but the scene is still read.
            try:
                if folder.has(file):
                    folder.count(file)
                    self._tables.append(_csv(file, columns))
            except SceneError as error:
                warn_of(f"the dataset's {place} names no objects: {error}")

    def of(self, template: str) -> str:
        """Return the name in the first table that has the template, else the template's own name without folders."""
        own = plain_name(template)
        for table in self._tables:
            for key in (template, own):
                if key in table:
                    return table[key]
        return own


def _given(names: Names) -> Mapping[str, str]:
    if isinstance(names, Mapping):
        for template, name in names.items():
            if not isinstance(template, str) or not isinstance(name, str):
                raise SceneError(
                    f"names maps {checks.represented(template)} to {checks.represented(name)}; it must map the names "
                    "of templates to names of objects, both texts."
                )
        return names
    file = checks.path("names", names, error=SceneError)
    if file.suffix.lower() != ".json":
        return _csv(file, _NAMES)
    rows = read_object(file)
    wrong = next((key for key, value in rows.items() if not isinstance(value, str)), None)
    if wrong is not None:
        raise SceneFormatError(
            f"{file.name!r} maps {wrong!r} to {checks.represented(rows[wrong])}; it must map templates to names."
        )
    return rows


def _csv(file: Path, columns: Sequence[str]) -> dict[str, str]:
    """Return names by template in a CSV table. In each row, the first non-empty cell of `columns` counts."""
    data = read_bytes(file)
    if len(data) > _MOST_BYTES:
        raise SceneError(f"{file.name!r} has {len(data):,} bytes; tables of names of up to {_MOST_BYTES:,} are read.")
    text = writable(decoded(data)).replace("\0", "")
    found: dict[str, str] = {}
    try:
        rows = csv_reader(text)
        header = next(rows, [])
        keys, named = _columns(header, _KEYS), _columns(header, columns)
        if not keys or not named:
            raise SceneFormatError(
                f"{file.name!r} has the columns {checks.represented(header)}; it must have one of templates "
                f"({', '.join(_KEYS)}) and one of names ({', '.join(columns)})."
            )
        for row in rows:
            name = next((word for word in (_word(row[at]) for at in named if at < len(row)) if word), "")
            if name and keys[0] < len(row):
                found.setdefault(row[keys[0]].strip(), name)
    except csv.Error as cause:
        raise SceneFormatError(f"{file.name!r} is no CSV table: {cause}.") from cause
    return found


def _columns(header: Sequence[str], wanted: Iterable[str]) -> list[int]:
    """Return the numbers of the columns with these names, in the order of `wanted`.

    Only the start of a column's name must agree, since HSSD explains some columns in their names.
    """
    folded = [_folded(name) for name in header]
    places = ([at for at, name in enumerate(folded) if f"{name} ".startswith(f"{_folded(one)} ")] for one in wanted)
    return list(dict.fromkeys(at for group in places for at in group))


def _word(cell: str) -> str:
    name = _SENSE.sub("", cell.strip())
    return "" if _folded(name) in _NO_NAME else name


def _folded(text: str) -> str:
    return " ".join(re.split(r"[\W_]+", text.strip().casefold())).strip()
