from pathlib import Path

import pytest

from scene2hap.baking import BakeConfig
from scene2hap.errors import ConfigError


def test_a_user_without_a_home_gets_advice(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def homeless() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setattr(Path, "home", homeless)
    for variable in ("XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(variable, raising=False)
    with pytest.raises(ConfigError, match="XDG_CACHE_HOME"):
        BakeConfig()
    BakeConfig(cache_dir=tmp_path)
