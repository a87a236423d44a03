// Points spread evenly over the unit square: the (0,2)-sequence of I. Sobol, 1967, its bits scrambled
// anew at every pixel by nested uniform permutations (A. Owen, 1995; hashed as by S. Laine and T. Karras,
// EGSR 2011, and B. Burley, JCGT 9(4), 2020). N of them integrate smooth functions with an error of
// about N^-1.5 where independent ones have N^-0.5.
uniform ivec2 rig_pass;   // which of how many passes the samples are spread over
uniform ivec2 rig_shift;  // of this strip in the picture
uint rig_seed;            // of the point being shaded

// A hash of 32 bits, C. Wellons' lowbias32.
uint rig_hash(uint x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

uint rig_mirrored(uint x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// A permutation in which each bit depends on those below it only.
uint rig_nested(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

// i: which point; stream: one of independent sequences
vec2 rig_spread(int i, uint stream) {
    uint seed = rig_hash(rig_seed + 0x9e3779b9u * stream);
    uint x = rig_mirrored(rig_nested(rig_mirrored(uint(i)), seed)), y = x;  // in shuffled order
    // Sobol's second generator matrix is Pascal's triangle modulo 2, here halves, quarters ... added up.
    y ^= (y & 0xffff0000u) >> 16;
    y ^= (y & 0xff00ff00u) >> 8;
    y ^= (y & 0xf0f0f0f0u) >> 4;
    y ^= (y & 0xccccccccu) >> 2;
    y ^= (y & 0xaaaaaaaau) >> 1;
    x = rig_mirrored(rig_nested(x, rig_hash(seed ^ 0x68bc21ebu)));
    y = rig_mirrored(rig_nested(y, rig_hash(seed ^ 0x02e5be93u)));
    return vec2(x >> 8, y >> 8) * 5.9604645e-8;  // 2^-24
}
