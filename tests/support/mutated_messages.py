"""Messages to a bridge that are nearly valid, or random bytes."""

from __future__ import annotations

import json
import random

import numpy as np

from bridge_client import Client
from scene2hap import Touch

ON_TABLE = Touch("left", "table", (0.0, 0.72, 0.0))


def mutated(client: Client, rng: random.Random) -> str | bytes:
    """A message that is nearly valid, or random bytes."""
    texts = [
        {"type": "set_source", "source": "phone", "gain_db": -3.0, "id": 4},
        {"type": "strike", "object": "table", "point_m": [0.0, 0.72, 0.0], "speed_m_s": 1.0},
        {"type": "set_user", "gain_db": 1.0, "profile": {"hands": {}}},
        {"type": "moving", "moving": ["phone", "mug"]},
        {"type": "explain", "hand": "left"},
        {"type": "remove", "object": "spoon"},
        {"type": "stats"},
    ]
    if rng.random() < 0.5:
        text = bytearray(json.dumps(rng.choice(texts)).encode())
        for _ in range(rng.randrange(4)):
            text[rng.randrange(len(text))] = rng.randrange(32, 127)
        return text.decode("ascii")
    if rng.random() < 0.2:
        return rng.randbytes(rng.randrange(200))
    frame = bytearray(client.frame(rng.randrange(2**32), rng.random() * 100, np.zeros((1, 7)) + 0.5, [ON_TABLE]))
    for _ in range(rng.randrange(4)):
        frame[rng.randrange(len(frame))] = rng.randrange(256)
    return bytes(frame[: rng.randrange(len(frame))]) if rng.random() < 0.2 else bytes(frame)
