#include "lib/angle.glsl"
#include "lib/constants.glsl"

const float LOST = 0.28779340921;       // 1/2 - 2 / (3 pi)
const float LOST_MEAN = 0.21530519675;  // the same less 2/3 - 28 / (15 pi)

// (1 - E(mu)) / (r / (1 + LOST r)) of one bounce on the rough diffuse surface of J. Portsmouth, P. Kutz and
// S. Hill, "EON", JCGT 14(1), 2025, eq. 12, without a quotient by mu.
float lost_share(vec3 w) {
    float S = length(w.xy), mu = w.z;
    float curve = S * (angle_of(S, mu) - S * mu);
    float rest = S * mu * (1.0 + S * (1.0 + S)) / (1.0 + S) - S;
    return max(LOST - INV_PI * (curve + 2.0 / 3.0 * rest), 0.0);
}
