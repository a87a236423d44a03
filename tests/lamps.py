"""The functions of one light file on the graphics card, at any places, directions and chances."""

import functools
import math

import moderngl
import numpy as np

from lumiar import catalog, compose, flatten, surroundings
from lumiar.card import OnCard
from lumiar.parts import Light

WIDTH = 512  # of the picture whose pixels are the rows
MAIN = """
#include "LIGHTS"
uniform sampler2D test_input;
out vec4 test_result;
void main() {
    vec4 a = texelFetch(test_input, ivec2(gl_FragCoord.xy), 0);
    test_result = CASE;
}
"""
CASES = {  # name: what it makes of a row a
    "environment": "vec4(environment_1(a.xyz), 0.0)",
    "arriving": "vec4(arriving_1(vec3(0.0), a.xyz), 0.0)",
    "density": "vec4(density_1(vec3(0.0), a.xyz))",
    "exact": "vec4(irradiance_1(vec3(0.0), a.xyz), 0.0)",
    "direction": "vec4(light_1(vec3(0.0), a.xy).direction, 0.0)",
    "irradiance": "vec4(light_1(vec3(0.0), a.xy).irradiance, 0.0)",
}
VERTEX = """#version 330 core
void main() {
    gl_Position = vec4(vec2[3](vec2(-1, -1), vec2(3, -1), vec2(-1, 3))[gl_VertexID], 0, 1);
}
"""


def light(name, image="", **values):
    """Return the Light of a shipped file, with some of its values and an image."""
    kind = catalog.read("light", name)
    return Light(kind, {**kind.defaults(), **values}, image=image)


def sky_angles(directions, height, azimuth):
    """Return (vertical component, angle from the sun [rad]) of directions, float64.

    height, azimuth: of the sun, degrees.
    """
    d = directions / np.linalg.norm(directions, axis=1)[:, None]
    h, a = math.radians(height), math.radians(azimuth)
    s = np.array([math.cos(h) * math.sin(a), math.sin(h), math.cos(h) * math.cos(a)])
    gamma = np.arctan2(np.linalg.norm(np.cross(d, s), axis=1), d @ s)
    return d[:, 1], gamma


@functools.lru_cache(maxsize=16)
def program_of(context, name, what):
    """Return the program that evaluates one of CASES of a light file."""
    kind = catalog.read("light", name)
    places = {
        "MAIN": [("test", "rigs", MAIN.replace("CASE", CASES[what]))],
        "LIGHTS": [(kind.path, "lights", compose._renamed(kind, 1, {}))],
    }
    source = flatten.finish(flatten.flatten("MAIN", places, {}, {})).text
    return context.program(vertex_shader=VERTEX, fragment_shader=source)


def evaluated(context, light, what, rows):
    """Return (n, 3) float64 of one of CASES for rows (n, 2 to 4) of numbers."""
    rows = np.asarray(rows, np.float32)
    count, high = len(rows), -(-len(rows) // WIDTH)
    filled = np.zeros((high * WIDTH, 4), np.float32)
    filled[:count, : rows.shape[1]] = rows
    program = program_of(context, light.kind.name, what)
    for name, value in uniforms(light).items():
        if f"{name}_1" in program:
            program[f"{name}_1"].write(value)
    made = []
    for name, value in uniforms(light).items():
        if f"{name}_1" in program:
            program[f"{name}_1"].write(value)
    given = surroundings.given(light).items()
    tables = {f"{k}_1": v for k, v in given if not isinstance(v, bytes)}
    tables["test_input"] = surroundings.Texels((WIDTH, high), 4, filled.tobytes())
    for unit, (name, table) in enumerate(tables.items()):
        if name in program:
            texture = context.texture(table.size, table.components, table.data, dtype="f4")
            texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
            texture.use(unit)
            program[name].value = unit
            made.append(texture)
    framebuffer = context.framebuffer([context.texture((WIDTH, high), 4, dtype="f4")])
    framebuffer.use()
    array = context.vertex_array(program, [])
    array.render(moderngl.TRIANGLES, vertices=3)
    result = np.frombuffer(framebuffer.read(components=4, dtype="f4"), np.float32)
    OnCard(context).free_framebuffer(framebuffer)
    for one in (array, *made):  # not the program, which stays
        one.release()
    return result.reshape(-1, 4)[:count, :3].astype(float)


def uniforms(light):
    """Return {name: bytes} of the values and of what the host gives, as the shader takes them."""
    found = {k: v for k, v in surroundings.given(light).items() if isinstance(v, bytes)}
    values = light.kind.in_radians(light.values)
    for parameter in light.kind.parameters:
        value = values[parameter.name]
        value = np.multiply(value, values["color"]) if parameter.tinted else value
        found[parameter.name] = np.asarray(value, np.float32).tobytes()
    return found


def drawn(context, light, u):
    """Return (directions (n, 3), densities (n,), irradiances (n, 3)) that points u (n, 2) pick."""
    directions = evaluated(context, light, "direction", u)
    density = evaluated(context, light, "density", directions)[:, 0]
    return directions, density, evaluated(context, light, "irradiance", u)


def seen(context, light, directions, what="environment"):
    """Return (n, 3) of one of CASES for directions (n, 3)."""
    return evaluated(context, light, what, directions)


def even(count):
    """Return directions (count, 3) spread evenly over the sphere, on a Fibonacci spiral."""
    i = np.arange(count) + 0.5
    y, phi = 1.0 - 2.0 * i / count, i * math.pi * (3.0 - math.sqrt(5.0))
    s = np.sqrt(1.0 - y * y)
    return np.stack([s * np.cos(phi), y, s * np.sin(phi)], 1)


def grid(across, down):
    """Return points (across * down, 2) in the middles of equal cells of the unit square."""
    x, y = np.meshgrid(np.arange(across) + 0.5, np.arange(down) + 0.5)
    return np.stack([x.ravel() / across, y.ravel() / down], 1)


def jittered(across, down):
    """Return points (across * down, 2), one at random in each of equal cells of the unit square."""
    moved = np.random.default_rng(4).random((across * down, 2)) - 0.5
    return grid(across, down) + moved / (across, down)


def chance_of_such(context, light, count, cells, extent=math.pi, turn=0.0):
    """Return the chance that a chi-square is larger than that of `count` random directions.

    Bins are the quarters of cells (columns around y from azimuth `turn` [rad], rows from +y down to
    `extent`), within which the density is constant.
    """
    columns, rows = 2 * cells[0], 2 * cells[1]
    u = np.random.default_rng(5).random((count, 2))
    directions = evaluated(context, light, "direction", u)

    def places(polar, azimuth):
        row = np.minimum((polar / extent * rows).astype(int), rows - 1)
        column = ((azimuth - turn) % (2.0 * math.pi) / (2.0 * math.pi) * columns).astype(int)
        return row * columns + np.minimum(column, columns - 1)

    polar = np.arctan2(np.hypot(directions[:, 0], directions[:, 2]), directions[:, 1])
    azimuth = np.arctan2(directions[:, 0], directions[:, 2])
    found = np.bincount(places(polar, azimuth), minlength=rows * columns)
    polar, azimuth = (np.arange(n) + 0.5 for n in (rows, columns))
    polar, azimuth = np.meshgrid(polar * extent / rows, azimuth * 2.0 * math.pi / columns + turn)
    polar, azimuth = polar.ravel(), azimuth.ravel()
    middles = np.stack(
        [np.sin(polar) * np.sin(azimuth), np.cos(polar), np.sin(polar) * np.cos(azimuth)], 1
    )
    density = evaluated(context, light, "density", middles)[:, 0]
    angle = 2.0 * np.sin(polar) * math.sin(extent / rows / 2.0) * 2.0 * math.pi / columns
    expected = np.zeros(rows * columns)
    expected[places(polar, azimuth)] = count * density * angle
    assert abs(expected.sum() / count - 1.0) < 1e-5
    rare = expected < 10.0
    found = np.append(found[~rare], found[rare].sum())
    expected = np.append(expected[~rare], max(expected[rare].sum(), 1e-3))
    statistic, freedom = ((found - expected) ** 2 / expected).sum(), len(found) - 1
    # E. Wilson and M. Hilferty, 1931
    z = ((statistic / freedom) ** (1 / 3) - (1 - 2 / (9 * freedom))) / math.sqrt(2 / (9 * freedom))
    return 0.5 * math.erfc(z / math.sqrt(2.0))
