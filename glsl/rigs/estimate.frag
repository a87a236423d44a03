// What pieces of a surface reflect of one light, a piece a pixel: exact, or a sum over directions
// drawn in one of several ways from points of one of several kinds.
#include "LIGHTS"
#include "lib/frame_normal.glsl"
#include "lib/sampling.glsl"
#include "rigs/spread.glsl"
#include "MODEL"

uniform sampler2D rig_places;   // where each piece is, in the world
uniform sampler2D rig_normals;  // and its normal
uniform vec3 rig_eye;
uniform int rig_samples;
uniform int rig_repeats;        // how many pieces one pixel does, to be timed

out vec4 rig_out;

Incident rig_light(vec3 place, vec2 u) {
    return light(place, u);  // each light
}

vec3 rig_arriving(vec3 place, vec3 way) {
    return arriving(place, way);  // each arriving
}

float rig_density(vec3 place, vec3 way) {
    return density(place, way);  // each density
}

vec3 rig_irradiance(vec3 place, vec3 normal) {
    return irradiance(place, normal);  // each irradiance
}

float rig_share(float own, float other) {
    return own / max(own + other, 1e-30);  // the balance heuristic, as in shade.glsl
}

float rig_chance(uint key) {
    return float(rig_hash(rig_seed ^ rig_hash(key)) >> 8) * 5.9604645e-8;  // 2^-24
}

// Point i of rig_samples in the unit square.
vec2 rig_point(int i, uint stream) {
    vec2 u = vec2(rig_chance(4u * uint(i) + 2u * stream), rig_chance(4u * uint(i) + 2u * stream + 1u));  // where not spread
    int side = int(sqrt(float(rig_samples)) + 0.5);                        // where stratified
    u = (vec2(i % side, i / side) + u) / float(side);                      // where stratified
    vec2 u = rig_spread(i, stream);  // where spread
    return u;
}

vec3 rig_estimate(vec3 place, Frame frame, vec3 V) {
    return rig_irradiance(place, frame.N) * scatter(vec3(0.0, 0.0, 1.0), V);  // where exact
    vec3 sum = vec3(0.0), L = vec3(0.0), way, share;
    for (int i = 0; i < rig_samples; ++i) {
        vec2 u = rig_point(i, 0u);
        Incident incident = rig_light(place, u);               // where aimed
        L = to_local(incident.direction, frame);               // where aimed
        share = incident.irradiance * scatter(L, V);           // where aimed
        share *= rig_share(rig_density(place, incident.direction), scatter_pdf(L, V));  // where both
        sum += share;                                          // where aimed
        u = rig_point(i, 1u);                                  // where both
        L = vec3(0.0, 0.0, 1.0 - u.x);                         // where even
        L.xy = sqrt(u.x * (2.0 - u.x)) * vec2(cos(2.0 * PI * u.y), sin(2.0 * PI * u.y));  // where even
        share = 2.0 * PI * scatter(L, V);                      // where even
        L = cosine_direction(u);                               // where cosine
        share = weighed(scatter(L, V), cosine_density(L));     // where cosine
        share = sample_scatter(V, u, L);                       // where drawn
        way = from_local(L, frame);                            // where met
        share *= rig_arriving(place, way);                     // where met
        share *= rig_share(scatter_pdf(L, V), rig_density(place, way));  // where both
        sum += share;                                          // where met
    }
    return sum / float(rig_samples);
}

void main() {
    ivec2 size = textureSize(rig_places, 0), pixel = ivec2(gl_FragCoord.xy);
    vec3 total = vec3(0.0);
    for (int i = 0; i < rig_repeats; ++i) {
        ivec2 at = (pixel + i) % size;
        vec3 place = texelFetch(rig_places, at, 0).xyz;
        Frame frame = Frame(texelFetch(rig_normals, at, 0).xyz);
        rig_seed = rig_hash(uint(at.x) + 65536u * uint(at.y));
        total += rig_estimate(place, frame, to_local(normalize(rig_eye - place), frame));
    }
    rig_out = vec4(total / float(rig_repeats), 1.0);
}
