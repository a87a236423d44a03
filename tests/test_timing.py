"""Timing: what a job costs is told apart from a machine that is slow, busy, or drifts."""

import numpy as np
import pytest

from lumiar import timing

EMPTY, COSTS = 4e-3, np.array([0.0, 1e-3, 2e-3, 3e-3])  # seconds of what all do, and of each job


def rounds(count=41, seed=1, drift=0.0, spikes=0.0, cores=1):
    """Return (rounds, jobs, 2) seconds of a machine that drifts, and at times does other things."""
    generator = np.random.default_rng(seed)
    speed = np.exp(drift * np.cumsum(generator.normal(size=(count, 1)), axis=0))
    spent = (EMPTY + COSTS) * speed * generator.normal(1.0, 0.003, (count, 4))
    spent += spikes * EMPTY * generator.pareto(2.0, (count, 4)) * generator.random((count, 4))
    return np.stack([spent * cores, spent], axis=2)


@pytest.mark.parametrize(("drift", "spikes"), [(0.0, 0.0), (0.05, 0.0), (0.0, 0.05)])
def test_the_cost_is_the_job_s_whatever_the_machine_does(drift, spikes):
    found = timing.settled(rounds(drift=drift, spikes=spikes), empty=0)
    scale = found[0].cost / EMPTY  # of a machine that has become slower altogether
    for one, cost in zip(found[1:], COSTS[1:], strict=True):
        assert one.cost / scale == pytest.approx(cost, rel=0.05, abs=0.05e-3)
        assert one.low <= cost * scale <= one.high
        assert one.taken_off == found[0].cost


def test_an_interval_holds_the_median_and_never_less_than_the_drift_between_runs():
    for one in timing.settled(rounds(), empty=0)[1:]:
        assert one.low <= one.cost * (1.001 - timing.DRIFT)
        assert one.high >= one.cost * (0.999 + timing.DRIFT)
    wild = timing.settled(rounds(count=9, spikes=1.0), empty=0)
    calm = timing.settled(rounds(count=9), empty=0)
    assert wild[3].high - wild[3].low > 2.0 * (calm[3].high - calm[3].low)


def test_the_interval_of_a_median_covers_it_as_often_as_said():
    """Of 1000 samples of an exponential distribution, whose median is log 2."""
    generator, inside = np.random.default_rng(2), 0
    for _ in range(1000):
        low, high = timing._interval(np.sort(generator.exponential(size=25)))
        inside += low <= np.log(2.0) <= high
    assert 930 <= inside <= 1000


def test_time_of_several_cores_is_what_passes_undisturbed():
    times = rounds(cores=2)
    times[::2, :, 1] *= 3.0  # every other round something else had the cores
    alone = timing.settled(rounds(), empty=0)
    for cores in (None, 2):
        for one, other in zip(timing.settled(times, 0, cores), alone, strict=True):
            assert one.cost == pytest.approx(other.cost, rel=0.05, abs=1e-4)


def test_where_rounds_were_never_at_rest_the_interval_says_so():
    """Two jobs that work alike, of which one once got both cores: they are not ranked."""
    rounds = [[(2.0, 2.0), (2.0, 2.0)] for _ in range(20)]
    rounds[3][1] = 2.0, 1.0
    one, lucky = timing.settled(rounds)
    assert lucky.cost == pytest.approx(1.0) and one.cost == pytest.approx(2.0)
    assert lucky.high >= one.low and 0.0 < lucky.low < lucky.cost


def test_jobs_take_turns_in_an_order_that_moves_on():
    order, jobs = [], [lambda name=name: order.append(name) for name in "abc"]

    def clock(job):
        job()
        return 1.0, 1.0  # more than any other: once a round

    found = timing.race(jobs, timing.Clock("", 1, clock), 0.0)
    text = "".join(order)
    assert text.startswith("abc" + "abc" + "bca" + "cab")
    assert len(found) == 3 and {one.cost for one in found} == {1.0}


class Card:
    """A context of a renderer with timer queries that tell `lie` times the truth."""

    def __init__(self, name, lie):
        self.info, self.lie, self.elapsed = {"GL_RENDERER": name}, lie, 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def finish(self):
        pass

    def query(self, time):
        return Query(self)


class Query:
    def __init__(self, card):
        self.card = card

    def __enter__(self):
        self.start = timing.time.perf_counter()

    def __exit__(self, *_):
        self.elapsed = (timing.time.perf_counter() - self.start) * 1e9 * self.card.lie


@pytest.mark.parametrize(
    ("name", "lie", "said"),
    [
        ("Some Card", 1.0, "timer queries, within"),
        ("Some Card", 0.02, "wall clock: timer queries are 98% off it"),
        ("llvmpipe (LLVM 15.0.6, 256 bits)", 1.0, "processor time"),
    ],
)
def test_timer_queries_are_believed_only_if_the_wall_clock_agrees(name, lie, said):
    ticks = iter(range(1 << 30))

    def load():
        while next(ticks) % 20000:
            pass

    assert timing.believed(Card(name, lie), [load]).said.startswith(said)
