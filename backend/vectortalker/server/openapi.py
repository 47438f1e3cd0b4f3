"""The OpenAPI document: the routes, and the models of stored files that no route carries.

`python -m vectortalker.server.openapi` prints it; the browser's types are made of it.
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

from pydantic.json_schema import models_json_schema

from vectortalker import schema
from vectortalker.server.app import create_app
from vectortalker.server.services import open_services
from vectortalker.server.settings import Settings

STORED = (schema.Project, schema.Pose, schema.Track)


def document() -> dict[str, Any]:
    """Schemas are in alphabetical order; one serves input and output alike."""
    with tempfile.TemporaryDirectory() as folder:
        services = open_services(Settings(data=Path(folder)))
        routes = create_app(services).openapi()
        services.close()
    _, stored = models_json_schema(
        [(model, "validation") for model in STORED], ref_template="#/components/schemas/{model}"
    )
    schemas = {**stored["$defs"], **routes["components"]["schemas"]}
    return {**routes, "components": {"schemas": dict(sorted(schemas.items()))}}


if __name__ == "__main__":
    json.dump(document(), sys.stdout, indent=2, ensure_ascii=False)
