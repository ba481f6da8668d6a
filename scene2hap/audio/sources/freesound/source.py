"""The Freesound source: queries, licence filter, previews and a cache."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from scene2hap.audio.clip import AudioClip
from scene2hap.audio.select import MIN_DURATION_S
from scene2hap.audio.sources.candidates import MAX_CANDIDATES, how_many, is_long_enough
from scene2hap.audio.sources.disk_cache import MAX_CLIP_S, Store, digest
from scene2hap.audio.sources.freesound import licences as cc
from scene2hap.audio.sources.freesound.queries import queries_for
from scene2hap.audio.sources.freesound.service import Service
from scene2hap.audio.sources.freesound.sounds import Sound, read_sounds
from scene2hap.common import checks
from scene2hap.common.calls import not_pickled
from scene2hap.common.secret import Secret
from scene2hap.common.settings import cache_folder
from scene2hap.common.warning import warn_of
from scene2hap.common.web import checked_base
from scene2hap.errors import AudioError, BackendUnavailable, ConfigError
from scene2hap.haptics import VibrationDescription

if TYPE_CHECKING:
    from scene2hap.common.web import Transport

_SORTED = ("duration", "created", "downloads", "rating")
SORTS = ("score", *(f"{what}_{way}" for what in _SORTED for way in ("desc", "asc")))

_PATIENCE = 2
"""Failed downloads of previews in a row after which their host counts as unavailable."""


class UnusableSound(UserWarning):
    """A found sound cannot be used, and the next one was used instead."""


@not_pickled(ConfigError, "it counts the requests that the service allows")
class Freesound:
    """Find up to five sounds on freesound.org by key words; without a hit, by fewer of these words.

    token : None takes the environment variable `token_env`, read at each search; licences : those that may be used, of
    "cc0", "by", "by-nc" and "sampling+"; candidates : their number, 1..5; max_duration_s : longest sound in a search
    [s]; sort : the service's order, "score" being relevance; cache : folder for searches, including those without hits,
    and for previews; timeout_s : for one answer; base_url, transport, clock, sleep : for tests.
    Freesound's API is free for non-commercial use; see its terms.
    Raises: ConfigError: a setting that cannot work.
    """

    def __init__(
        self,
        *,
        token: str | None = None,
        token_env: str = "FREESOUND_TOKEN",
        licences: Sequence[str] = ("cc0", "by"),
        candidates: int = MAX_CANDIDATES,
        max_duration_s: float = 30.0,
        sort: str = "score",
        cache: str | os.PathLike[str] | None = None,
        timeout_s: float = 30.0,
        base_url: str = "https://freesound.org/apiv2",
        transport: Transport | None = None,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], object] = time.sleep,
    ) -> None:
        number = checks.number
        number("max_duration_s", max_duration_s, "s", above=MIN_DURATION_S, at_most=MAX_CLIP_S, error=ConfigError)
        number("timeout_s", timeout_s, "s", above=0.0, error=ConfigError)
        if sort not in SORTS:
            raise ConfigError(f"sort is {sort!r}; it must be one of {', '.join(SORTS)}.")
        if not token_env:
            raise ConfigError("token_env is empty; it must be the name of an environment variable.")
        self._licences = cc.checked(licences)
        self._candidates = how_many("candidates", candidates)
        self._filter = f"duration:[{MIN_DURATION_S:g} TO {max_duration_s:g}] {cc.as_filter(self._licences)}"
        self._max_duration_s = float(max_duration_s)
        self._sort = sort
        self._service = Service(
            checked_base(base_url), Secret(token, token_env), timeout_s, transport, clock=clock, sleep=sleep
        )
        self._store = Store(cache if cache is not None else cache_folder("freesound"))

    def __repr__(self) -> str:
        return f"Freesound(licences={self._licences!r}, base_url={self._service.base_url!r})"

    def find(self, description: VibrationDescription) -> list[AudioClip]:
        """Return candidates in the service's order; empty if even the head noun finds nothing.

        A sound that cannot be used is skipped with an `UnusableSound` warning.
        Raises: BackendUnavailable: no answer, or no token; BadAnswer: an answer without sounds; ConfigError: the cache
        cannot be written.
        """
        for query in queries_for(description):
            clips = self._clips(query)
            if clips:
                return clips
        return []

    def _clips(self, query: str) -> list[AudioClip]:
        clips: list[AudioClip] = []
        away: BackendUnavailable | None = None
        n_away = 0
        for sound in self._search(query):
            if len(clips) == self._candidates or n_away == _PATIENCE:
                break
            try:
                clip = self._clip(sound, query)
            except (AudioError, BackendUnavailable) as cause:
                warn_of(f"skipped sound {sound.id}: {cause}", UnusableSound)
                if isinstance(cause, BackendUnavailable) and cause.retryable:
                    away, n_away = cause, n_away + 1
                continue
            n_away = 0
            if is_long_enough(clip):
                clips.append(clip)
        if not clips and away is not None:
            raise away
        return clips

    def _search(self, query: str) -> list[Sound]:
        """Return the results that may be used, from the cache or the service; new ones are cached first."""
        search = {"base_url": self._service.base_url, "query": query, "filter": self._filter, "sort": self._sort}
        name = f"searches/{digest(search)}.json"
        kept = self._store.document(name)
        sounds = read_sounds(kept.get("results")) if isinstance(kept, dict) and kept.get("asked") == search else None
        if sounds is None:
            sounds = self._service.search(query, self._filter, self._sort)
            results = [sound.model_dump(mode="json") for sound in sounds]
            self._store.keep_document(name, {"asked": search, "results": results})
        return [sound for sound in sounds if self._may_use(sound)]

    def _may_use(self, sound: Sound) -> bool:
        """Return True if a result has an allowed licence and duration. We check again instead of trusting the service's
        filter."""
        return (
            bool(sound.preview)
            and sound.licence in self._licences
            and MIN_DURATION_S <= sound.duration <= self._max_duration_s
        )

    def _clip(self, sound: Sound, query: str) -> AudioClip:
        """Return the preview, from the cache or the service; a new one is cached first."""
        name = f"previews/{sound.id}-{digest(sound.preview)[:12]}{'.ogg' if 'ogg' in sound.preview else '.mp3'}"
        credit = sound.credit(query)
        kept = self._store.clip(name, credit)
        return kept if kept is not None else self._store.keep_clip(name, self._service.preview(sound), credit)
