"""Record calls of the compiled functions in random worlds: their arguments, memory and results.

On this machine the functions give the bits of the Python code, which tests/world/test_segments.py
checks. The format is little-endian and documented by :meth:`Recorder.packed`.
"""

import ctypes
import random
import struct
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from ai4u_edu.world import RayFan, RayGrid, rays
from ai4u_edu.world.native.chipmunk import ffi
from ai4u_edu.world.native.grid import CompiledGrid
from ai4u_edu.world.native.segments import CompiledSegments
from tests.world.random_worlds import make_world, shuffle

WORLDS = 12
CASTS_PER_WORLD = 8
QUERY = -1
"""Stands for the address of Chipmunk's query, which the replaying program has a stand-in for."""
FAN, GRID, FLOOR = struct.Struct("=QqQIIQQQ"), struct.Struct("=4q10Qd3Q"), struct.Struct("=2q8dQ")
HIT_BYTES = 48


@dataclass
class Call:
    """One call of a compiled function; the first piece of memory is its first argument."""

    function: int
    """0 for ``cast_fan``, 1 for ``look``."""
    arguments: tuple[float, ...]
    pieces: list[tuple[int, int]] = field(default_factory=list)
    """Address and size of each piece of memory."""
    pointers: list[tuple[int, int, int]] = field(default_factory=list)
    """Piece and offset of each pointer, and the piece that it points to."""
    before: list[bytes] = field(default_factory=list)
    after: list[bytes] = field(default_factory=list)
    queries: bytes = b""
    """Ends and hits of the calls of Chipmunk's query."""
    returned: int = 0

    def point(self, piece: int, offset: int, address: int, size: int) -> int:
        """Add the memory that a pointer leads to; return its number."""
        self.pieces.append((address, max(size, 1)))
        self.pointers.append((piece, offset, len(self.pieces) - 1))
        return len(self.pieces) - 1

    def memory(self) -> list[bytes]:
        return [ctypes.string_at(address, size) for address, size in self.pieces]


class Recorder:
    """Records the calls of casters that were made while it is in their place."""

    def __init__(self) -> None:
        self.calls: list[Call] = []

    def record_fan(self, segments: CompiledSegments) -> None:
        original = segments._call

        def call(fan: Any, space: Any, x: float, y: float, reach: float) -> None:
            made = fan_call(segments, (x, y, reach))
            original(fan, space, x, y, reach)
            hits = np.frombuffer(ffi.buffer(segments._hit_memory), np.uint8).reshape(-1, HIT_BYTES)
            ends = segments.directions * reach + (x, y)
            made.queries = b"".join(a.tobytes() + b.tobytes() for a, b in zip(ends, hits))  # noqa: B905 - as many
            self._keep(made)

        segments._call = call

    def record_grid(self, grid: CompiledGrid) -> None:
        original = grid._look

        def look(job: bytes, *arguments: float) -> int:
            made = grid_call(job, arguments)
            made.returned = original(job, *arguments)
            self._keep(made)
            return made.returned

        grid._look = look

    def _keep(self, call: Call) -> None:
        call.after = call.memory()
        self.calls.append(call)

    def packed(self) -> bytes:
        """Return the calls as bytes, in the order of the fields that replay.c reads."""
        out = [struct.pack("<q", len(self.calls))]
        for call in self.calls:
            out.append(struct.pack("<2q", call.function, len(call.before)))
            for before, after in zip(call.before, call.after, strict=True):
                out += [struct.pack("<q", len(before)), before, after]
            out.append(struct.pack("<q", len(call.pointers)))
            out += [struct.pack("<3q", *each) for each in call.pointers]
            arguments = [*call.arguments, 0.0, 0.0][:5]
            out.append(struct.pack("<5dqq", *arguments, call.returned, len(call.queries) // 64))
            out.append(call.queries)
        return b"".join(out)


def fan_call(segments: CompiledSegments, arguments: tuple[float, ...]) -> Call:
    """Return a call of ``cast_fan`` with its memory."""
    job = bytes(segments._memory)
    count, (directions, hits, distances) = FAN.unpack(job)[1], FAN.unpack(job)[5:]
    call = Call(0, arguments)
    call.pieces.append((ctypes.addressof(ctypes.c_char.from_buffer(segments._memory)), FAN.size))
    call.pointers.append((0, 0, QUERY))
    call.point(0, 32, directions, 16 * count)
    call.point(0, 40, hits, HIT_BYTES * count)
    call.point(0, 48, distances, 8 * count)
    call.before = call.memory()
    return call


def grid_call(job: bytes, arguments: tuple[float, ...]) -> Call:
    """Return a call of ``look`` with its memory."""
    values = GRID.unpack(job)
    rows, columns, floors, things = values[:4]
    call = Call(1, arguments)
    call.pieces.append((ctypes.cast(ctypes.c_char_p(job), ctypes.c_void_p).value or 0, GRID.size))
    cells = rows * columns
    sizes = [8 * rows] * 4 + [16 * columns, HIT_BYTES * columns, 8 * columns]
    sizes += [FLOOR.size * floors, 8 * things, 24 * things]
    for i, size in enumerate(sizes):
        piece = call.point(0, 32 + 8 * i, values[4 + i], size)
        for floor in range(floors if i == 7 else 0):
            at = floor * FLOOR.size
            one = FLOOR.unpack(ctypes.string_at(values[4 + i] + at, FLOOR.size))
            if one[-1]:
                call.point(piece, at + 80, one[-1], 16 * one[1])
    for i, size in enumerate((8 * cells, 8 * cells, cells)):
        call.point(0, 120 + 8 * i, values[15 + i], size)
    call.before = call.memory()
    return call


def record() -> Recorder:
    """Record casts of fans and grids in random worlds."""
    rng, recorder = random.Random(4), Recorder()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rays, "make_segments", CompiledSegments)
        for _ in range(WORLDS):
            world = make_world(rng, sticks=True)
            angles = [rng.uniform(-4, 4) for _ in range(7)]
            eye = (0.1, 0.0, rng.uniform(0.1, 1.0))
            fan = RayFan(world, angles, 9.0, _code_of, eye=eye)
            grid = RayGrid(world, angles, [0.2, 0.0, -0.3], 9.0, _code_of, eye=eye)
            fan.cast(world["eye"])
            recorder.record_fan(fan._segments)  # type: ignore[arg-type]
            recorder.record_grid(grid._compiled)  # type: ignore[arg-type]
            for _ in range(CASTS_PER_WORLD):
                shuffle(world, rng)
                fan.cast(world["eye"])
                grid.cast(world["eye"])
    return recorder


def _code_of(tags: Any) -> float:
    return float(sum(map(len, tags)))
