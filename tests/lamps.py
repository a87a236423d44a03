"""The functions of one light file on the graphics card, at any places, directions and chances."""

import math

import moderngl
import numpy as np

from lumiar import catalog, flatten, surroundings
from lumiar.parts import Light

WIDTH = 512  # of the picture whose pixels are the rows
MAIN = """
#include "LIGHTS"
uniform sampler2D test_input;
out vec4 test_result;
void main() {
    vec4 a = texelFetch(test_input, ivec2(gl_FragCoord.xy), 0);
    EXPRESSION
}
"""
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


def evaluated(context, light, expression, rows):
    """Return (n, 4) float32 of a GLSL expression of the light's functions, a: row of (n, 2 to 4)."""
    rows = np.asarray(rows, np.float32)
    count, high = len(rows), -(-len(rows) // WIDTH)
    filled = np.zeros((high * WIDTH, 4), np.float32)
    filled[:count, : rows.shape[1]] = rows
    code = expression if "test_result" in expression else f"test_result = {expression};"
    places = {
        "MAIN": [("test", "rigs", MAIN.replace("EXPRESSION", code))],
        "LIGHTS": [(light.kind.path, "lights", light.kind.text)],
    }
    source = flatten.finish(flatten.flatten("MAIN", places, {}, {})).text
    program = context.program(vertex_shader=VERTEX, fragment_shader=source)
    made = [program]
    for name, value in uniforms(light).items():
        if name in program:
            program[name].write(value)
    tables = {k: v for k, v in surroundings.given(light).items() if not isinstance(v, bytes)}
    tables["test_input"] = surroundings.Texels((WIDTH, high), 4, filled.tobytes())
    for unit, (name, table) in enumerate(tables.items()):
        if name in program:
            texture = context.texture(table.size, table.components, table.data, dtype="f4")
            texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
            texture.use(unit)
            program[name].value = unit
            made.append(texture)
    target = context.texture((WIDTH, high), 4, dtype="f4")
    framebuffer = context.framebuffer([target])
    framebuffer.use()
    array = context.vertex_array(program, [])
    array.render(moderngl.TRIANGLES, vertices=3)
    result = np.frombuffer(framebuffer.read(components=4, dtype="f4"), np.float32)
    for one in (array, framebuffer, target, *made):
        one.release()
    return result.reshape(-1, 4)[:count]


def uniforms(light):
    """Return {name: bytes} of the values and of what the host gives, as the shader takes them."""
    found = {k: v for k, v in surroundings.given(light).items() if isinstance(v, bytes)}
    values = light.kind.in_radians(light.values)
    for parameter in light.kind.parameters:
        value = values[parameter.name]
        value = np.multiply(value, values["color"]) if parameter.tinted else value
        found[parameter.name] = np.asarray(value, np.float32).tobytes()
    return found
