"""A bake in a separate process, so that it can be cancelled and does not slow down running sessions.

Reads one JSON object from standard input (`scene`, `is_sent`, `target`, `config`, `user_prompt`, `pictures`). Writes
one JSON object per line: `progress` with stage, item, done and of; `warning` with its text; at the end `objects`, or
`error` with kind and message.
"""

from __future__ import annotations

import json
import sys
import warnings
from pathlib import Path
from threading import Lock
from typing import Any

from scene2hap.baking import BakeConfig, bake
from scene2hap.bundle import HapticBundle
from scene2hap.common import checks
from scene2hap.errors import Scene2HapError
from scene2hap.llm.wrappers import is_remote
from scene2hap.scene.capture import capture_images
from scene2hap.scene.capture.given_pictures import GivenPictures
from scene2hap.scene.files import read_bytes
from scene2hap.scene.load import load_scene
from scene2hap.scene.snapshot import SceneSnapshot


def main() -> None:
    """Bake the request on standard input."""
    checks.speak_json()  # the client reads the errors
    answers = sys.stdout
    sys.stdout = sys.stderr  # so that a plug-in's prints do not mix with the answers
    writing = Lock()  # warnings come from several threads, and two lines in one would end the bake

    def tell(document: dict[str, Any]) -> None:
        with writing:
            print(json.dumps(document), file=answers, flush=True)

    def show(message: Warning | str, category: type[Warning], *rest: Any, **more: Any) -> None:
        if issubclass(category, UserWarning):
            tell({"warning": str(message)})
        else:  # of other libraries
            shown(message, category, *rest, **more)

    shown, warnings.showwarning = warnings.showwarning, show
    wanted = json.load(sys.stdin)
    try:
        bundle = baked(wanted, lambda *what: tell({"progress": what}))
        bundle.save(wanted["target"])
    except Scene2HapError as error:
        tell({"error": [type(error).__name__, str(error)]})
    except OSError as error:
        tell({"error": ["BundleError", f"the bundle cannot be written: {error.strerror or error}."]})
    else:
        tell({"objects": summary(bundle)})


def baked(wanted: dict[str, Any], progress: Any) -> HapticBundle:
    """Bake the bundle of a request. Raises: as `load_scene` and `bake`."""
    # A scene that the client sent is in a file of the server's, which no error should name.
    path = Path(wanted["scene"])
    scene = SceneSnapshot.from_json(read_bytes(path).decode("utf-8")) if wanted["is_sent"] else load_scene(path)
    config = BakeConfig.parse(wanted["config"])
    if wanted["pictures"] is not None:
        scene = GivenPictures.load(wanted["pictures"]).attach_to(scene)
    elif is_remote(config.llm):
        scene = capture_images(scene)
    return bake(scene, config, user_prompt=wanted["user_prompt"], progress=progress)


def summary(bundle: HapticBundle) -> list[dict[str, Any]]:
    """Return inferred properties of each object, for a client to show."""
    return [
        {
            "id": key,
            "category": haptics.object_category,
            "material": haptics.material_category,
            "vibrates": haptics.vibrates,
            "states": [state.name for state in haptics.states],
        }
        for key, haptics in bundle.objects.items()
    ]


if __name__ == "__main__":
    main()
