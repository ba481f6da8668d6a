"""Settings of a bridge: addresses, tokens and the root folder."""

from pathlib import Path

import pytest

from scene2hap.bridge import BridgeConfig
from scene2hap.bridge.config import is_loopback
from scene2hap.errors import ConfigError


def test_only_loopback_needs_no_token() -> None:
    assert BridgeConfig().token is None
    for host in ("0.0.0.0", "192.168.1.7", "::", "haptics.example"):
        with pytest.raises(ConfigError, match="needs a token"):
            BridgeConfig(host=host)
        assert BridgeConfig(host=host, token="a word").host == host


def test_empty_token_counts_as_no_token() -> None:
    with pytest.raises(ConfigError, match="token is empty"):
        BridgeConfig(token="")


def test_a_token_is_not_shown() -> None:
    config = BridgeConfig(token="a very secret word")
    assert "secret word" not in repr(config)
    assert "secret word" not in str(config)


def test_loopback_by_name_and_number() -> None:
    assert all(map(is_loopback, ("localhost", "127.0.0.1", "127.8.9.1", "::1", "[::1]")))
    assert not any(map(is_loopback, ("0.0.0.0", "10.0.0.1", "localhost.evil.example", "", "127.0.0.1.evil.example")))


def test_root_must_be_a_folder(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="must be a folder"):
        BridgeConfig(root=tmp_path / "none")
    assert BridgeConfig(root=tmp_path).root == tmp_path.resolve()


def test_settings_from_a_file_with_the_tables_of_the_command_line(tmp_path: Path) -> None:
    file = tmp_path / "bridge.toml"
    file.write_text(f'[bridge]\nroot = {str(tmp_path)!r}\nheartbeat_s = 5.0\n[session]\nbands = "around"\n')
    config = BridgeConfig.parse(file)
    assert (config.root, config.heartbeat_s) == (tmp_path.resolve(), 5.0)
