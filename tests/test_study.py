"""Points of error against cost: the front, what is ranked, and the sentences that follow."""

import pytest

from lumiar import advice, ledger, study
from lumiar.timing import Timing

NAMES = {name: name.upper() for name in ("exact", "quick", "slow", "wrong", "planted")}


def point(variant, error, cost, width=0.1, default=False):
    timing = Timing(cost, cost * (1.0 - width), cost * (1.0 + width), 1.0, 9)
    return study.points("case", variant, {"absolute": error}, timing, default=default)[0]


BARGAIN = [point("exact", 1e-7, 1.4, default=True), point("quick", 0.036, 1.0)]


def marked(found):
    return study.marked(found, {"absolute": study.SHARE})


def front(found):
    return [p.variant for p in marked(found) if p.pareto]


def said(found, lang="en"):
    return advice.sentences(marked(found), study.SHARE, NAMES, lang)


def test_what_is_cheaper_and_what_is_more_exact_are_the_front():
    assert front(BARGAIN) == ["exact", "quick"]


def test_a_planted_slow_and_wrong_variant_is_beaten():
    assert front([*BARGAIN, point("planted", 0.5, 9.0)]) == ["exact", "quick"]
    assert said([*BARGAIN, point("planted", 0.5, 9.0)])[-1] == "No bargain: PLANTED."


def test_many_that_are_beaten_are_counted_and_only_the_best_of_them_named():
    found = [*BARGAIN, *(point("planted", 0.5 + 0.1 * i, 9.0 + i) for i in range(5))]
    assert said(found)[-1].count("PLANTED") == 5 and "more" not in said(found)[-1]
    found = [*found, point("planted", 2.0, 20.0), point("planted", 3.0, 20.0)]
    assert said(found)[-1] == f"No bargain: {'PLANTED, ' * 4}3 more."


def test_a_planted_fast_and_exact_variant_is_the_front():
    found = [*BARGAIN, point("planted", 0.0, 0.2)]
    assert front(found) == ["planted"]
    assert said(found) == [
        "PLANTED has no error to speak of, and nothing is clearly cheaper: use it.",
        "No bargain: EXACT, QUICK.",
    ]


def test_a_default_is_beaten_if_it_is_in_no_metric_the_better_one():
    metrics = {"absolute": study.SHARE, "relative": study.RELATIVE}

    def both(name, absolute, relative, cost):
        one = point(name, absolute, cost, default=name == "exact")
        return [one, one._replace(metric="relative", error=relative)]

    plain = both("exact", 1e-3, 1e-3, 2.0)
    assert study.beaten([*plain, *both("planted", 1e-3, 1e-3, 1.0)], metrics) == {
        "case": ("exact", ["planted"])
    }
    assert study.beaten([*plain, *both("planted", 1e-3, 2e-3, 1.0)], metrics) == {}
    assert study.beaten([*plain, *both("planted", 1e-4, 1e-4, 3.0)], metrics) == {}
    said = advice.beaten("exact", ["planted"], NAMES, "en")
    assert said == "Lumiar's default, EXACT, is beaten by PLANTED."


def test_what_noise_could_turn_round_is_not_said():
    """Equal errors, and costs that overlap, or that nobody knows: both stay on the front."""
    assert front([point("exact", 0.1, 1.0), point("quick", 0.1, 1.1)]) == ["exact", "quick"]
    vague = point("exact", 0.01, 1.0, width=0.9)
    assert front([vague, point("quick", 0.1, 1.0)]) == ["exact", "quick"]


def test_at_about_the_same_cost_the_lower_error_decides():
    assert front([point("exact", 0.01, 1.05), point("quick", 0.1, 1.0)]) == ["exact"]


def test_errors_below_what_float32_leaves_are_alike():
    found = [point("exact", 1e-7, 1.0), point("quick", 3e-7, 1.05)]
    assert front(found) == ["exact", "quick"]
    assert front([*found, point("slow", 0.0, 2.0)]) == ["exact", "quick"]


def test_the_default_is_advised_where_nothing_tells_it_from_another():
    found = [point("exact", 3e-7, 1.0, default=True), point("quick", 1e-7, 0.99)]
    assert said(found)[0].startswith("EXACT has no error")


def test_errors_that_hardly_differ_leave_the_default():
    found = [point("exact", 0.00101, 1.0, default=True), point("quick", 0.001, 0.99)]
    assert said(found)[0].startswith("EXACT errs by 0.001")


def test_the_sentence_is_derived_from_the_figures():
    assert said(BARGAIN) == [
        "EXACT costs 0.4 ns more than QUICK and removes an error of up to 0.036: use it."
    ]
    assert said(BARGAIN, "pt") == [
        "EXACT custa 0,4 ns a mais que QUICK e elimina um erro de até 0,036: use."
    ]
    turned = [point("exact", 1e-7, 5.4), point("quick", 1e-3, 1.0)]  # which no display shows
    assert said(turned)[0].startswith("QUICK errs by 0.001 at most, which does not show")
    rough = [point("exact", 0.01, 5.0), point("quick", 0.5, 1.0)]
    assert said(rough) == [
        "EXACT costs 4 ns more than QUICK and brings the error from 0.5 down to 0.01: use it.",
        "Its error still shows.",
    ]


@pytest.mark.parametrize(
    ("costs", "verdict"),
    [((1.0, 2.0, 3.0), True), ((1.0, 3.0, 2.0), False), ((1.0, 1.05, 2.0), None)],
)
def test_an_order_is_true_false_or_not_to_be_told(costs, verdict):
    assert study.in_order([point("exact", 0.0, cost) for cost in costs]) is verdict


def test_a_point_without_truth_is_on_no_front():
    assert front([point("exact", None, 1.0), point("quick", 0.1, 2.0)]) == ["quick"]


def report(found):
    rows = [study.as_row(p._replace(study="fresnel")) for p in marked(found)]
    return {"schema": 1, "made": {}, "studies": [{"name": "fresnel", "points": rows}]}


def test_a_report_reads_back():
    assert ledger.points(report(BARGAIN)) == [p._replace(study="fresnel") for p in marked(BARGAIN)]


def test_compare_tells_what_changed_beyond_noise():
    old = report(BARGAIN)
    assert ledger.changes(old, old) == ([], False)
    nearly = report([BARGAIN[0]._replace(cost=1.5, low=1.4, high=1.6), BARGAIN[1]])
    assert ledger.changes(old, nearly) == ([], False)
    slower = report([BARGAIN[0]._replace(cost=2.8, low=2.7, high=2.9), BARGAIN[1]])
    assert ledger.changes(old, slower)[1] and not ledger.changes(slower, old)[1]
    worse = report([BARGAIN[0], BARGAIN[1]._replace(error=0.0361)])
    lines, bad = ledger.changes(old, worse)
    assert bad and lines == ["fresnel, case, quick: absolute error 0.036 -> 0.0361"]
    assert not ledger.changes(worse, old)[1]


def test_a_slower_machine_is_no_change_of_the_program():
    slow = [p._replace(cost=p.cost * 2, low=p.low * 2, high=p.high * 2) for p in BARGAIN]
    lines, worse = ledger.changes(report(BARGAIN), report(slow))
    assert not worse and [line[:25] for line in lines] == ["costs are 2.00 times the "]
