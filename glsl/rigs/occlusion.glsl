// Whether anything stands in the way of light: rays through the textures of app/lumiar/occluders.py.
uniform sampler2D rig_nodes;    // two texels a node: (low corner, link), (high corner, triangles)
uniform sampler2D rig_corners;  // three texels a triangle: its corners, with its unit normal behind

const float RIG_ROUND = 6e-8;   // 2^-24, half the step of a float32 next to 1
const float RIG_LEAST = 1e-18;  // of a direction's components: what they divide stays finite

vec4 rig_texel(sampler2D texels, int i) {
    return texelFetch(texels, ivec2(i & 4095, i >> 12), 0);
}

float rig_largest(vec3 v) {
    return max(abs(v.x), max(abs(v.y), abs(v.z)));
}

// One over x, finite.
float rig_inverse(float x) {
    return 1.0 / (abs(x) > RIG_LEAST ? x : x < 0.0 ? -RIG_LEAST : RIG_LEAST);
}

// Whether the ray passes the box; it may say so of a near miss, never the other way round
// (T. Ize, "Robust BVH ray traversal", 2013).
bool rig_enters(vec3 low, vec3 high, vec3 origin, vec3 inverse, float far) {
    vec3 a = (low - origin) * inverse, b = (high - origin) * inverse;
    vec3 near = min(a, b), away = max(a, b);
    float first = max(max(near.x, near.y), max(near.z, 0.0));
    float last = min(min(away.x, away.y), min(away.z, far));
    return first <= last * (1.0 + 16.0 * RIG_ROUND);
}

// Whether the triangle cuts the ray: seen along it the origin lies within (the edge functions of
// S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", 2013), up to what rounding
// may have moved, so that no ray slips between neighbours. Planes in which the origin or the end
// lies, up to rounding again, are those of the surface and of the lamp: they cut nothing.
bool rig_cuts(int triangle, vec3 origin, vec3 x, vec3 y, vec3 direction, float far) {
    vec4 p = rig_texel(rig_corners, 3 * triangle);
    vec4 q = rig_texel(rig_corners, 3 * triangle + 1);
    vec4 r = rig_texel(rig_corners, 3 * triangle + 2);
    vec3 a = p.xyz - origin, b = q.xyz - origin, c = r.xyz - origin, normal = vec3(p.w, q.w, r.w);
    vec3 u = vec3(dot(a, x), dot(b, x), dot(c, x)), v = vec3(dot(a, y), dot(b, y), dot(c, y));
    vec3 edges = u.yzx * v.zxy - u.zxy * v.yzx;
    float size = max(rig_largest(a), max(rig_largest(b), rig_largest(c)));
    float slack = 32.0 * RIG_ROUND * size * max(rig_largest(u), rig_largest(v));
    float least = min(edges.x, min(edges.y, edges.z)), most = max(edges.x, max(edges.y, edges.z));
    float slope = dot(normal, direction), height = dot(normal, a) * sign(slope);
    float blur = 8.0 * RIG_ROUND * (size + rig_largest(origin));
    return (least >= -slack || most <= slack) && height > blur && height + blur < far * abs(slope);
}

// A ray on its way through the nodes, which lie depth first: what is missed is skipped.
struct rig_Walk {
    int node, end;       // the next node; where they end
    int triangle, stop;  // the next of a leaf's triangles; where they end
};

// Takes one more node, unless triangles wait.
void rig_step(inout rig_Walk walk, vec3 origin, vec3 inverse, float far) {
    if (walk.node >= walk.end || walk.triangle < walk.stop) return;
    vec4 low = rig_texel(rig_nodes, 2 * walk.node), high = rig_texel(rig_nodes, 2 * walk.node + 1);
    bool entered = rig_enters(low.xyz, high.xyz, origin, inverse, far), leaf = high.w > 0.0;
    walk.node = entered || leaf ? walk.node + 1 : int(low.w);
    if (entered && leaf) {
        walk.triangle = int(low.w);
        walk.stop = walk.triangle + int(high.w);
    }
}

// Whether a triangle cuts the ray from origin in a unit direction before it has gone as far. Four
// nodes for each triangle keep rays side by side in step, and loops short (see rigs/loops.glsl).
bool rig_hidden(vec3 origin, vec3 direction, float far) {
    vec3 inverse = vec3(rig_inverse(direction.x), rig_inverse(direction.y), rig_inverse(direction.z));
    bool level = abs(direction.x) > abs(direction.z);
    vec3 x = level ? vec3(-direction.y, direction.x, 0.0) : vec3(0.0, -direction.z, direction.y);
    x = normalize(x);
    vec3 y = cross(direction, x);
    rig_Walk walk = rig_Walk(0, int(rig_texel(rig_nodes, 0).w), 0, 0);
    while (walk.node < walk.end || walk.triangle < walk.stop) {
        rig_step(walk, origin, inverse, far);
        rig_step(walk, origin, inverse, far);
        rig_step(walk, origin, inverse, far);
        rig_step(walk, origin, inverse, far);
        if (walk.triangle < walk.stop) {
            if (rig_cuts(walk.triangle, origin, x, y, direction, far)) return true;
            ++walk.triangle;
        }
    }
    return false;
}

// Where a shadow ray leaves a face: off its plane by more than the error of an interpolated position,
// which is large where a small triangle is seen edge-on (as C. Wächter and N. Binder, Ray Tracing
// Gems, 2019, ch. 6, but in proportion to the scene). ground is the face's normal on the ray's side.
vec3 rig_lifted(vec3 position, vec3 ground, vec3 direction) {
    vec3 low = rig_texel(rig_nodes, 0).xyz, high = rig_texel(rig_nodes, 1).xyz;
    float scene = max(rig_largest(low), rig_largest(high));
    return position + ground * (256.0 * RIG_ROUND * max(rig_largest(position), scene / 64.0));
}

// How far above a point of a face the surface lies that interpolated normals speak of. A ray from
// there, on the side of the normals, meets no facets where a smooth surface has none: the terminator
// follows the normals instead of the mesh (J. Hanika, "Hacking the shadow terminator", Ray Tracing
// Gems II, 2021, ch. 4: the point is projected on the tangent planes of the three corners and these
// are blended). square, mixed and rise are interpolated from rig_normal * rig_normal, the products
// of two of its components, and rig_normal * dot(rig_normal, rig_position) at the corners.
vec3 rig_bulge(vec3 position, vec3 square, vec3 mixed, vec3 rise, vec3 ground) {
    vec3 below = square * position + mixed.zxy * position.yzx + mixed.yzx * position.zxy;
    vec3 bulge = rise - below;
    return dot(bulge, ground) > 0.0 ? bulge : vec3(0.0);
}
