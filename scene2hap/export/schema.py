"""The JSON schema of an export's manifest, for authors of importers.

python -m scene2hap.export.schema > docs/manifest.schema.json
"""

from __future__ import annotations

import json
from typing import Any

from scene2hap.export.manifest import Manifest


def manifest_schema() -> dict[str, Any]:
    """Return the schema (JSON Schema, 2020-12) of manifest.json."""
    schema = _plain(Manifest.model_json_schema(mode="serialization"))
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "scene2hap export manifest",
        **{key: value for key, value in schema.items() if key != "description"},
    }


def _plain(schema: Any) -> Any:
    """Return the schema without titles, and with constants in a form that does not depend on pydantic's version."""
    if isinstance(schema, list):
        return [_plain(item) for item in schema]
    if not isinstance(schema, dict):
        return schema
    kept = {key: _plain(value) for key, value in schema.items() if key != "title"}
    return {"const": kept["const"]} if "const" in kept else kept


if __name__ == "__main__":
    print(json.dumps(manifest_schema(), indent=2, ensure_ascii=False))
