// What one light adds if it has an extent or casts shadows. compose.py makes a copy of this file for
// each such light, with the light's own functions, and keeps the lines that this light needs.
uniform int samples;  // where summed

// What a light without an extent sends, and how far a shadow ray toward it goes.
Incident rig_aimed(vec3 position, out float far) {  // where not extended
    Incident incident = light(position, vec2(0.5));  // where not extended
    far = 1e30;  // where not extended and not near
    far = reach(position, incident.direction);  // where not extended and near
    return incident;  // where not extended
}  // where not extended

vec3 rig_lit(vec3 position, Frame frame, vec3 V) {  // where extended
    vec3 N = vec3(0.0, 0.0, 1.0);  // where exact
    vec3 whole = irradiance(position, from_local(N, frame)) * scatter(N, V);  // where exact
    return whole;  // where exact and not hidden
    vec3 sum = vec3(0.0);  // where summed
    vec3 unhidden = vec3(1e-30);  // where summed and exact
    int first = (samples * rig_pass.x) / rig_pass.y, last = (samples * (rig_pass.x + 1)) / rig_pass.y;  // where summed
    for (int i = first; i < last; ++i) {  // where summed
        Incident incident = light(position, rig_spread(i, 2u * RIG_NUMBERu));  // where summed
        vec3 share = rig_reflected(incident, frame, V);  // where summed
        unhidden += share;  // where summed and exact
        vec3 L = to_local(incident.direction, frame);  // where balanced
        share *= rig_balance(density(position, incident.direction), scatter_pdf(L, V));  // where balanced
        bool lost = share == vec3(0.0);  // where summed and hidden
        float far = reach(position, incident.direction);  // where summed and hidden and near
        float far = 1e30;  // where summed and hidden and not near
        if (lost || rig_blocked(position, incident.direction, far)) share = vec3(0.0);  // where summed and hidden
        sum += share;  // where summed
        share = sample_scatter(V, rig_spread(i, 2u * RIG_NUMBERu + 1u), L);  // where balanced
        vec3 way = from_local(L, frame);  // where balanced
        share *= arriving(position, way) * rig_balance(scatter_pdf(L, V), density(position, way));  // where balanced
        lost = share == vec3(0.0);  // where balanced and hidden
        far = reach(position, way);  // where balanced and hidden and near
        if (lost || rig_blocked(position, way, far)) share = vec3(0.0);  // where balanced and hidden
        sum += share;  // where balanced
    }  // where summed
    // Where no direction came out above the horizon nothing tells what is hidden: then nothing is.
    sum = whole * (unhidden == vec3(1e-30) ? vec3(1.0) : sum / unhidden);  // where summed and exact
    sum *= float(last - first);  // where summed and exact
    return sum * (float(rig_pass.y) / float(samples));  // where summed
}  // where extended
