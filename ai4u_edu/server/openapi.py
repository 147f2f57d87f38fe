"""OpenAPI description of the API, derived from the models of its answers."""

from typing import Any

from pydantic import BaseModel
from pydantic.json_schema import models_json_schema

from ai4u_edu.base.version import __version__
from ai4u_edu.server.api import Health, SnapshotView
from ai4u_edu.server.past import RECORDING, WRITERS, PastView

_ANSWERS: dict[str, tuple[str, type[BaseModel]]] = {
    "/healthz": ("Whether the room is well.", Health),
    "/api/snapshot": ("Everything at the last tick.", SnapshotView),
    "/api/past": ("The kept episodes.", PastView),
}


def openapi() -> dict[str, Any]:
    """Return the OpenAPI 3.1 document."""
    _, schemas = models_json_schema(
        [(model, "serialization") for _, model in _ANSWERS.values()],
        ref_template="#/components/schemas/{model}",
    )
    paths = {
        path: _get(summary, {"$ref": f"#/components/schemas/{model.__name__}"})
        for path, (summary, model) in _ANSWERS.items()
    }
    health = paths["/healthz"]["get"]["responses"]
    health["503"] = {**health["200"], "description": "A block of the world does not return."}
    paths["/api/past/{file}"] = _file("A kept episode as a file.")
    paths["/api/openapi.json"] = _get("This document.", {"type": "object"})
    return {
        "openapi": "3.1.0",
        "info": {"title": "AI4U Edu", "version": __version__},
        # relative to this document's address, which may have a path prefix
        "servers": [{"url": ".."}],
        "paths": paths,
        "components": {"schemas": schemas["$defs"]},
    }


def _get(summary: str, schema: dict[str, Any]) -> dict[str, Any]:
    content = {"application/json": {"schema": schema}}
    return {
        "get": {
            "summary": summary,
            "responses": {
                "200": {"description": "OK", "content": content},
                "401": {"description": "The room has a token, and the request does not."},
                "403": {"description": "The host name is not allowed, or another site asks."},
                "429": {"description": "Too many wrong tokens; Retry-After gives the delay."},
            },
        }
    }


def _file(summary: str) -> dict[str, Any]:
    known = "|".join((RECORDING, *WRITERS))
    described = _get(summary, {})
    found = described["get"]
    found["parameters"] = [
        {
            "name": "file",
            "in": "path",
            "required": True,
            "description": "the episode's number, and what to make of it",
            "schema": {"type": "string", "pattern": rf"^[0-9]+\.({known})$"},
        }
    ]
    found["responses"]["200"]["content"] = {"*/*": {}}
    found["responses"] |= {
        "404": {"description": "No such episode is kept; the text lists those that are."},
        "409": {"description": "The file can't be made; the text gives the reason."},
        "503": {"description": "Too many files are being made; Retry-After gives the delay."},
    }
    return described
