// Form factor and solid angle of a polygon from a patch at the origin, by what its light is made of.
#include "lib/constants.glsl"
#include "lib/polygon.glsl"

uniform vec3 rig_normal;     // of the patch
uniform vec3 rig_front;      // of the polygon, toward the patch
uniform float rig_height;    // of the patch in front of it
uniform vec3 rig_origin;     // its first corner
uniform vec3 rig_corner[6];  // all of them from there
uniform int rig_corners;

out vec4 rig_out;

void main() {
    Polygon g = Polygon(rig_origin, rig_front, rig_height, rig_corner[0], rig_corner[1], rig_corner[2],
                        rig_corner[3], rig_corner[4], rig_corner[5]);
    float F = polygon_irradiance(g, rig_corners, rig_normal) / PI;
    rig_out = vec4(F, polygon_solid_angle(g, rig_corners), 0.0, 1.0);
}
