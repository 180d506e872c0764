#!/usr/bin/python3
"""A stand-in for the Haply Inverse service, on a library that is not ours: python3-websockets.

haply_service.py FORCE_KEY MOOD LOG     prints its port, then serves one client.
  FORCE_KEY  what holds the components of a force, as this version of the service has it
  MOOD       calm; or what it does after 100 messages: leaves, silent, garbage, deviceless; powerless, unready: its status says
             so; limp: forces are none, which it tells; or untold: tells of no force ever; or shy: says nothing at all
  LOG        file with one line for each message of the client, written when it has gone
The device answers each message with one state. Its x follows the force that it was sent, 1 mm for each newton, so
that the test sees a force come back as a position; it leaves out whatever is as it was.
"""
import asyncio
import json
import os
import sys

import websockets

force_key, mood, log_path = sys.argv[1:4]
log = []
done = asyncio.Event()


def state_of(force):
    return {"cursor_position": {"x": 0.001 * force.get("x", 0.0), "y": -0.02, "z": 0.03},
            "cursor_velocity": {"x": 0.0, "y": 0.5, "z": 0.0}, "control_mode": "idle"}


async def serve(socket):
    if mood == "shy":
        await asyncio.sleep(60)
    inventory = {"session_id": 7, "inverse3": [
        {"device_id": "049D", "config": {}, "state": state_of({}),
         "status": {"calibrated": True, "in_use": False, "power_supply": True, "ready": True, "started": True}},
        {"device_id": "0500", "config": {}, "state": state_of({}), "status": {}}],
        "verse_grip": [{"device_id": "61", "state": {
            "orientation": {"w": 0.70710678, "x": 0.0, "y": 0.0, "z": 0.70710678},
            "buttons": {"a": True, "b": False, "c": True}}}]}
    await socket.send(json.dumps(inventory))
    force, n = {}, 0
    try:
        async for text in socket:
            n += 1
            message = json.loads(text)
            log.append(text)
            device = message["inverse3"][0]
            command = device["commands"].get("set_cursor_force")
            if command is not None:
                force = command.get(force_key, {})
            if n > 100 and mood == "leaves":
                os._exit(0)
            if n > 100 and mood == "silent":
                continue
            if n > 100 and mood == "garbage":
                await socket.send('{"inverse3": [{"device_id"')
                continue
            if n > 100 and mood == "deviceless":
                await socket.send('{"inverse3": []}')
                continue
            if n % 20 == 0:
                await socket.ping()
            state = state_of(force)
            if n > 1:
                del state["cursor_position"]["y"]  # as it was
            if mood in ("limp", "untold"):
                none = mood == "untold" or n > 100
                state["current_cursor_force"] = {c: 0.0 if none else force.get(c, 0.0) for c in "xyz"}
            entry = {"device_id": device["device_id"], "state": state}
            if n > 100 and mood == "powerless":
                entry["status"] = {"power_supply": False}
            if n > 100 and mood == "unready":
                entry["status"] = {"ready": False}
            answer = json.dumps({"inverse3": [entry]})
            # now and then in two frames
            await socket.send([answer[:30], answer[30:]] if n % 7 == 0 else answer)
    except websockets.ConnectionClosed:
        pass
    with open(log_path, "w", encoding="utf-8") as file:
        file.writelines(text + "\n" for text in log)
    done.set()


async def main():
    async with websockets.serve(serve, "127.0.0.1", 0) as server:
        print(server.sockets[0].getsockname()[1], flush=True)
        await done.wait()


asyncio.run(main())
