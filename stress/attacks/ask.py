"""Child of the servers' family: ask a server once, or read a sound; end with 0 or with one sentence of ours.

python ask.py openai|ollama|page|sound WHERE
"""

from __future__ import annotations

import asyncio
import base64
import logging
import sys
from pathlib import Path
from urllib.parse import quote

from scene2hap.errors import Scene2HapError
from scene2hap.printable import printable

KEY = "sk-attack-0123456789/abcdef+ghij=="


def main(kind: str, where: str) -> None:
    """Ask; the answer is shown, as a log would show it."""
    if kind == "sound":
        from scene2hap.audio.files import read_clip

        print(len(read_clip(Path(where)).samples))
    elif kind == "page":
        from scene2hap import web

        print(printable(web.get(where, web.Limits(2.0, 1 << 20)).text[:1000]))
    else:
        from scene2hap.llm.local import LocalBackend
        from scene2hap.llm.protocol import LLMRequest

        schema = {"type": "object", "properties": {"scene_category": {"type": "string"}}, "additionalProperties": False}
        request = LLMRequest("scene_analyzer", "", "What kind of place is this?", {}, schema, "1")
        backend = LocalBackend("m", base_url=where, dialect=kind, timeout_s=2.0, api_key=KEY)  # type: ignore[arg-type]
        print(printable(asyncio.run(backend.complete(request)).text[:1000]))


if __name__ == "__main__":
    logging.basicConfig(level=logging.WARNING)
    try:
        main(*sys.argv[1:])
    except Scene2HapError as error:
        told = f"{error} {getattr(error, 'raw_text', '')}"
        forms = (KEY, quote(KEY, safe=""), base64.b64encode(KEY.encode()).decode()[:-4], KEY.encode().hex())
        if any(form in told for form in forms):
            sys.exit(f"the key is shown: {told}")
        print(f"scene2hap: error: {printable(str(error))[:2000]}", file=sys.stderr)
        sys.exit(1)
