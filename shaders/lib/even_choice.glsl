// Choosing `kept` of n things so that what is left out is spread evenly: thing k is kept where floor((k + 1) kept / n) is
// larger than floor(k kept / n), which is then its place among the kept.
#ifndef IRRADIA_LIB_EVEN_CHOICE_GLSL
#define IRRADIA_LIB_EVEN_CHOICE_GLSL

// floor(k kept / n) for k <= n, kept <= n and 0 < n < 2^31: a product of 64 bits, divided bit by bit.
uint evenPlace(uint k, uint kept, uint n) {
    uint rest, quotient;
    umulExtended(k, kept, rest, quotient);
    for (uint bit = 0u; bit < 32u; ++bit) {
        rest = rest << 1u | quotient >> 31u;
        quotient <<= 1u;
        if (rest >= n) {
            rest -= n;
            quotient |= 1u;
        }
    }
    return quotient;
}

bool isEvenlyKept(uint k, uint kept, uint n) {
    return evenPlace(k + 1u, kept, n) > evenPlace(k, kept, n);
}

#endif
