"""How long jobs take, told apart from what else the machine does: interleaved, medians, intervals.

Other programs, heat and shared cores slow a machine down for a while, so that the same job takes
half as long again. So all jobs take turns, round after round, in an order that moves on; each round
is divided by how slow the machine was in it, the median over its jobs; and where the processor
draws, the time that it worked is taken, not the time that it waited for its turn.
"""

import math
import os
import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

ROUNDS = (7, 151)  # at least, at most
PATIENCE = 3.0  # times the seconds meant, while the machine is too busy to tell
DRIFT = 0.08  # share of a cost by which it moves from one run of a machine to another
FLOOR = 0.01  # share of the whole time of a job that no difference resolves
SANE = 0.05  # relative difference between two clocks that agree
SOFTWARE = ("llvmpipe", "softpipe", "swiftshader")  # renderers that draw with the processor


class Timing(NamedTuple):
    """The cost of a job in seconds and the interval it lies in, what was taken off, the rounds.

    The interval holds the median (95 %, by order statistics), and the drift between runs.
    """

    cost: float
    low: float
    high: float
    taken_off: float
    rounds: int

    def per(self, count, unit=1e-9):
        """Return the same for one of `count` evaluations, in a unit of so many seconds."""
        return self._replace(
            **{name: getattr(self, name) / (count * unit) for name in Timing._fields[:4]}
        )


class Clock(NamedTuple):
    """A clock: said is what it is; time(job) does a job and returns (seconds spent, passed).

    cores is on how many of them what was spent is spread at most.
    """

    said: str
    cores: int
    time: Callable


def race(jobs, clock, seconds, empty=None, spread=False):
    """Return a Timing for each of the callables, all interleaved for about so many seconds.

    clock is a Clock, see `believed`. empty is the index of the job that does what all others do
    besides; its time is taken off the others', round by round, and its own Timing is the whole of
    it. spread: all jobs are evenly spread over the cores. A busy machine gets PATIENCE times the
    seconds.
    """
    cores = clock.cores if spread else None
    for job in jobs:
        clock.time(job)  # compiles, and warms caches
    times, start = [], time.perf_counter()
    while len(times) < ROUNDS[1]:
        spent = time.perf_counter() - start
        if len(times) >= ROUNDS[0] and spent > seconds:
            found, clear = _settled(times, empty, cores)
            if clear or spent > PATIENCE * seconds:
                return found
        first = len(times) % len(jobs)
        row = [(0.0, 0.0)] * len(jobs)
        for i in (*range(first, len(jobs)), *range(first)):
            row[i] = clock.time(jobs[i])
            if row[i][0] < 0.05:  # the less of two: what disturbs only adds
                row[i] = min(row[i], clock.time(jobs[i]))
        times.append(row)
    return settled(times, empty, cores)


def settled(times, empty=None, cores=None):
    """Return a Timing for each job from (rounds, jobs, 2): seconds spent and passed; see `race`.

    cores: of how many all jobs make full use.
    """
    return _settled(times, empty, cores)[0]


def _settled(times, empty, cores):
    """Return the Timings, and whether no interval is wider than the drift between runs."""
    spent, passed = np.moveaxis(np.maximum(np.asarray(times, np.float64), 1e-12), 2, 0)
    # how much of the time spent has to pass, where nothing disturbs: 1, or less on several cores
    shares = passed / spent
    share = np.full(spent.shape[1], 1.0 / cores) if cores else shares.min(axis=0)
    # where few rounds come near that, none may have been undisturbed
    doubt = np.ones_like(share) if cores else np.quantile(shares, 0.25, axis=0) / share
    spent = spent * share
    logs = np.log(spent)
    slow = np.median(logs - np.median(logs, axis=0), axis=1)  # each round, against the usual
    steady = spent / np.exp(slow)[:, None]
    whole = np.median(steady, axis=0)
    net = steady.copy()
    if empty is not None:
        net -= steady[:, empty : empty + 1]
        net[:, empty] = steady[:, empty]
    found, clear = [], True
    for i, values in enumerate(np.sort(net, axis=0).T):
        cost, (low, high) = float(np.median(values)), _interval(values)
        low -= float(whole[i] * (1.0 - 1.0 / doubt[i]))
        high += float(whole[i] * (doubt[i] - 1.0))
        margin = max(DRIFT * abs(cost), FLOOR * float(whole[i]))
        clear = clear and max(high - cost, cost - low) <= margin
        off = 0.0 if empty in (None, i) else float(whole[empty])
        ends = min(low, cost - margin), max(high, cost + margin)
        found.append(Timing(cost, *ends, off, len(values)))
    return found, clear


def _interval(values):
    """Return the order statistics of sorted values that hold their median with 95 %."""
    n = len(values)
    k = max(0, math.floor((n - 1.96 * math.sqrt(n)) / 2.0))
    return float(values[k]), float(values[n - 1 - k])


def wall(context):
    """Return the wall's clock, around a job and the end of all that a moderngl context draws."""
    return Clock("wall clock", 1, _around(context, time.perf_counter, 1))


def processor(context):
    """Return a clock of the time that this process worked, on all cores, and of the wall's."""
    cores = os.cpu_count() or 1
    said = f"processor time, spread over {cores} cores"
    return Clock(said, cores, _around(context, time.process_time, cores))


def _around(context, now, cores):
    def measure(job):
        _finish(context)
        start, worked = time.perf_counter(), now()
        job()
        _finish(context)
        spent, passed = now() - worked, time.perf_counter() - start
        return spent, (passed if cores == 1 else max(passed, spent / cores))

    return measure


def queries(context):
    """Return the graphics card's own clock, by timer queries of a moderngl context."""
    with context:
        query = context.query(time=True)

    def measure(job):
        with context:  # which does not nest, and the job may open it too
            query.__enter__()
        try:
            job()
        finally:  # a query that goes on would spoil the next one
            with context:
                query.__exit__(None, None, None)
        with context:
            return (query.elapsed * 1e-9,) * 2

    return Clock("timer queries", 1, measure)


def _finish(context):
    with context:  # another one, or none, may be the current one
        context.finish()


def believed(context, loads):
    """Return the Clock to believe with the renderer of a moderngl context.

    Where the processor draws: the time it worked, times the share that passes when undisturbed. On
    a graphics card its own timer queries, if they agree with the wall's clock on every one of the
    loads, jobs as those that will be timed; else the wall's clock.
    """
    with context:
        name = context.info["GL_RENDERER"]
    if any(word in name.lower() for word in SOFTWARE):
        return processor(context)
    by_wall, card = wall(context), queries(context)
    worst = 0.0
    for load in loads:
        times = 1
        by_wall.time(load)
        while by_wall.time(_often(load, times))[0] < 0.02 and times < 1 << 12:
            times *= 2  # so often that the way to the card and back does not count
        off = []
        for _ in range(5):
            told = []  # by the card, of the very run that the wall's clock is told to time
            passed, _ = by_wall.time(_told(told, card, _often(load, times)))
            off.append(abs(told[0] / passed - 1.0))
        worst = max(worst, float(np.median(off)))
    if worst <= SANE:
        return card._replace(said=f"timer queries, within {worst:.1%} of the wall clock")
    return by_wall._replace(said=f"wall clock: timer queries are {worst:.0%} off it")


def _told(told, clock, job):
    """Return the job of doing a job and noting what a clock says of it."""
    return lambda: told.append(clock.time(job)[0])


def _often(job, times):
    def several():
        for _ in range(times):
            job()

    return several
