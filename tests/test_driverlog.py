"""The logs of all drivers lead back to the file and line that a person wrote.

The samples follow the forms that the drivers print; Mesa's are checked live in test_renderer.py.
"""

import pytest

from lumiar.driverlog import locate
from lumiar.flatten import Source

LINES = (("", 0), *(("models/ward.glsl", n) for n in range(10, 30)))
SOURCES = {
    "vertex": Source("", (("", 0), ("rigs/phong.vert", 1))),
    "fragment": Source("", LINES),
}
HEAD = "GLSL Compiler failed\n\nfragment_shader\n===============\n"


@pytest.mark.parametrize(
    ("log", "message"),
    [
        ("0:7(32): error: `nope' undeclared", "`nope' undeclared"),
        ("0:3(1): warning: unused\n0:7(32): error: no matching function", "no matching function"),
        ("0:7(4): preprocessor error: syntax error", "syntax error"),
        ('0(7) : error C1008: undefined variable "nope"', 'undefined variable "nope"'),
        ("0(3) : warning C7011: cast\n0(7) : error C0000: syntax error", "syntax error"),
        ("ERROR: 0:7: 'nope' : undeclared identifier", "'nope' : undeclared identifier"),
        (
            "WARNING: 0:3: x\nERROR: 0:7: 'nope' : undeclared\nERROR: 1 compilation errors.",
            "'nope' : undeclared",
        ),
        ("ERROR: 0:7: Use of undeclared identifier 'nope'", "Use of undeclared identifier 'nope'"),
    ],
)
def test_the_line_is_found(log, message):
    assert locate(HEAD + log, SOURCES) == ("models/ward.glsl", 15, message)


def test_the_stage_is_told_by_its_heading():
    log = "GLSL Compiler failed\n\nvertex_shader\n=============\n0:2(1): error: bad"
    assert locate(log, SOURCES) == ("rigs/phong.vert", 1, "bad")


def test_a_log_without_a_line_still_says_something():
    assert locate("GLSL Linker failed\n\nerror: too many varyings", SOURCES) == (
        "",
        0,
        "error: too many varyings",
    )
    assert locate("", SOURCES)[2]
    assert locate(HEAD + "0:999(1): error: beyond the end", SOURCES)[0] == ""
