// exact.glsl - signs of expressions that need 64-bit integers, and 64-bit keys.

// a * b < c * d ? -1 : a * b > c * d ? 1 : 0
int compare_products(int a, int b, int c, int d)
{
    int p, q;
    int pl, ql;
    imulExtended(a, b, p, pl);
    imulExtended(c, d, q, ql);
    if (p != q)
        return p < q ? -1 : 1;
    return uint(pl) < uint(ql) ? -1 : pl == ql ? 0 : 1;
}

uvec2 key_add(uvec2 a, uvec2 b)
{
    uint carry;
    uint low = uaddCarry(a.x, b.x, carry);
    return uvec2(low, a.y + b.y + carry);
}

uvec2 key_negative(uvec2 a)
{
    return key_add(~a, uvec2(1, 0));
}

// Numbers in the order of the floats.
uint ordered(float f)
{
    uint bits = floatBitsToUint(f);
    return bits ^ ((bits >> 31) != 0 ? 0xffffffffu : 0x80000000u);
}
