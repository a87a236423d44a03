"""TOML written by us is what tomllib, the standard library's reader, takes it for."""

import tomllib

from hypothesis import given, settings
from hypothesis import strategies as st

from lumiar.tomltext import Place, dumps

text = st.text(st.characters(exclude_categories=["Cs"]), min_size=1)
number = st.floats(allow_nan=False, allow_infinity=False) | st.integers(-(2**62), 2**62)
plain = st.booleans() | number | text | st.lists(number, min_size=1) | st.lists(text, min_size=1)
table = st.dictionaries(text, plain, min_size=1)
nested = st.dictionaries(text, plain | table, min_size=1)


@settings(max_examples=200, deadline=None)
@given(st.dictionaries(text, plain | nested | st.lists(nested, min_size=1), min_size=1))
def test_what_is_written_is_what_is_read(data):
    assert tomllib.loads(dumps(data)) == data


def test_what_says_nothing_is_left_out():
    data = {"a": None, "b": "", "c": [], "d": {}, "e": 0, "f": False, "g": [{"h": None, "i": 1}]}
    assert tomllib.loads(dumps(data)) == {"e": 0, "f": False, "g": [{"i": 1}]}


def test_a_key_is_found_where_it_stands():
    lines = "a = 1\n[[t]]\nk = 2\n[[t]]\n  'k' = 3\nx.y = 4\n[u]\nk = 5\n"
    for place, expected in (
        (Place(lines, "f", "a"), "f:1: "),
        (Place(lines, "f", "k", "t", 0), "f:3: t 1: "),
        (Place(lines, "f", "k", "t", 1), "f:5: t 2: "),
        (Place(lines, "f", "x", "t", 1), "f:6: t 2: "),
        (Place(lines, "f", "gone", "t", 1), "f:4: t 2: "),
        (Place(lines, "f", "k", "u"), "f:8: "),
        (Place(lines, "f", "u"), "f:7: "),
        (Place("", "f", "a"), "f:1: "),
    ):
        assert str(place) == expected
