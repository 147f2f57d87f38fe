"""Environment of a service that a JupyterHub has started."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Self
from urllib.parse import urlsplit

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import gettext as _

DEFAULT_PORT = 10101
_NEEDED = (
    "JUPYTERHUB_API_TOKEN",
    "JUPYTERHUB_API_URL",
    "JUPYTERHUB_BASE_URL",
    "JUPYTERHUB_CLIENT_ID",
    "JUPYTERHUB_SERVICE_NAME",
    "JUPYTERHUB_SERVICE_PREFIX",
)


@dataclass(frozen=True)
class HubEnvironment:
    """Addresses and secrets that the hub gives to a service.

    See https://jupyterhub.readthedocs.io/en/stable/reference/services.html.
    """

    name: str
    """The service's name."""
    prefix: str
    """Path of the service, such as ``/services/ai4u-class/``."""
    host: str
    """Address that the service listens at."""
    port: int
    api_url: str
    """Address of the hub's API, without a slash at the end."""
    api_token: str = field(repr=False)
    """The service's token, which is its OAuth secret, too."""
    client_id: str
    redirect_uri: str
    """Path or address to which the hub sends a browser that has signed in."""
    hub_url: str
    """Path or address of the hub's pages, such as ``/hub/``."""
    public_url: str
    """Address of the service for browsers; empty if the hub does not say it."""

    @classmethod
    def read(cls, variables: Mapping[str, str] = os.environ) -> Self:
        """Return the environment in the variables of a process.

        Raises:
            SetupError: a variable is missing.
        """
        missing = [name for name in _NEEDED if not variables.get(name)]
        if missing:
            raise SetupError(
                _(
                    "--hub: expected a service of a JupyterHub, which sets {needed}; {missing} "
                    "not set. Start it with c.JupyterHub.services; docs/jupyterhub.md has the "
                    "settings",
                    needed=", ".join(_NEEDED),
                    missing=", ".join(missing),
                )
            )
        prefix = f"{variables['JUPYTERHUB_SERVICE_PREFIX'].rstrip('/')}/"
        base = f"{variables['JUPYTERHUB_BASE_URL'].rstrip('/')}/"
        hub_host = variables.get("JUPYTERHUB_HOST", "")
        listens = urlsplit(variables.get("JUPYTERHUB_SERVICE_URL", ""))
        return cls(
            name=variables["JUPYTERHUB_SERVICE_NAME"],
            prefix=prefix,
            host=listens.hostname or "127.0.0.1",
            port=listens.port or DEFAULT_PORT,
            api_url=variables["JUPYTERHUB_API_URL"].rstrip("/"),
            api_token=variables["JUPYTERHUB_API_TOKEN"],
            client_id=variables["JUPYTERHUB_CLIENT_ID"],
            redirect_uri=(
                variables.get("JUPYTERHUB_OAUTH_CALLBACK_URL") or f"{prefix}oauth_callback"
            ),
            hub_url=f"{hub_host}{base}hub/",
            public_url=variables.get("JUPYTERHUB_PUBLIC_URL", ""),
        )

    @property
    def access_scopes(self) -> tuple[str, str]:
        """Scopes of a token that may use this service; one of them is enough."""
        return "access:services", f"access:services!service={self.name}"
