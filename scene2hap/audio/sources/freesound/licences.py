"""Freesound's licences: their names in filters, in results and in credits."""

from __future__ import annotations

import re
from collections.abc import Iterable

from scene2hap.errors import ConfigError

# Option -> names that the search filter knows; two if the spelling has changed over the years.
_FILTER_NAMES = {
    "cc0": ("Creative Commons 0",),
    "by": ("Attribution",),
    "by-nc": ("Attribution NonCommercial", "Attribution Noncommercial"),
    "sampling+": ("Sampling+",),
}
_DEED = re.compile(
    r"https?://creativecommons\.org/(?:publicdomain/(zero)|licenses/(by|by-nc|sampling\+))/(\d\.\d)/?(?:deed.*)?"
)


def checked(licences: Iterable[str]) -> tuple[str, ...]:
    """Return the options in order, without duplicates. Raises: ConfigError: none, or one that does not exist."""
    wanted = (licences,) if isinstance(licences, str) else tuple(dict.fromkeys(licences))
    unknown = [licence for licence in wanted if licence not in _FILTER_NAMES]
    if unknown or not wanted:
        raise ConfigError(f"licences is {list(wanted)}; it must hold at least one of {', '.join(_FILTER_NAMES)}.")
    return wanted


def as_filter(licences: Iterable[str]) -> str:
    """Return the part of a search filter that allows these licences."""
    names = [f'"{name}"' for licence in licences for name in _FILTER_NAMES[licence]]
    return f"license:({' OR '.join(names)})"


def read_deed(address: str) -> tuple[str, str] | None:
    """Return option and credit of the licence whose deed has this address ("by", "CC-BY-4.0"); None if unknown."""
    match = _DEED.fullmatch(address.strip())
    if match is None:
        return None
    zero, kind, version = match.groups()
    if zero:
        return "cc0", f"CC0-{version}"
    return kind, f"CC-{'Sampling+' if kind == 'sampling+' else kind.upper()}-{version}"
