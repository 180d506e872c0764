#!/usr/bin/python3
"""The Haply Inverse service once more, by another hand: any number of clients, and a device that goes on with the last
force that any of them sent, also when that one has gone. On python3-websockets. Its hardware is the file of stranger_bus.h.

stranger_haply.py BUS     prints its port, then serves until it is killed.
"""
import asyncio
import json
import math
import mmap
import struct
import sys
import time

import websockets

# struct StrangerBus: trouble (4 bytes), depth_mm at 8, owner at 16, motors at 20, force at 24, n_packets at 32, packets
# from 40 on: t_ns, what (4 bytes, 4 of nothing), newton, pid (4 bytes, 4 of nothing)
DEPTH, MOTORS, FORCE, N_PACKETS, PACKETS, KEPT = 8, 20, 24, 32, 40, 1 << 16
with open(sys.argv[1], "r+b") as shared:
    bus = mmap.mmap(shared.fileno(), 0)
pressed_since = None
clients = 0


def tell_hardware(force):
    """The device takes a force from whoever sends one."""
    global pressed_since
    norm = math.sqrt(sum(force.get(axis, 0.0) ** 2 for axis in "xyz"))
    if pressed_since is None:
        pressed_since = time.monotonic()
    struct.pack_into("<d", bus, FORCE, norm)
    struct.pack_into("<?", bus, MOTORS, True)
    n = struct.unpack_from("<Q", bus, N_PACKETS)[0]
    struct.pack_into("<qIIdii", bus, PACKETS + 32 * (n % KEPT), time.monotonic_ns(), 0, 0, norm, 0, 0)
    struct.pack_into("<Q", bus, N_PACKETS, n + 1)


def state():
    depth = struct.unpack_from("<d", bus, DEPTH)[0]
    t = 0.0 if pressed_since is None else (time.monotonic() - pressed_since) % 5.0
    z = -1e-3 * depth * (min(t / 0.8, 1.0) if t < 4.0 else max(1.0 - (t - 4.0) / 0.4, 0.0))
    return {"cursor_position": {"x": 0.0, "y": 0.0, "z": z}, "cursor_velocity": {"x": 0.0, "y": 0.0, "z": 0.0}}


async def serve(socket):
    global pressed_since, clients
    if clients == 0:
        pressed_since = None  # a new hand begins above; a second client sees the same one
    clients += 1
    await socket.send(json.dumps({"session_id": 1, "inverse3": [
        {"device_id": "0001", "config": {}, "state": state(), "status": {}}]}))
    try:
        async for text in socket:
            device = json.loads(text)["inverse3"][0]
            command = device["commands"].get("set_cursor_force")
            if command is not None:
                tell_hardware(command["values"])
            await socket.send(json.dumps({"inverse3": [{"device_id": "0001", "state": state()}]}))
    except websockets.ConnectionClosed:
        pass
    finally:
        clients -= 1


async def main():
    async with websockets.serve(serve, "127.0.0.1", 0) as server:
        print(server.sockets[0].getsockname()[1], flush=True)
        await asyncio.Future()


asyncio.run(main())
