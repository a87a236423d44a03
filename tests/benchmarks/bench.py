"""Speed against the floor of floor.py: cold start, frame, switch. python tests/benchmarks/bench.py

Every figure is a median over runs that alternate with the floor's, and a ratio of such pairs, since
machines are shared and noisy. Nothing here is a test.
"""

import json
import math
import os
import statistics
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent
RUNS = int(os.environ.get("RUNS", "15"))


def main():
    """Print every figure, and write them to the JSON file named on the command line, if any."""
    with tempfile.TemporaryDirectory() as folder:
        os.environ["XDG_CACHE_HOME"] = folder
        figures = {"machine": machine(), **cold(Path(folder)), **frames(), **switches()}
        figures |= panels()
    if len(sys.argv) > 1:
        Path(sys.argv[1]).write_text(json.dumps(figures, indent=2) + "\n")


def machine():
    """Return and print what this ran on."""
    from lumiar import Renderer

    with Renderer() as renderer:
        name = renderer.name
    version = sys.version.split()[0]
    said = f"{name}; Python {version}; {os.cpu_count()} cores; {RUNS} runs"
    print(said)
    return said


def cold(folder):
    """Return whole-process times: a 70k-triangle OBJ to a PNG of 1024 x 1024."""
    obj, binary = folder / "torus.obj", folder / "torus.bin"
    write_obj(obj)
    write_binary(binary, str(obj))
    found = {}
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    lumiar = [str(Path(sys.executable).with_name("lumiar")), "capture", "--mesh", str(obj)]
    for samples in (1, 4):
        ours = [*lumiar, "--model", "blinn", "--size", "1024x1024", "--samples", str(samples)]
        ours += ["-o", str(folder / "ours.png")]
        for name, mesh, cache in (
            ("cached", binary, None),
            ("without cache, floor reads OBJ", obj, folder / "lumiar"),
            ("without cache", binary, folder / "lumiar"),
        ):
            floor = [sys.executable, str(HERE / "floor.py"), str(mesh), "1024", str(samples)]
            times = paired(ours, [*floor, str(folder / "floor.png")], environment, cache)
            report(found, f"cold {name}, {samples} samples", times)
        check_same(folder / "ours.png", folder / "floor.png")
    return found


def paired(ours, floor, environment, cache):
    """Return [(seconds of ours, seconds of the floor)], one after the other, after a warm-up."""
    times = []
    for i in range(RUNS + 1):
        if cache:
            for entry in cache.iterdir():
                entry.unlink()
        pair = []
        for command in (ours, floor):
            start = time.perf_counter()
            subprocess.run(command, check=True, env=environment, stdout=subprocess.DEVNULL)
            pair.append(time.perf_counter() - start)
        times.append(pair) if i else None
    return times


def frames():
    """Return frame times by size and by triangles; the floor also with a bare pow."""
    from floor import LOBE, Floor

    from lumiar import Renderer, Scene

    naive = "float lobe = pow(max(1.0 - e, 0.0), m);"
    found = {}
    for size in (512, 1024, 2048):
        for rings in (20, 120, 374, 1000):
            mesh = f"torus:rings={rings}:segments={rings // 2}"
            with Renderer() as renderer:
                scene = Scene.default().set(model="blinn", mesh=mesh, size=(size, size), samples=1)
                radiance, picture = renderer._target(size, size, 1, False)
                data = memoryview(binary_of(mesh))
                floors = [Floor(renderer.context, data, size, 1, lobe) for lobe in (LOBE, naive)]

                def ours(renderer=renderer, scene=scene, targets=(radiance, picture), size=size):
                    renderer.draw(scene, targets[0])
                    renderer.present(scene, *targets)

                jobs = [ours, *(floor.draw for floor in floors)]
                times = interleaved(renderer.context, jobs)
                label = f"frame {size}, {rings * (rings // 2) * 2} triangles"
                report(found, label, [(a, b) for a, b, _ in times])
                report(found, f"{label}, floor with pow", [(a, c) for a, _, c in times], quiet=True)
    return found


def interleaved(context, jobs, seconds=1.5):
    """Return the times of jobs drawn in turn until `seconds` have passed, at least 7 rounds."""
    times, started = [], time.perf_counter()
    while len(times) < 10 or (time.perf_counter() - started < seconds and len(times) < 200):
        row = []
        for job in jobs:
            start = time.perf_counter()
            job()
            context.finish()
            row.append(time.perf_counter() - start)
        times.append(row)
    return times[3:]


def switches():
    """Return host time per frame, and of a switch to what is compiled already (no drawing)."""
    from lumiar import Renderer, Scene

    scene = Scene.default().set(mesh="sphere:subdivision=1", size=(8, 8), samples=1)
    others = [scene, scene.set(model="blinn"), scene.set(shading="flat"), scene.set(shininess=9.0)]
    found = {}
    with Renderer() as renderer:
        targets = renderer._target(8, 8, 1, False)

        def frame(one):
            start = time.perf_counter()
            renderer.draw(one, targets[0])
            renderer.present(one, *targets)
            spent = time.perf_counter() - start
            renderer.context.finish()
            return spent

        for one in others * 3:
            frame(one)
        same = [frame(scene) for _ in range(300)]
        switched = [frame(one) for _ in range(100) for one in others]
        edited = [frame(scene.set(shininess=1.0 + i)) for i in range(300)]
    for name, times in (
        ("host time of a frame", same),
        ("host time of a frame after a switch of model, rate or value", switched),
        ("host time of a frame of a new scene", edited),
    ):
        found[name] = {
            "ms": 1e3 * statistics.median(times),
            "p95": 1e3 * sorted(times)[-len(times) // 20],
        }
        print(f"{name:62} {found[name]['ms']:7.3f} ms, 95 % under {found[name]['p95']:.3f}")
    return found


def panels():
    """Return what a frame of the window's panel costs, all of it in view, without drawing it."""
    from imgui_bundle import imgui

    from lumiar import Scene, panel

    found, context = {}, imgui.create_context()
    io = imgui.get_io()
    io.backend_flags |= imgui.BackendFlags_.renderer_has_textures
    io.display_size, io.delta_time = (1920.0, 4000.0), 1.0 / 60.0
    panel.prepare()
    for name in ("teapot", "lights", "room-corner"):
        scene, state, times = Scene.load(name), panel.State("en"), []
        for _ in range(300):
            start = time.perf_counter()
            imgui.new_frame()
            panel.draw(scene, state)
            imgui.render()
            times.append(time.perf_counter() - start)
            for texture in imgui.get_platform_io().textures:
                texture.set_tex_id(1)
                texture.set_status(imgui.ImTextureStatus.ok)
        found[f"panel, {name}"] = cost = 1e3 * statistics.median(times)
        print(f"{'panel of ' + name:48} {cost:8.2f} ms a frame, at most 2")
    imgui.destroy_context(context)
    return found


def report(found, name, times, quiet=False):
    """Print and note the medians of pairs of seconds, and of their ratio."""
    ours, floor = (1e3 * statistics.median(column) for column in zip(*times, strict=True))
    ratios = sorted(a / b for a, b in times)
    ratio = statistics.median(ratios)
    low, high = ratios[len(ratios) // 4], ratios[-1 - len(ratios) // 4]
    found[name] = {"ours ms": ours, "floor ms": floor, "ratio": ratio, "quartiles": [low, high]}
    if not quiet:
        spread = f"{ratio:.3f} ({low:.3f} to {high:.3f})"
        print(f"{name:48} {ours:8.2f} ms, floor {floor:8.2f} ms: {spread}")


def binary_of(spec):
    """Return a mesh as floor.py reads it: vertex count, radius, vertices, indices."""
    from lumiar import geometry

    mesh = geometry.load(spec)
    head = struct.pack("<qd", mesh.vertex_count, mesh.radius)
    return b"".join((head, mesh.vertices, mesh.indices))


def write_binary(path, spec):
    path.write_bytes(binary_of(spec))


def write_obj(path):
    """Write a torus of 70,000 triangles with normals, centred on the origin."""
    rings, segments = 250, 140
    lines, faces = [], []
    for i in range(rings):
        u = 2.0 * math.pi * i / rings
        for j in range(segments):
            v = 2.0 * math.pi * j / segments
            n = (math.cos(v) * math.sin(u), math.sin(v), math.cos(v) * math.cos(u))
            p = (math.sin(u) + 0.4 * n[0], 0.4 * n[1], math.cos(u) + 0.4 * n[2])
            lines.append(
                f"v {p[0]:.6f} {p[1]:.6f} {p[2]:.6f}\nvn {n[0]:.6f} {n[1]:.6f} {n[2]:.6f}\n"
            )
            a, b = i * segments + j, i * segments + (j + 1) % segments
            c, d = ((i + 1) % rings * segments + k % segments for k in (j, j + 1))
            for face in ((a, c, b), (b, c, d)):
                faces.append("f " + " ".join(f"{k + 1}//{k + 1}" for k in face) + "\n")
    path.write_text("".join(lines + faces))


def check_same(ours, floor):
    """Stop unless both programs drew the same picture."""
    from lumiar import difference, image

    found = difference.measure(image.read(ours)[0], image.read(floor)[0], 1.5 / 255)
    if found["share"] > 1e-4:
        raise SystemExit(f"the floor draws another picture: {found}")


if __name__ == "__main__":
    main()
