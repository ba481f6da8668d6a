"""The whole exception tree.

Every error that scene2hap raises on purpose is a `Scene2HapError`; most also inherit the builtin that fits, so
that ``except ValueError`` keeps working for people who do not know the tree::

    Scene2HapError
    ├── CallError (TypeError)               a call with arguments that do not exist, are missing, or are too many
    ├── UnknownAttribute (AttributeError)   an attribute that does not exist; names the nearest
    ├── ReadOnlyAttribute (AttributeError)  an attribute that cannot be set
    ├── ConfigError (ValueError)            a setting that cannot work
    │   ├── UnknownPlugin (LookupError)     a `kind` that nobody registered
    │   └── MissingExtra (ImportError)      an optional dependency is not installed; names the extra
    ├── SceneError (ValueError)             a scene that cannot be read or makes no sense
    │   ├── SceneFormatError                the file is not what it says it is
    │   └── UnknownObject (KeyError)        an object id that the scene does not have
    ├── MaterialError (ValueError)          a material constant outside its bound
    │   └── UnknownMaterial (LookupError)   no row in the table under that name
    ├── ModelDomainError (ValueError)       a physical model used outside the range where it holds
    ├── AudioError (ValueError)             a sound that cannot be used
    │   └── ClipError                       a haptic clip, or its file, that cannot be used
    ├── BundleError (ValueError)            a bundle folder that cannot be read or written
    │   ├── BundleIncomplete                a file is missing, cut short or was changed by halves
    │   └── BundleVersionError              written by a newer scene2hap
    ├── ExportError (ValueError)            an export that cannot be made
    ├── SessionError (ValueError)           play-time input that cannot be honoured
    ├── BridgeError (ValueError)            a message of a client that cannot be honoured
    │   └── UnknownSession (LookupError)    a session that the bridge does not have, or no longer
    ├── BackendError                        a language-model or sound service
    │   ├── BackendUnavailable (ConnectionError)  away, or refuses; tells whether trying again can help
    │   ├── BadAnswer (ValueError)          the answer fails its schema; carries the raw text
    │   │   └── AnswerRefused               the model or a filter before it will not answer
    │   ├── BudgetExceeded                  the next call would break a limit that was set
    │   └── ReplayMiss (LookupError)        no recorded answer for this request; carries the key
    └── DeviceError (OSError)               an actuator
        ├── DeviceNotFound
        ├── DeviceLost
        └── DeviceTimeout (TimeoutError)

A message gives the value, its unit, the bound, and what to do next.
"""

from __future__ import annotations

from dataclasses import FrozenInstanceError


class Scene2HapError(Exception):
    """Root of every error raised by scene2hap."""


class CallError(Scene2HapError, TypeError):
    """A call with arguments that the function does not have, or without those that it needs."""


class UnknownAttribute(Scene2HapError, AttributeError):
    """An attribute that the object does not have."""


class ReadOnlyAttribute(Scene2HapError, FrozenInstanceError):
    """An attribute that cannot be set."""


class ConfigError(Scene2HapError, ValueError):
    """A setting that cannot work."""


class UnknownPlugin(ConfigError, LookupError):
    """A `kind` that neither scene2hap nor an installed package registered."""


class MissingExtra(ConfigError, ImportError):
    """An optional dependency is not installed; the message names the extra that brings it."""


class SceneError(Scene2HapError, ValueError):
    """A scene that cannot be read or makes no sense."""


class SceneFormatError(SceneError):
    """A scene file that is not what its name or header says."""


class UnknownObject(SceneError, KeyError):
    """An object id that the scene does not have."""

    __str__ = Exception.__str__  # KeyError's own shows the sentence in quotes


class MaterialError(Scene2HapError, ValueError):
    """A material constant outside its physical bound."""


class UnknownMaterial(MaterialError, LookupError):
    """No row of the material table carries that name or alias."""


class ModelDomainError(Scene2HapError, ValueError):
    """A physical model was used outside the range where it holds."""


class AudioError(Scene2HapError, ValueError):
    """A sound that cannot be used: empty, not finite, unreadable."""


class ClipError(AudioError):
    """A haptic clip that cannot be used: its file is none, or breaks a rule of its format."""


class BundleError(Scene2HapError, ValueError):
    """A bundle folder that cannot be read or written."""


class BundleIncomplete(BundleError):
    """A bundle folder that lacks a file or holds one that was not written to its end."""


class BundleVersionError(BundleError):
    """A bundle folder written by a newer scene2hap."""


class ExportError(Scene2HapError, ValueError):
    """An export that cannot be made: a signal, a setting or a folder that does not fit."""


class SessionError(Scene2HapError, ValueError):
    """Play-time input that cannot be honoured."""


class BridgeError(Scene2HapError, ValueError):
    """A message of a client that a bridge cannot honour."""


class UnknownSession(BridgeError, LookupError):
    """A session that the bridge does not have: it ended, or the server was restarted."""


class BackendError(Scene2HapError):
    """A language-model or sound service failed."""


class BackendUnavailable(BackendError, ConnectionError):
    """The service could not be reached or refused to serve.

    `retryable` tells whether the same request may succeed later, `retry_after_s` [s] when, if the service said so.
    """

    def __init__(self, message: str, *, retryable: bool = False, retry_after_s: float | None = None) -> None:
        super().__init__(message)
        self.retryable = retryable
        self.retry_after_s = retry_after_s


class BadAnswer(BackendError, ValueError):
    """An answer that does not fit its schema.

    `raw_text` is what the service said.
    """

    def __init__(self, message: str, raw_text: str = "") -> None:
        super().__init__(message)
        self.raw_text = raw_text


class AnswerRefused(BadAnswer):
    """A model that will not answer, or a filter that withholds the question or the answer.

    The same question is refused again: change what it shows or asks, or the model.
    """


class BudgetExceeded(BackendError):
    """A call was not made, since a limit on calls, tokens or cost is reached."""


class ReplayMiss(BackendError, LookupError):
    """A replay has no recording of a request.

    `key` identifies the request.
    """

    def __init__(self, message: str, key: str = "") -> None:
        super().__init__(message)
        self.key = key


class DeviceError(Scene2HapError, OSError):
    """An actuator failed."""


class DeviceNotFound(DeviceError):
    """No device of that name or index."""


class DeviceLost(DeviceError):
    """A device that was open has gone."""


class DeviceTimeout(DeviceError, TimeoutError):
    """A device did not answer in time."""
