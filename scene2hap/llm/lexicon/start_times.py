"""Start and stop times of everyday objects, on and off times of automatic machines: a table by noun and verb."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from scene2hap.llm.lexicon.table import ObjectRow, rows_of


def starting_of(row: ObjectRow | None, verb: str) -> Mapping[str, Any]:
    """Return `start_up_s`, `wind_down_s` [s], `spins`, `on_s` and `off_s` [s] of an object; empty if unknown.

    The noun is looked up first, then the verb. For an object outside the lexicon, only the verb is looked up.
    """
    table = _table()
    return table.get(row.noun if row is not None else "") or table.get(verb, {})


@cache
def _table() -> Mapping[str, Mapping[str, Any]]:
    return {fields["what"]: _row(fields) for fields in rows_of("start_times.csv")}


def _row(fields: Mapping[str, str]) -> Mapping[str, Any]:
    times = {name: float(fields[name]) for name in ("start_up_s", "wind_down_s", "on_s", "off_s") if fields[name]}
    return {**times, "spins": fields["spins"] == "yes"}
