"""Swap two folders in one step, on systems that support this."""

from __future__ import annotations

import ctypes
import errno
import os
import sys
from collections.abc import Callable
from pathlib import Path

_HERE = -100  # AT_FDCWD of Linux: paths are relative to the working folder
_RENAME_EXCHANGE = 2  # Linux, <linux/fs.h>
_RENAME_SWAP = 2  # macOS, <sys/stdio.h>
_UNSUPPORTED = {errno.ENOSYS, errno.EINVAL, errno.ENOTSUP, errno.EOPNOTSUPP}
"""Errors of a kernel or a file system without this operation."""


def exchange(one: Path, other: Path) -> bool:
    """Swap two folders. Returns False, without any change, if the system cannot do this in one step.

    Both paths exist at every moment. Raises: OSError: as for a rename.
    """
    paths = os.fsencode(one), os.fsencode(other)
    call: Callable[..., int]
    arguments: tuple[object, ...]
    try:
        if sys.platform.startswith("linux"):
            call = ctypes.CDLL(None, use_errno=True).renameat2
            arguments = _HERE, paths[0], _HERE, paths[1], _RENAME_EXCHANGE
        elif sys.platform == "darwin":
            call, arguments = ctypes.CDLL(None, use_errno=True).renamex_np, (*paths, _RENAME_SWAP)
        else:
            return False
    except (AttributeError, OSError):  # the C library lacks this function
        return False
    if call(*arguments) == 0:
        return True
    code = ctypes.get_errno()
    if code in _UNSUPPORTED:
        return False
    raise OSError(code, os.strerror(code), str(other))
