"""Freesound's API: search for sounds, and download of previews.

Source: Freesound API documentation, "Search", "Authentication", "Throttling" (freesound.org/docs/api).
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

from scene2hap.audio.sources.disk_cache import plain_line
from scene2hap.audio.sources.freesound.rate_limit import MINUTE_S, RateLimit
from scene2hap.audio.sources.freesound.sounds import FIELDS, Sound, read_sounds
from scene2hap.common import web
from scene2hap.common.secret import Secret
from scene2hap.errors import BackendError, BackendUnavailable, BadAnswer

RESULTS_ASKED = 15
"""Results per search: three times the candidates, since some previews are too short or broken; the API's default."""
MAX_ANSWER_BYTES = 2_000_000
MAX_PREVIEW_BYTES = 20_000_000

_WAITS_S = (0.5, 1.0)
_REST_S = 120.0
"""Pause after a failure of the service [s] (assumed)."""
_LONGEST_WAIT_S = 120.0
_HINTS = {
    401: "Check the token in {variable}; freesound.org/apiv2/apply gives one.",
    403: "Check what the token in {variable} is allowed to do.",
    404: "Check base_url.",
}


class _NotUnderstood(BackendUnavailable):
    """One query was refused; the next one may succeed."""


@dataclass
class Service:
    """Sends requests within the rate limit, retries if that can help, and pauses after failures.

    The token is sent only in the header of requests below `base_url`. Therefore a redirect of the API is an error, and
    previews, which may be on another host, are fetched without the token.
    """

    base_url: str
    token: Secret
    timeout_s: float
    transport: web.Transport | None = None
    clock: Callable[[], float] = time.monotonic
    sleep: Callable[[float], object] = time.sleep
    _failure: tuple[float, BackendError] | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        self._rate = RateLimit(self.clock, self.sleep)

    def search(self, query: str, filter_: str, sort: str) -> list[Sound]:
        """Return the results in the service's order; empty if nothing matches.

        Raises: BackendUnavailable: no answer, states whether a retry can help; BadAnswer: the answer lacks the list of
        sounds that the documentation promises.
        """
        if not self.token.reveal():
            raise BackendUnavailable(
                f"no Freesound token. Set {self.token.variable}; freesound.org/apiv2/apply gives one."
            )
        if self._failure is not None and self.clock() < self._failure[0]:
            raise self._failure[1]
        self._failure = None
        params = {
            "query": query,
            "filter": filter_,
            "sort": sort,
            "fields": FIELDS,
            "page_size": str(RESULTS_ASKED),
        }
        try:
            return self._read(self._ask(params))
        except BackendError as failure:
            self._remember(failure)
            raise

    def preview(self, sound: Sound) -> bytes:
        """Return the encoded preview. Raises: BackendUnavailable: it cannot be downloaded."""
        reply = web.get(sound.preview, web.Limits(self.timeout_s, MAX_PREVIEW_BYTES), transport=self.transport)
        if reply.status != 200:
            raise BackendUnavailable(
                f"the preview of sound {sound.id} is not there (status {reply.status}).", retryable=reply.status >= 500
            )
        return reply.content

    def _ask(self, params: dict[str, str]) -> web.WebReply:
        """Send a search, and repeat it up to twice if that can help."""
        for wait_s in _WAITS_S:
            try:
                return self._ask_once(params)
            except BackendUnavailable as failure:
                if not failure.retryable:
                    raise
                if failure.retry_after_s is None:
                    self.sleep(wait_s)
                else:
                    self._rate.block(failure.retry_after_s)
        return self._ask_once(params)

    def _ask_once(self, params: dict[str, str]) -> web.WebReply:
        self._rate.take()
        reply = web.get(
            f"{self.base_url}/search/",
            web.Limits(self.timeout_s, MAX_ANSWER_BYTES),
            params=params,
            authorization=lambda: f"Token {self.token.reveal()}",
            scrub=self.token.scrub,
            transport=self.transport,
        )
        reply = reply.scrubbed(self.token.scrub)  # otherwise it could reach titles and credits
        if reply.status != 200:
            raise self._error(reply)
        return reply

    def _read(self, reply: web.WebReply) -> list[Sound]:
        document = reply.json()
        sounds = read_sounds(document.get("results")) if isinstance(document, dict) else None
        if sounds is None or (not sounds and document["results"]):
            raise BadAnswer(
                f"{reply.url} answered without the list of sounds that it promises. Check base_url.",
                raw_text=reply.text[:2000],
            )
        return sounds

    def _error(self, reply: web.WebReply) -> BackendUnavailable:
        document = reply.json()
        detail = document.get("detail") if isinstance(document, dict) else None
        said = plain_line(detail) if isinstance(detail, str) else "nothing more"
        text = f"{reply.url} answered {reply.status}: {said.rstrip('.')}."
        if reply.status == 429 and "day" in said:
            return BackendUnavailable(f"{text} Bake again tomorrow; what was found is kept.", retryable=False)
        if reply.status == 429:
            wait_s = _wait_s(reply.headers.get("retry-after", ""))
            return BackendUnavailable(text, retryable=wait_s <= _LONGEST_WAIT_S, retry_after_s=wait_s)
        if reply.status == 400:
            return _NotUnderstood(text, retryable=False)
        if 300 <= reply.status < 400:
            return BackendUnavailable(f"{text} The token is not sent elsewhere; check base_url.", retryable=False)
        hint = _HINTS.get(reply.status, "").format(variable=self.token.variable)
        return BackendUnavailable(f"{text} {hint}".strip(), retryable=reply.status >= 500)

    def _remember(self, failure: BackendError) -> None:
        """Send no requests for a while, or none at all if only a person can help."""
        if isinstance(failure, _NotUnderstood):
            return
        rest_s = _REST_S
        if isinstance(failure, BackendUnavailable):
            for_now = failure.retryable or failure.retry_after_s is not None
            rest_s = max(rest_s, failure.retry_after_s or 0.0) if for_now else float("inf")
        self._failure = (self.clock() + rest_s, failure)


def _wait_s(retry_after: str) -> float:
    return float(retry_after) if retry_after.isascii() and retry_after.isdigit() else MINUTE_S
