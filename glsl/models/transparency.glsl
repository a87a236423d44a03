// model   Transparency
// paper   T. Porter and T. Duff, "Compositing digital images", SIGGRAPH 1984: over, on linear values
// claims  positive, reciprocal, conserving, constant
// note    the lecture's approximation: what lies behind shows through, and no ray is bent
#include "lib/sampling.glsl"

uniform vec3 albedo = vec3(0.2, 0.5, 0.8);  // color: rho of the layer (unitless)
uniform float opacity = 0.5;                // [0, 1]: alpha, share of the layer that is there (unitless)

vec3 scatter(vec3 L, vec3 V) {
    if (L.z <= 0.0 || V.z <= 0.0) return vec3(0.0);
    return albedo * (opacity * INV_PI * L.z);
}

float scatter_pdf(vec3 L, vec3 V) {
    return cosine_density(L);
}

vec3 sample_scatter(vec3 V, vec2 u, out vec3 L) {
    L = cosine_direction(u);
    return weighed(scatter(L, V), cosine_density(L));
}

vec3 surround(vec3 V) {
    return albedo * opacity * ambience(vec3(0.0, 0.0, 1.0)) + (1.0 - opacity) * environment(-V);
}
