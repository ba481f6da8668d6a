"""The command of a client, as `scene2hap bridge --check` gets it."""

import pytest

from scene2hap.cli.bridge import words_of
from scene2hap.errors import ConfigError


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (r"C:\games\client.exe --port 1", [r"C:\games\client.exe", "--port", "1"]),
        (r'"C:\Program Files\My Game\client.exe" "a b"', [r"C:\Program Files\My Game\client.exe", "a b"]),
        (r'python "D:\Räume\client.py" it\'s', ["python", r"D:\Räume\client.py", r"it\'s"]),
        ("client #1", ["client", "#1"]),
        ("", []),
    ],
)
def test_backslashes_of_windows_stay_and_quotes_go(command: str, words: list[str]) -> None:
    assert words_of(command, is_posix=False) == words


def test_posix_words_are_those_of_a_shell() -> None:
    assert words_of(r"'my client' a\ b \"c\"", is_posix=True) == ["my client", "a b", '"c"']


def test_a_quote_without_an_end_is_an_error() -> None:
    with pytest.raises(ConfigError, match="cannot be split into words"):
        words_of('"C:\\client.exe', is_posix=False)
