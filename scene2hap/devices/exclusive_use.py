"""Exclusive use of a sink, file or port within this process.

If two sinks write one file, or two sessions play on one sink, samples of the first are lost without an error. A claim
has a key. It ends with `give_back`, or when its holder no longer exists.
"""

from __future__ import annotations

import os
from collections.abc import Hashable
from weakref import WeakValueDictionary

from scene2hap.common import checks
from scene2hap.common.forks import lock_of_process
from scene2hap.devices.protocol import ActuatorSink, parts_of
from scene2hap.errors import ConfigError, DeviceError

_LOCK = lock_of_process()
_HELD: WeakValueDictionary[Hashable, object] = WeakValueDictionary()


def claim(key: Hashable, holder: object, refusal: str) -> None:
    """Claim a key until `give_back`. Its holder may claim it again.

    Raises: DeviceError: another holder has it; `refusal` is the message.
    """
    with _LOCK:
        if _HELD.get(key, holder) is not holder:
            raise DeviceError(refusal)
        _HELD[key] = holder


def give_back(key: Hashable, holder: object) -> None:
    """Release a key; no effect if another holder has it."""
    with _LOCK:
        if _HELD.get(key) is holder:
            del _HELD[key]


def claim_sink(sink: ActuatorSink, holder: object) -> None:
    """Claim a sink and all sinks inside it, or none of them.

    Raises: DeviceError: another session plays on one of them.
    """
    parts = parts_of(sink)
    try:
        for part in parts:
            refusal = (
                f"another session plays on this {type(part).__name__} already, and what it was given would be lost. "
                "Stop that session first, or give each a sink of its own; TeeSink plays one session on several sinks."
            )
            claim(("sink", id(part)), holder, refusal)
    except DeviceError:
        give_back_sink(sink, holder)
        raise


def give_back_sink(sink: ActuatorSink, holder: object) -> None:
    """Release a sink and all sinks inside it."""
    for part in parts_of(sink):
        give_back(("sink", id(part)), holder)


def port_key(port: str) -> Hashable:
    """Return the canonical key of a serial port, with links resolved. Raises: ConfigError: it is no text."""
    checks.text("port", port, error=ConfigError)
    return ("port", os.path.realpath(port) if os.path.exists(port) else port)
