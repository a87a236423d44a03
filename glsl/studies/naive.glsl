// model   The models of the lecture, typed as the slides print them
// paper   B. T. Phong, 1975; J. F. Blinn, 1977; G. Ward, 1992, eq. 5b; R. Cook and K. Torrance, 1982;
//         B. Walter et al., 2007 (ggx); M. Oren and S. Nayar, 1994
// claims
// note    what `lumiar bench` holds the forms of Lumiar against: pow, exp and acos of rounded cosines
#include "lib/constants.glsl"

uniform vec3 kd = vec3(0.1);                // color: diffuse share (unitless)
uniform vec3 ks = vec3(0.5);                // color: specular share (unitless)
uniform float shininess = 40.0;             // [1, 1000 ..] log: exponent of phong and blinn (unitless)
uniform float alpha_x = 0.1;                // [0.001, 1] log: roughness along the tangent (unitless)
uniform float alpha_y = 0.3;                // [0.001, 1] log: roughness across it, of ward (unitless)
uniform float f0 = 0.04;                    // [0, 1]: Schlick's reflectance at normal incidence
uniform vec3 albedo = vec3(0.8);            // color: rho of oren_nayar (unitless)
uniform float sigma = radians(30.0);        // [0, 90] degrees: sigma of oren_nayar
uniform int law = 0;                        // {phong, blinn, ward, beckmann, ggx, oren_nayar}
uniform bool guarded = true;                // toggle: nothing from below, and no negative base of pow

float power(float c) {
    return pow(guarded ? max(c, 0.0) : c, shininess);
}

// D G F / (4 N.L N.V) N.L with V-shaped grooves, as on the slides.
float facets(vec3 L, vec3 V, vec3 H) {
    float c = H.z, c2 = c * c, m2 = alpha_x * alpha_x, VdotH = dot(V, H);
    float D = exp((c2 - 1.0) / (m2 * c2)) / (PI * m2 * c2 * c2);
    if (law == LAW_GGX) D = m2 / (PI * (c2 * (m2 - 1.0) + 1.0) * (c2 * (m2 - 1.0) + 1.0));
    float G = min(1.0, min(2.0 * c * V.z / VdotH, 2.0 * c * L.z / VdotH));
    float x = 1.0 - dot(L, H), F = f0 + (1.0 - f0) * pow(guarded ? max(x, 0.0) : x, 5.0);
    return F * D * G / (4.0 * V.z);
}

float rough_diffuse(vec3 L, vec3 V) {
    float theta_i = acos(L.z), theta_r = acos(V.z), s2 = sigma * sigma;
    float A = 1.0 - 0.5 * s2 / (s2 + 0.33), B = 0.45 * s2 / (s2 + 0.09);
    float turn = dot(normalize(L.xy), normalize(V.xy));  // cos(phi_r - phi_i)
    float alpha = max(theta_i, theta_r), beta = min(theta_i, theta_r);
    return L.z * (A + B * max(0.0, turn) * sin(alpha) * tan(beta));
}

vec3 scatter(vec3 L, vec3 V) {
    if (guarded && (L.z <= 0.0 || V.z <= 0.0)) return vec3(0.0);
    vec3 H = normalize(L + V);
    if (law == LAW_PHONG) return INV_PI * (kd * L.z + ks * power(dot(vec3(-L.xy, L.z), V)));
    if (law == LAW_BLINN) return INV_PI * (kd * L.z + ks * power(H.z));
    if (law == LAW_OREN_NAYAR) return albedo * (INV_PI * rough_diffuse(L, V));
    if (law == LAW_WARD) {
        vec2 slope = H.xy / vec2(alpha_x, alpha_y);
        float lobe = exp(-2.0 * dot(slope, slope) / (1.0 + H.z)) * sqrt(L.z / V.z) / (4.0 * PI * alpha_x * alpha_y);
        return INV_PI * L.z * kd + ks * lobe;
    }
    return INV_PI * L.z * kd + vec3(facets(L, V, H));
}
