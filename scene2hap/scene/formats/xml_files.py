"""XML files of models from others: bytes, elements and depth are bounded, and document types are refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from xml.parsers import expat

from scene2hap.errors import SceneError, SceneFormatError
from scene2hap.scene import limits
from scene2hap.scene.files import read_bytes

Start = Callable[[str, dict[str, str], int, int], None]
"""Called at the start of an element with its tag, attributes, line, and the number of elements around it."""


_DECLARED_LATE = expat.errors.codes[expat.errors.XML_ERROR_MISPLACED_XML_PI]


def walk_xml(
    path: Path, kind: str, most_bytes: int, start: Start, end: Callable[[str], object], *, encoding: str | None = None
) -> None:
    """Call `start` and `end` for each element of an XML file of a kind such as "URDF"; text is ignored.

    Parameters: encoding : replaces the encoding that the file declares.
    Raises: SceneFormatError: it is not well-formed, or has a document type. SceneError: it is missing or too large.
    """
    data = read_bytes(path)
    if len(data) > most_bytes:
        raise SceneError(f"{path.name!r} has {len(data):,} bytes; {kind} of up to {most_bytes:,} is read.")
    parser = expat.ParserCreate(encoding)
    n_elements = depth = 0

    def started(tag: str, attributes: dict[str, str]) -> None:
        nonlocal n_elements, depth
        n_elements += 1
        limits.at_most(f"the number of elements in {path.name!r}", n_elements, "MAX_NODES")
        limits.at_most(f"the depth of {path.name!r}", depth, "MAX_DEPTH")
        start(tag, attributes, parser.CurrentLineNumber, depth)
        depth += 1

    def ended(tag: str) -> None:
        nonlocal depth
        depth -= 1
        end(tag)

    def refuse(*declared: object) -> None:
        raise SceneFormatError(f"{path.name!r} has a document type, which {kind} does not need; remove <!DOCTYPE>.")

    parser.StartDoctypeDeclHandler, parser.StartElementHandler, parser.EndElementHandler = refuse, started, ended
    try:
        parser.Parse(data, True)
    except SceneError:
        raise
    # ValueError and LookupError: an encoding that does not exist, or that has several bytes per character.
    except (expat.ExpatError, ValueError, LookupError) as cause:
        is_late = getattr(cause, "code", None) == _DECLARED_LATE
        hint = " The first characters of the file must be <?xml; remove what is before them." if is_late else ""
        raise SceneFormatError(f"{path.name!r} is not well-formed XML: {cause}.{hint}") from cause
