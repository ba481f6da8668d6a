"""Settings of a bridge."""

from __future__ import annotations

import ipaddress
import os
from pathlib import Path
from typing import Any, Self

from pydantic import Field, field_validator, model_validator

from scene2hap.common import checks
from scene2hap.common.printable import quoted
from scene2hap.common.secret import Secret
from scene2hap.common.settings import Settings
from scene2hap.errors import ConfigError

PORT = 7862


class BridgeConfig(Settings):
    """Settings of a bridge.

    host : the interface to listen on; one that is not loopback needs a token. port : 0 for a free one.
    token : the secret that `hello` must carry, None for no token.
    root : the folder whose scenes and bundles clients may read and write, None for none.
    origins : web pages that may connect, besides pages on loopback, such as "https://game.example".
    sink : a kind of sink, or a mapping with `kind`, for the output of one session; with None, clients play the gains.
    udp : True to accept frames as datagrams too.
    bake, session : settings of bakes and sessions; clients can override them.
    heartbeat_s : time between two pings. max_message_bytes : of one message. max_clients : at the same time.
    """

    of_what = "bridge"

    host: str = "127.0.0.1"
    port: int = Field(default=PORT, ge=0, le=65535)
    token: Secret | None = None
    root: Path | None = None
    origins: tuple[str, ...] = ()
    sink: Any = None
    udp: bool = False
    bake: dict[str, Any] = Field(default_factory=dict)
    session: dict[str, Any] = Field(default_factory=dict)
    heartbeat_s: float = Field(default=2.0, ge=0.05, le=60.0)
    max_message_bytes: int = Field(default=32 << 20, ge=1 << 16, le=1 << 30)
    max_clients: int = Field(default=16, ge=1, le=1000)

    @field_validator("token", mode="before")
    @classmethod
    def _kept_secret(cls, token: object) -> object:
        if token is None or isinstance(token, Secret):
            return token
        return Secret(token)  # type: ignore[arg-type]  # Secret rejects other types

    @field_validator("root")
    @classmethod
    def _is_folder(cls, root: Path | None) -> Path | None:
        if root is not None and not os.path.isdir(root):
            raise ConfigError(f"root is {quoted(root)}; it must be a folder. Create it first.")
        return None if root is None else root.resolve()

    @model_validator(mode="after")
    def _has_a_token_where_others_reach_it(self) -> Self:
        if self.token is not None and not self.token.reveal():
            raise ValueError("token is empty; leave it out, or give a text of your own")
        if not is_loopback(self.host) and self.token is None:
            raise ValueError(
                f"host is {checks.represented(self.host)}, which others reach; such a bridge needs a token. Give one "
                "with --token, or listen on 127.0.0.1"
            )
        return self


def is_loopback(host: str) -> bool:
    """Return True if only this machine reaches an interface, given by name or address."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return False
