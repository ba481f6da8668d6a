"""Results of a search, validated as untrusted data."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from scene2hap.audio.clip import Credit
from scene2hap.audio.sources.disk_cache import plain_line
from scene2hap.audio.sources.freesound.licences import read_deed
from scene2hap.common.web import is_safe

FIELDS = "id,name,username,license,url,duration,previews"

_PREVIEWS = ("preview-hq-ogg", "preview-hq-mp3", "preview-lq-ogg", "preview-lq-mp3")
"""Best first: Ogg begins and ends where the sound does, MP3 adds a gap."""


class Sound(BaseModel):
    """One result of a search."""

    model_config: ClassVar[ConfigDict] = ConfigDict(extra="ignore", frozen=True)

    id: int = Field(ge=0)
    name: str
    username: str
    license: str
    url: str = ""
    duration: float = Field(ge=0.0, allow_inf_nan=False)
    previews: Mapping[str, str]

    @property
    def licence(self) -> str:
        """The licence option that allows the sound ("by"); "" if its licence is not known."""
        deed = read_deed(self.license)
        return deed[0] if deed else ""

    @property
    def preview(self) -> str:
        """The address of the sound's best preview; "" if none is safe to follow."""
        return next((self.previews[name] for name in _PREVIEWS if is_safe(self.previews.get(name, ""))), "")

    def credit(self, query: str) -> Credit:
        """Return the credit of the sound."""
        deed = read_deed(self.license)
        return Credit(
            plain_line(self.name) or f"sound {self.id}",
            plain_line(self.username) or "unknown",
            deed[1] if deed else plain_line(self.license),
            plain_line(self.url) if is_safe(self.url) else f"https://freesound.org/s/{self.id}/",
            query,
            "freesound",
        )


def read_sounds(results: object) -> list[Sound] | None:
    """Return the valid results; None if `results` is not a list."""
    if not isinstance(results, list):
        return None
    return [sound for sound in map(_read, results) if sound is not None]


def _read(result: Any) -> Sound | None:
    try:
        return Sound.model_validate(result)
    except ValidationError:
        return None
