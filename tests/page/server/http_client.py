"""httpx with the tests' limit on answers; its own is 5 s, which a busy machine may need."""

from functools import partial

import httpx

from tests.waiting import LIMIT_S

get = partial(httpx.get, timeout=LIMIT_S)
post = partial(httpx.post, timeout=LIMIT_S)
Client = partial(httpx.Client, timeout=LIMIT_S)
AsyncClient = partial(httpx.AsyncClient, timeout=LIMIT_S)
