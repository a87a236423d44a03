"""The process in which GLSL is tried for the window: draws scenes small, tells how that went."""

import json
import math
import os
import pickle
import signal
import sys
import time

from . import hands
from .errors import Mistake, one_line
from .renderer import Renderer

SMALL, LARGER = (16, 16), (64, 64)  # what the second costs beyond the first is spent on pixels
CHEAP, ENOUGH = 0.004, 0.8  # seconds that raise no doubt, and that are spent on any
PATIENCE = 60  # seconds after which it ends by itself, should the window be gone


def serve():
    """Draw each scene that comes as a pickle on standard input, until that is closed.

    Says, one line of JSON each: {"name"} of the renderer, once there is one; then for every scene
    {"began"} when its meshes are there, and {"line", "cost"}: what is wrong, or "", and how many
    seconds a sample takes.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the window decides
    voice = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what drivers say is not for the window

    def say(**what):
        voice.write(json.dumps(what) + "\n")
        voice.flush()

    renderer = Renderer()
    say(name=renderer.name)
    clock, cores = time.perf_counter, 1
    if "llvmpipe" in renderer.name:  # its work tells more than the time, when others work too
        clock, cores = time.process_time, os.cpu_count() or 1
    while True:
        try:
            before, scene, sources = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        line, cost = "", 0.0
        signal.alarm(PATIENCE)
        try:
            if before:
                _seconds(renderer, before, SMALL, clock)  # what all pictures need is there, then
            with renderer.context:
                renderer.viewpoint(scene)  # its meshes are read
            say(began=True)
            cost = _cost(renderer, scene, clock) / cores
        except Mistake as mistake:
            line = one_line(mistake)
        signal.alarm(0)
        say(line=line, cost=cost)
        for source in sources:
            renderer.forget(source)


def _cost(renderer, scene, clock):
    """Return how many seconds a sample of a scene's picture takes, beside what all of it does.

    The least of several: whatever else the computer does makes it seem dearer.
    """
    began, least = time.monotonic(), math.inf
    _seconds(renderer, scene, SMALL, clock)  # compiles
    while True:
        larger, small = (_seconds(renderer, scene, size, clock) for size in (LARGER, SMALL))
        least = min(least, max(0.0, larger - small))
        if least < CHEAP or time.monotonic() - began > ENOUGH:
            return least / (LARGER[0] * LARGER[1] - SMALL[0] * SMALL[1])


def _seconds(renderer, scene, size, clock):
    context, began = renderer.context, clock()
    with context:
        picture = context.framebuffer([context.texture(size, 4)])
    renderer.show(hands.framed(scene, size)._replace(samples=1), picture)
    with context:
        context.finish()
        renderer.free_framebuffer(picture)
    return clock() - began
