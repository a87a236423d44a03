"""The floor: one frame by hand in moderngl, with nothing that it does not need.

python floor.py MESH SIZE SAMPLES OUT.png    (MESH.bin, as bench.py writes it, or MESH.obj by trimesh)
Blinn's model, slide form, default values, default lights, on a mesh around the origin.
"""
import math, mmap, os, struct, sys, zlib
import moderngl
from glcontext import egl
from isal import isal_zlib

VERTEX = """#version 330 core
uniform mat4 clip; in vec3 p; in vec3 n; out vec3 at; out vec3 normal;
void main() { gl_Position = clip * vec4(p, 1.0); at = p; normal = n; }"""
LOBE = """float z = e / (2.0 - e), z2 = z * z;
    float s = e < 0.3 ? -2.0 * z * (1.0 + z2 * (1.0 / 3.0 + z2 * (0.2 + z2 / 7.0))) : log(1.0 - e);
    float lobe = e < 1.0 ? exp(m * s) : 0.0;"""
FRAGMENT = """#version 330 core
uniform vec3 eye, L, E, ambient, ka, kd, ks; uniform float m; in vec3 at; in vec3 normal; out vec4 color;
void main() {
    vec3 N = normalize(normal), V = normalize(eye - at); float NdotL = dot(N, L);
    if (NdotL <= 0.0) { color = vec4(ka * ambient, 1.0); return; }
    vec3 d = N - normalize(L + V); float e = 0.5 * dot(d, d);
    LOBE
    color = vec4(ka * ambient + (kd * NdotL + ks * lobe) * E * 0.318309886, 1.0);
}"""
SCREEN = """#version 330 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }"""
PRESENT = """#version 330 core
uniform sampler2D radiance; out vec4 color;
void main() {
    ivec2 q = ivec2(gl_FragCoord.xy) * SIDE; vec3 c = vec3(0.0);
    for (int y = 0; y < SIDE; ++y) for (int x = 0; x < SIDE; ++x) c += texelFetch(radiance, q + ivec2(x, y), 0).rgb;
    c = clamp(c / float(SIDE * SIDE), 0.0, 1.0);
    color = vec4(mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308))), 1.0);
}"""


def load(path):
    if path.endswith(".bin"):
        with open(path, "rb") as file:
            return memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
    import numpy as np, trimesh
    mesh = trimesh.load(path, process=False)
    p, n, f = mesh.vertices, mesh.vertex_normals, mesh.faces
    head = struct.pack("<qd", len(p), float(np.linalg.norm(p - (p.min(0) + p.max(0)) / 2, axis=1).max()))
    return memoryview(head + np.concatenate([p, n], 1).astype("f4").tobytes() + f.astype("u4").tobytes())


class Floor:
    def __init__(self, ctx, data, size, side, lobe=LOBE):
        self.ctx, count, radius = ctx, *struct.unpack_from("<qd", data)
        d, t, a, b = 1.04 * radius / math.sin(math.radians(15)), 1 / math.tan(math.radians(15)), *map(math.radians, (20, 15))
        z = (math.cos(b) * math.sin(a), math.sin(b), math.cos(b) * math.cos(a))
        x = (math.cos(a), 0.0, -math.sin(a))
        y = (z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0])
        k, m = -d / (1.01 * radius), ((1.01 * radius) ** 2 - d * d) / (1.01 * radius)
        # the origin seen from d z, upside down, so that the first row read is the top one
        columns = [v for i in range(3) for v in (t * x[i], -t * y[i], k * z[i], -z[i])]
        program = ctx.program(vertex_shader=VERTEX, fragment_shader=FRAGMENT.replace("LOBE", lobe))
        program["clip"].write(struct.pack("16f", *columns, 0.0, 0.0, -k * d + m, d))
        toward = [v / math.hypot(0.75, 0.8, 0.6) for v in (0.75, 0.8, 0.6)]
        values = {"E": math.pi, "ambient": 1.0, "ka": 0.1, "kd": 0.5, "ks": 0.4}
        for name, value in {**{n: [v] * 3 for n, v in values.items()}, "L": toward, "eye": [d * v for v in z]}.items():
            program[name].value = tuple(value)
        program["m"].value = 160.0
        buffer, indices = ctx.buffer(data[16 : 16 + 24 * count]), ctx.buffer(data[16 + 24 * count :])
        self.mesh = ctx.vertex_array(program, [(buffer, "3f 3f", "p", "n")], indices)
        self.screen = ctx.vertex_array(ctx.program(vertex_shader=SCREEN, fragment_shader=PRESENT.replace("SIDE", str(side))), [])
        self.radiance = ctx.texture((size * side, size * side), 4, dtype="f4")
        self.frame = ctx.framebuffer([self.radiance], ctx.depth_renderbuffer((size * side, size * side)))
        self.out = ctx.framebuffer([ctx.texture((size, size), 4)])

    def draw(self):
        self.frame.use()
        self.frame.clear(0.05, 0.05, 0.05, 0.0)
        self.ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self.ctx.front_face = "cw"
        self.mesh.render()
        self.radiance.use(0)
        self.out.use()
        self.ctx.enable_only(moderngl.NOTHING)
        self.screen.render(moderngl.TRIANGLES, vertices=3)


if __name__ == "__main__":
    path, size, samples, out = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
    raw = egl.create_context(mode="standalone", libgl="libGL.so.1", libegl="libEGL.so.1", glversion=330)
    floor = Floor(moderngl.create_context(context=raw), load(path), size, math.isqrt(samples))
    floor.draw()
    rows = floor.out.read(components=3)
    chunk = lambda k, d: struct.pack(">I", len(d)) + k + d + struct.pack(">I", zlib.crc32(k + d))
    packed = isal_zlib.compress(b"".join(b"\0" + rows[i : i + 3 * size] for i in range(0, len(rows), 3 * size)), 1)
    head = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    with open(out, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", packed) + chunk(b"IEND", b""))
    os._exit(0)
