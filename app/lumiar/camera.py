"""Where things are and how the eye sees them: 4x4 matrices as 16 floats, row by row.

Plain Python, so that a picture of a cached mesh needs no NumPy; every number is float64.
"""

import math

IDENTITY = (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def product(a, b):
    """Return the matrix product a b of two 4x4 matrices."""
    columns = [b[j::4] for j in range(4)]
    rows = [a[i : i + 4] for i in range(0, 16, 4)]
    return tuple(p * w + q * x + r * y + s * z for p, q, r, s in rows for w, x, y, z in columns)


def point(m, p):
    """Return the point p moved by the affine matrix m."""
    return tuple(sum(m[4 * i + k] * p[k] for k in range(3)) + m[4 * i + 3] for i in range(3))


def placement(position, rotation, scale):
    """Return the matrix that scales, turns about x, then y, then z (degrees), then moves."""
    (sx, cx), (sy, cy), (sz, cz) = (
        (math.sin(math.radians(angle)), math.cos(math.radians(angle))) for angle in rotation
    )
    turn = (
        (cy * cz, sx * sy * cz - cx * sz, cx * sy * cz + sx * sz),
        (cy * sz, sx * sy * sz + cx * cz, cx * sy * sz - sx * cz),
        (-sy, sx * cy, cx * cy),
    )
    rows = (
        (*(row[k] * scale[k] for k in range(3)), place)
        for row, place in zip(turn, position, strict=True)
    )
    return (*(value for row in rows for value in row), 0.0, 0.0, 0.0, 1.0)


def normal_matrix(m):
    """Return the 9 values, row by row, of the inverse transpose of m's 3x3 part, the largest 1.

    The factor changes no direction, and keeps any scale within the range of a float.
    """
    a, b, c, _, d, e, f, _, g, h, i = m[:11]
    cofactors = (
        (e * i - f * h, f * g - d * i, d * h - e * g),
        (c * h - b * i, a * i - c * g, b * g - a * h),
        (b * f - c * e, c * d - a * f, a * e - b * d),
    )
    values = [value for row in cofactors for value in row]
    largest = max(map(abs, values)) or 1.0
    return tuple(value / (-largest if mirrors(m) else largest) for value in values)


def linear_part(m):
    """Return the 9 values, row by row, of m's 3x3 part, scaled so that the largest is 1."""
    values = (*m[0:3], *m[4:7], *m[8:11])
    largest = max(map(abs, values)) or 1.0
    return tuple(value / largest for value in values)


def mirrors(m):
    """Return whether the matrix m turns a right hand into a left one."""
    a, b, c, _, d, e, f, _, g, h, i = m[:11]
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0


def look_at(eye, target, up):
    """Return the matrix from the world to the eye's own axes: x right, y up, looking along -z."""
    z = _unit(_minus(eye, target))
    x = cross(up, z)
    if dot(x, x) < 1e-12 * dot(up, up):  # looking along `up`: any other direction may be up
        x = cross((0.0, 0.0, -1.0) if abs(z[2]) < 0.9 else (0.0, 1.0, 0.0), z)
    x = _unit(x)
    y = cross(z, x)
    rows = ((*axis, -dot(axis, eye)) for axis in (x, y, z))
    return (*(value for row in rows for value in row), 0.0, 0.0, 0.0, 1.0)


def perspective(fov, aspect, near, far):
    """Return the projection onto clip space; fov is the vertical angle in degrees.

    y points down there, so that the first row OpenGL draws is the top row of the picture.
    """
    scale = 1.0 / math.tan(math.radians(fov) / 2.0)
    depth = near - far
    row = ((far + near) / depth, 2.0 * far * near / depth)
    first = (scale / aspect, 0.0, 0.0, 0.0, 0.0, -scale, 0.0, 0.0)
    return (*first, 0.0, 0.0, *row, 0.0, 0.0, -1.0, 0.0)


def enclosing(spheres):
    """Return (centre, radius) of a sphere around (centre, radius) spheres: that of their box."""
    low = [min(c[k] - r for c, r in spheres) for k in range(3)]
    high = [max(c[k] + r for c, r in spheres) for k in range(3)]
    centre = tuple((a + b) / 2.0 for a, b in zip(low, high, strict=True))
    return centre, max(math.dist(centre, c) + r for c, r in spheres)


def viewpoint(camera, aspect, centre, radius):
    """Return (eye, target) of a scene.Camera; what it leaves open frames a sphere of the scene."""
    target = camera.target or centre
    if camera.position:
        return camera.position, target
    half = math.radians(camera.fov) / 2.0
    half = min(half, math.atan(math.tan(half) * aspect))
    distance = camera.distance or 1.04 * radius / math.sin(half)
    azimuth, elevation = math.radians(camera.azimuth), math.radians(camera.elevation)
    flat = math.cos(elevation)
    away = (flat * math.sin(azimuth), math.sin(elevation), flat * math.cos(azimuth))
    return tuple(t + distance * a for t, a in zip(target, away, strict=True)), target


def clip_planes(eye, target, spheres):
    """Return (near, far) depths that hold all (centre, radius) spheres and keep the depth fine.

    A depth is along the view, from the eye to the target. Near stands before the nearest sphere,
    or, where the eye is within one, at a hundredth of its radius or of the distance to the target;
    never below 1e-6 of far, where 24 bits of depth tell nothing apart.
    """
    ahead = _unit(_minus(target, eye))
    depths = [(dot(_minus(centre, eye), ahead), 1.01 * radius) for centre, radius in spheres]
    depths = [(depth, radius) for depth, radius in depths if depth > -radius]  # not behind the eye
    distance = math.dist(eye, target)
    far = max((depth + radius for depth, radius in depths), default=2.0 * distance)
    near = min(
        (d - r if d > r else 0.01 * min(distance, r) for d, r in depths),
        default=distance,
    )
    return min(max(near, 1e-6 * far), 0.999 * far), far


def _minus(a, b):
    return tuple(p - q for p, q in zip(a, b, strict=True))


def dot(a, b):
    """Return the scalar product of two vectors."""
    return sum(p * q for p, q in zip(a, b, strict=True))


def cross(a, b):
    """Return the vector product of two vectors of three numbers."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def _unit(a):
    length = math.hypot(*a)
    return tuple(p / length for p in a)
