"""The whole exception tree.

Every intentional error of scene2hap is a `Scene2HapError`. Most errors also inherit the fitting builtin exception, so
that ``except ValueError`` works for callers who do not know the tree::

    Scene2HapError
    ├── CallError (TypeError)                     a call with arguments that do not exist, are missing, or are too many
    ├── UnknownAttribute (AttributeError)         an attribute that does not exist; suggests a similar one
    ├── UnknownImport (ImportError)               `from scene2hap import` of a missing name; suggests a similar one
    ├── ReadOnlyAttribute (AttributeError)        an attribute that cannot be set
    ├── ConfigError (ValueError)                  a setting that cannot work
    │   ├── UnknownPlugin (LookupError)           a `kind` that is not registered
    │   └── MissingExtra (ImportError)            an optional dependency is not installed; names the extra
    ├── SceneError (ValueError)                   a scene that cannot be read or makes no sense
    │   ├── SceneFormatError                      the content does not match the file's name or header
    │   └── UnknownObject (KeyError)              an object id that the scene does not have
    ├── MaterialError (ValueError)                a material constant outside its bound
    │   └── UnknownMaterial (LookupError)         no row in the table under that name
    ├── ModelDomainError (ValueError)             a physical model used outside the range where it holds
    ├── AudioError (ValueError)                   a sound that cannot be used
    │   └── ClipError                             a haptic clip, or its file, that cannot be used
    ├── BundleError (ValueError)                  a bundle folder that cannot be read or written
    │   ├── BundleIncomplete                      a file is missing, cut short or was only partly changed
    │   ├── BundleVersionError                    written by a newer scene2hap
    │   └── BundleChanged                         another process has replaced the folder since it was read
    ├── ExportError (ValueError)                  an export that cannot be made
    ├── SessionError (ValueError)                 invalid input at play time
    ├── BridgeError (ValueError)                  an invalid message of a client
    │   └── UnknownSession (LookupError)          a session that the bridge does not have, or no longer
    ├── BackendError                              a language-model or sound service
    │   ├── BackendUnavailable (ConnectionError)  unreachable, or refuses; states if a retry can help
    │   │   └── RequestRejected                   refuses this one request: its pictures, its length or a parameter
    │   ├── BadAnswer (ValueError)                the answer fails its schema; carries the raw text
    │   │   └── AnswerRefused                     the model, or a filter before it, refuses to answer
    │   ├── BudgetExceeded                        the next call would exceed a limit
    │   └── ReplayMiss (LookupError)              no recorded answer for this request; carries the key
    └── DeviceError (OSError)                     an actuator
        ├── DeviceNotFound
        ├── DeviceLost
        └── DeviceTimeout (TimeoutError)

A message gives the value, its unit, the bound, and what to do next.
"""

from __future__ import annotations

import errno
import os
import sys
from dataclasses import FrozenInstanceError
from pathlib import Path
from traceback import walk_tb

_PACKAGE = __name__.partition(".")[0]


class Scene2HapError(Exception):
    """Root of every error raised by scene2hap."""


class CallError(Scene2HapError, TypeError):
    """A call with arguments that the function does not have, or without required ones."""


class UnknownAttribute(Scene2HapError, AttributeError):
    """An attribute that the object does not have."""


class UnknownImport(Scene2HapError, ImportError):
    """A name that `from scene2hap import` does not find."""


class ReadOnlyAttribute(Scene2HapError, FrozenInstanceError):
    """An attribute that cannot be set."""


class ConfigError(Scene2HapError, ValueError):
    """A setting that cannot work."""


class UnknownPlugin(ConfigError, LookupError):
    """A `kind` that is not registered, in scene2hap or in an installed package."""


class MissingExtra(ConfigError, ImportError):
    """An optional dependency is not installed. The message names the extra that installs it."""


class SceneError(Scene2HapError, ValueError):
    """A scene that cannot be read or makes no sense."""


class SceneFormatError(SceneError):
    """A scene file whose content does not match its name or header."""


class UnknownObject(SceneError, KeyError):
    """An object id that the scene does not have."""

    def __str__(self) -> str:
        return Exception.__str__(self)  # KeyError would show the message in quotes


class MaterialError(Scene2HapError, ValueError):
    """A material constant outside its physical bound."""


class UnknownMaterial(MaterialError, LookupError):
    """No row of the material table has that name or alias."""


class ModelDomainError(Scene2HapError, ValueError):
    """A physical model was used outside the range where it holds."""


class AudioError(Scene2HapError, ValueError):
    """A sound that cannot be used: empty, not finite, unreadable."""


class ClipError(AudioError):
    """A haptic clip that cannot be used: the file has another format, or breaks a rule of its format."""


class BundleError(Scene2HapError, ValueError):
    """A bundle folder that cannot be read or written."""


class BundleIncomplete(BundleError):
    """A bundle folder with a missing or incomplete file."""


class BundleVersionError(BundleError):
    """A bundle folder written by a newer scene2hap."""


class BundleChanged(BundleError):
    """A bundle folder that another process has replaced since it was read."""


class ExportError(Scene2HapError, ValueError):
    """An export that cannot be made: a signal, a setting or a folder that does not fit."""


class SessionError(Scene2HapError, ValueError):
    """Invalid input at play time."""


class BridgeError(Scene2HapError, ValueError):
    """An invalid message of a bridge's client."""


class UnknownSession(BridgeError, LookupError):
    """A session that the bridge does not have: it ended, or the server was restarted."""


class BackendError(Scene2HapError):
    """A language-model or sound service failed."""


class BackendUnavailable(BackendError, ConnectionError):
    """The service could not be reached, or refused the request.

    `retryable` is True if the same request may succeed later. `retry_after_s` is the wait that the service stated [s].
    """

    def __init__(self, message: str, *, retryable: bool = False, retry_after_s: float | None = None) -> None:
        super().__init__(message)
        self.retryable = retryable
        self.retry_after_s = retry_after_s


class RequestRejected(BackendUnavailable):
    """The service rejected this request: its pictures, its length or a parameter. Others may be answered."""


class BadAnswer(BackendError, ValueError):
    """An answer that does not fit its schema.

    `raw_text` is the answer of the service.
    """

    def __init__(self, message: str, raw_text: str = "") -> None:
        super().__init__(message)
        self.raw_text = raw_text


class AnswerRefused(BadAnswer):
    """A model refuses to answer, or a filter withholds the question or the answer.

    A repetition is refused again: change the pictures, the question or the model.
    """


class BudgetExceeded(BackendError):
    """A call was not made, since a limit on calls, tokens or cost was reached."""


class ReplayMiss(BackendError, LookupError):
    """A recording has no answer for a request.

    `key` identifies the request.
    """

    def __init__(self, message: str, key: str = "") -> None:
        super().__init__(message)
        self.key = key


class DeviceError(Scene2HapError, OSError):
    """An actuator failed."""


class DeviceNotFound(DeviceError):
    """No device has that name or index."""


class DeviceLost(DeviceError):
    """An open device was disconnected."""


class DeviceTimeout(DeviceError, TimeoutError):
    """A device did not answer in time."""


def reason_of(cause: BaseException) -> str:
    """Return the reason of a caught error for a message that names the file.

    The text of an OSError repeats the file and has a number: "[Errno 2] No such file or directory: 'a.csv'". Its reason
    does not name the part of a path that is a file, or a broken link, in place of a folder. That of a
    UnicodeDecodeError names a codec.
    """
    if isinstance(cause, UnicodeDecodeError):
        return f"byte {cause.start} is {cause.object[cause.start]:#04x}, which is not UTF-8; save the text as UTF-8"
    if isinstance(cause, FileExistsError | NotADirectoryError) and (part := _no_folder(cause)):
        return f"{part} is not a folder"
    return cause.strerror if isinstance(cause, OSError) and cause.strerror else str(cause)


def _no_folder(cause: OSError) -> str:
    """Return the part of a path that is there and is no folder, such as a.csv of a.csv/b; "" if there is none."""
    if not isinstance(cause.filename, str) or cause.filename2 is not None:  # a rename has both
        return ""
    path = Path(cause.filename)
    part = next((one for one in (path, *path.parents) if os.path.lexists(one)), None)
    return "" if part is None or os.path.isdir(part) else str(part)


def failure_of(problem: Exception) -> str:
    """Return the message of one of our errors; for any other error its type, message, and the line that raised it.

    The line is the innermost one outside scene2hap, where a part of somebody else failed.
    """
    if isinstance(problem, Scene2HapError):
        return str(problem)
    at = ""
    for frame, line in walk_tb(problem.__traceback__):
        if frame.f_globals.get("__name__", "").partition(".")[0] != _PACKAGE:
            at = f" at {frame.f_code.co_filename}:{line}"
    return f"{problem!r}{at}"


_TO_DO = {
    **dict.fromkeys((errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC), errno.EFBIG), "Make room on its disk."),
    errno.ENAMETOOLONG: "Give a shorter name.",
}

ACCESS_DENIED, SHARING_VIOLATION, LOCK_VIOLATION = 5, 32, 33
"""`winerror` of Windows: no right, or an open file in a folder that is moved; an open file; a locked one."""

_TO_DO_ON_WINDOWS = {
    ACCESS_DENIED: "Close the program that has it or a file in it open, or remove its write protection.",
    **dict.fromkeys((SHARING_VIOLATION, LOCK_VIOLATION), "Close the program that has it open."),
    # ERROR_INVALID_NAME, and ERROR_DIRECTORY of a folder
    **dict.fromkeys((123, 267), 'Use no < > : " | ? * in a name, and no name of a device, as con, aux or nul.'),
    206: "Give a shorter path.",  # ERROR_FILENAME_EXCED_RANGE
}

_LONGEST_PATH_ON_WINDOWS = 259
"""Characters of a path, unless its registry allows more (documented as MAX_PATH, with the final zero)."""


def unwritable(what: object, cause: OSError, otherwise: str = "Choose a folder that exists and is yours.") -> str:
    """Return the message for a file or folder that cannot be written: its name, the reason, and what to do.

    Parameters: otherwise : what to do, unless the disk is full, the name or path is too long, or Windows says that a
    program has the file open.
    """
    to_do = _TO_DO_ON_WINDOWS.get(getattr(cause, "winerror", None) or 0) or _TO_DO.get(cause.errno or 0, otherwise)
    n_characters = len(os.path.abspath(cause.filename)) if isinstance(cause.filename, str) else 0
    if sys.platform == "win32" and isinstance(cause, FileNotFoundError) and n_characters > _LONGEST_PATH_ON_WINDOWS:
        to_do = f"A path in it has {n_characters} characters; Windows allows {_LONGEST_PATH_ON_WINDOWS}. Shorten it."
    return f"{what} cannot be written: {reason_of(cause).removesuffix('.')}. {to_do}"
