"""Numbers with their nouns in messages: "1 file", "2 files"."""


def counted(number: int, noun: str) -> str:
    """Return a number with its noun, which gets an s unless there is exactly one."""
    return f"{number:,} {noun}" if number == 1 else f"{number:,} {noun}s"
