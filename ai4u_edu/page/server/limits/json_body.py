"""Bodies of requests: JSON, bounded in size and checked."""

from typing import TypeVar

from pydantic import BaseModel, ValidationError
from starlette.exceptions import HTTPException
from starlette.requests import Request

from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

Model = TypeVar("Model", bound=BaseModel)


async def read_json(request: Request, model: type[Model], max_bytes: int) -> Model:
    """Return a request's body.

    A browser sends JSON to another site only after it has asked that site, which refuses. So the
    media type is one more guard against other sites.

    Args:
        request: the request.
        model: describes the body.
        max_bytes: size of the body.

    Raises:
        HTTPException: it is too large (413), no JSON (415), or does not fit the model (422).
    """
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if kind != "application/json":
        raise HTTPException(
            415,
            translate(_("Content-Type: expected application/json, got {kind!r}", kind=kind[:80])),
        )
    data = b""
    async for part in request.stream():
        data += part
        if len(data) > max_bytes:
            raise HTTPException(
                413, translate(_("expected a body of at most {most} bytes", most=max_bytes))
            )
    try:
        return model.model_validate_json(data)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise HTTPException(422, f"{place or 'body'}: {first['msg']}") from None
