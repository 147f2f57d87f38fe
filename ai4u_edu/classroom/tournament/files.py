"""Routes of the files of a tournament: its report, and the recordings of its games."""

import asyncio

from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response
from starlette.routing import Route

from ai4u_edu.classroom.tournament.runner import TournamentRunner
from ai4u_edu.games.jobs import Job
from ai4u_edu.games.jobs.isolated import IsolatedJobs
from ai4u_edu.games.tournament.page import game_page
from ai4u_edu.games.tournament.run import GAMES, PAGE
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate
from ai4u_edu.page.server.page import FRAME_ANCESTORS

MAX_PAGE_CPU_S = 30.0
MAX_PAGE_WALL_S = 120.0
POLICY = "; ".join(
    [
        "default-src 'none'",
        "script-src 'unsafe-inline'",
        "style-src 'unsafe-inline'",
        "img-src data:",
        "base-uri 'none'",
        "form-action 'none'",
        "sandbox allow-scripts",
        FRAME_ANCESTORS,
    ]
)
"""A page of this kind has its scripts inside, and an origin of its own: it can ask the class for
nothing."""
HEADERS = {"Content-Security-Policy": POLICY, "Cache-Control": "no-store"}


class TournamentFiles:
    """Files for the teacher's page and the projector page.

    Belongs to the event loop.

    Args:
        runner: of the class.
    """

    def __init__(self, runner: TournamentRunner) -> None:
        self._runner = runner
        folder = runner.tournaments.folder / "pages"
        self._pages = IsolatedJobs(MAX_PAGE_CPU_S, MAX_PAGE_WALL_S, folder)
        self._open = 0

    def routes(self, auth: Middleware) -> list[Route]:
        """Return the routes.

        Args:
            auth: lets only the teacher pass.
        """
        return [
            Route("/teacher/tournament", self.report, middleware=[auth]),
            Route("/teacher/tournament/{number:int}", self.game, middleware=[auth]),
            Route("/projector/game/{number:int}", self.projected, middleware=[auth]),
        ]

    async def report(self, _request: Request) -> Response:
        """Return the report, which is there when a tournament is over."""
        row = self._runner.tournaments.now
        if row is not None:
            path = self._runner.tournaments.folder_of(row) / PAGE
            if path.is_file():
                return HTMLResponse(await asyncio.to_thread(path.read_bytes), headers=HEADERS)
        raise HTTPException(404, translate(_("There is no report: no tournament is over.")))

    async def game(self, request: Request) -> Response:
        """Return the page that plays a recorded game."""
        return await self._page(request, is_projected=False)

    async def projected(self, request: Request) -> Response:
        """Return the page of a recorded game that the projector page shows."""
        return await self._page(request, is_projected=True)

    async def _page(self, request: Request, *, is_projected: bool) -> Response:
        row, number = self._runner.tournaments.now, request.path_params["number"]
        found = []
        if row is not None:
            games = self._runner.tournaments.folder_of(row) / GAMES
            found = sorted(games.glob(f"{number:04}-*.episode"))
        if not found:
            raise HTTPException(
                404, translate(_("There is no recording of game {number}.", number=number))
            )
        self._open += 1
        try:
            path = str(found[0].absolute())
            answer = await self._pages.run(Job.of(game_page, path=path, is_projected=is_projected))
        except OSError as error:
            raise HTTPException(
                503,
                translate(_("This recording can't be shown now: {problem}.", problem=str(error))),
            ) from None
        finally:
            self._open -= 1
            if self._open == 0:
                await self._pages.end()
        if answer.error:
            raise HTTPException(
                500, translate(_("This recording can't be shown: {problem}", problem=answer.error))
            )
        return HTMLResponse(answer.result, headers=HEADERS)
