// Mesa's software renderer leaves all loops of a shader after 65 535 steps together, without a word.
// One more loop, of two or three steps and none a compiler could unroll, tells whether it did.
bool rig_cut_short(float x) {
    int steps = 0, wanted = 2 + int(floatBitsToUint(x) >> 31);
    while (steps < wanted) ++steps;
    return steps < wanted;
}
