"""Parameters of a request that a model may reject: they are renamed or no longer sent."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from scene2hap.common.warning import warn_of
from scene2hap.common.web import WebReply
from scene2hap.errors import BackendUnavailable
from scene2hap.llm.backends.http_errors import ServerError, failure, server_error
from scene2hap.llm.protocol import BackendWarning

_OTHER_NAMES = {
    "temperature": None,
    "top_p": None,
    "seed": None,
    "service_tier": None,
    "max_tokens": "max_completion_tokens",
}
"""Parameters that some models reject, and the name that these models accept instead; None for no such name. Models that
always reason reject temperature and top_p. Some models are not offered in the flex tier."""

_QUOTED = re.compile(r"['\"`](\w+)['\"`]")


class OptionalParameters:
    """Which optional parameters a model has rejected."""

    def __init__(self) -> None:
        self._rejected: set[str] = set()

    def adapted(self, body: dict[str, Any]) -> dict[str, Any]:
        """Return the body of a request without the rejected parameters, or with their other names."""
        renamed = {_OTHER_NAMES[name] if name in self._rejected else name: value for name, value in body.items()}
        return {name: value for name, value in renamed.items() if name is not None}

    def learns(self, reply: WebReply, model: str, sent: Mapping[str, Any] | None = None) -> bool:
        """Return True if a reply rejects an optional parameter. Warns: BackendWarning: once for each parameter.

        A parameter that is not in `sent` was dropped before, so the result is False.
        """
        blamed = _blamed(server_error(reply)) if reply.status == 400 else ""
        if blamed not in _OTHER_NAMES or (sent is not None and blamed not in sent):
            return False
        self._reject(blamed, model, failure(reply))
        return True

    def _reject(self, parameter: str, model: str, reason: BackendUnavailable) -> None:
        if parameter in self._rejected:
            return  # a concurrent call has already dropped it
        self._rejected.add(parameter)
        instead = _OTHER_NAMES[parameter]
        if parameter == "service_tier":
            what = "it is no longer sent, so answers cost the standard price"
        else:
            what = f"it is sent as {instead!r}" if instead else "it is no longer sent, so answers may vary more"
        warn_of(f"{model} does not take {parameter!r}; {what}. {reason}", BackendWarning)


def _blamed(error: ServerError) -> str:
    """Return the parameter that an error rejects. Gateways leave `param` empty, and quote the parameter's name.

    The first name counts: "'max_tokens' is not supported, use 'max_completion_tokens'". An error about a value, as
    "max_tokens is too large: 200000", rejects no parameter.
    """
    if "too large" in error.message:
        return ""
    if error.param:
        return error.param
    quoted = _QUOTED.search(error.message)
    return quoted[1] if quoted is not None else ""
