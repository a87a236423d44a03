// One light as the eye sees it: what surrounds the scene, or a shape in its place among the objects.
#include "LIGHTS"

uniform vec3 rig_eye;
uniform mat3 rig_rays;   // to the right edge of the picture, to its lower edge, to its middle
uniform vec2 rig_depth;  // a, b: the depth of what is z before the eye is a + b / z

in vec2 rig_at;

out vec4 rig_out;

void main() {
    vec3 ray = rig_rays * vec3(rig_at, 1.0);
    float stretch = length(ray);
    vec3 way = ray / stretch;
    rig_out = vec4(environment(way), 0.0);  // each environment
    rig_out = vec4(arriving(rig_eye, way), 0.0);  // each arriving
    if (rig_out.rgb == vec3(0.0)) discard;  // where shape
    gl_FragDepth = 0.99999994;  // where far
    gl_FragDepth = clamp(rig_depth.x + rig_depth.y * stretch / reach(rig_eye, way), 0.0, 0.99999994);  // each reach
}
