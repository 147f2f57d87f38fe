"""Nobody fills a log by repeating a mistake."""

import logging
import threading

import pytest

from ai4u_edu.base.log_limit import MAX_LOG_KEYS, LimitFilter, LogLimiter, limited_logs, log_limited

LOGGER = logging.getLogger("ai4u_edu.tests")


class Clock:
    now = 0.0

    def __call__(self) -> float:
        return self.now


def test_one_line_per_key_and_interval_and_the_next_one_counts(
    caplog: pytest.LogCaptureFixture,
) -> None:
    clock = Clock()
    limiter = LogLimiter(clock=clock)
    for number in range(50):
        log_limited(LOGGER, logging.WARNING, "bad", "bad frame %d", number, limiter=limiter)
    log_limited(LOGGER, logging.WARNING, "odd", "100% odd", limiter=limiter)
    clock.now = 10.0
    log_limited(LOGGER, logging.WARNING, "bad", "bad frame %d", 50, limiter=limiter)
    assert caplog.messages == [
        "bad frame 0",
        "100% odd",
        "bad frame 50 (49 more like this since the last such line)",
    ]
    assert {record.funcName for record in caplog.records} == {
        "test_one_line_per_key_and_interval_and_the_next_one_counts"
    }


def test_lines_that_nobody_reads_are_not_counted(caplog: pytest.LogCaptureFixture) -> None:
    limiter = LogLimiter(clock=Clock())
    with caplog.at_level(logging.ERROR):
        log_limited(LOGGER, logging.INFO, "a", "a", limiter=limiter)
    log_limited(LOGGER, logging.ERROR, "a", "b", limiter=limiter)
    assert caplog.messages == ["b"]


def test_endless_many_keys_take_neither_memory_nor_lines() -> None:
    clock = Clock()
    limiter = LogLimiter(clock=clock)
    admitted = sum(limiter.admit(("key", number)) is not None for number in range(10_000))
    assert admitted <= MAX_LOG_KEYS + 1
    clock.now = 10.0
    assert limiter.admit("another") == 0
    again = sum(limiter.admit(("other", number)) is not None for number in range(10_000))
    assert again <= MAX_LOG_KEYS + 1
    assert len(limiter._seen) <= MAX_LOG_KEYS + 1


def test_threads_that_log_at_once_lose_no_count() -> None:
    clock = Clock()
    limiter = LogLimiter(clock=clock)
    admitted: list[int | None] = []

    def log() -> None:
        admitted.extend(limiter.admit("key") for _ in range(1000))

    threads = [threading.Thread(target=log) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert admitted.count(0) == 1
    clock.now = 10.0
    assert limiter.admit("key") == 3999


def test_a_librarys_tracebacks_of_one_place_are_written_once_and_counted(
    caplog: pytest.LogCaptureFixture,
) -> None:
    clock = Clock()
    limit = LimitFilter(LogLimiter(clock=clock))
    logger = logging.getLogger("ai4u_edu.tests.library")
    logger.addFilter(limit)

    def fail(text: str) -> None:
        try:
            int(text)
        except ValueError:
            logger.exception("Exception in %s\n", "an application")

    try:
        for number in range(20):
            fail(f"number {number}")
        clock.now = 11.0
        fail("the last")
    finally:
        logger.removeFilter(limit)
    first, last = caplog.records
    assert first.exc_info is not None
    assert last.exc_info is None
    assert last.getMessage() == (
        "Exception in an application: ValueError: invalid literal for int() with base 10: "
        "'the last' (19 more like this since the last such line)"
    )


def test_different_lines_and_places_are_told_apart(caplog: pytest.LogCaptureFixture) -> None:
    limit = LimitFilter(LogLimiter(clock=Clock()))
    logger = logging.getLogger("ai4u_edu.tests.library")
    logger.addFilter(limit)
    try:
        for _ in range(3):
            for raised in (ValueError("x"), KeyError("x")):
                try:
                    raise raised
                except (ValueError, KeyError):
                    logger.exception("failed")
            logger.warning("one thing")
            logger.warning("another thing")
    finally:
        logger.removeFilter(limit)
    assert caplog.messages == ["failed", "failed", "one thing", "another thing"]


def test_libraries_are_limited_while_somebody_owns_them(
    caplog: pytest.LogCaptureFixture,
) -> None:
    names = ("uvicorn.error", "asyncio", "websockets.server", "viser", "ai4u_edu.tests")
    filters = [list(logging.getLogger(name).filters) for name in names]

    def flood(kind: str) -> int:
        caplog.clear()
        for name in names:
            for _ in range(5):
                logging.getLogger(name).warning(kind)
        return len(caplog.records)

    with limited_logs():
        with limited_logs():
            assert flood("two owners") == len(names)
        assert flood("one owner") == len(names)
    assert flood("none") == 5 * len(names)
    assert [logging.getLogger(name).filters for name in names] == filters
