// The state as specialisation constants: of every draw's pipeline, the same ids in all stages.

#ifndef AFTERGLOW_FIXED_SPECIALIZED_GLSL
#define AFTERGLOW_FIXED_SPECIALIZED_GLSL

#include "state.glsl"

#define TOPOLOGY_POINTS 0u
#define TOPOLOGY_LINES 1u
#define TOPOLOGY_TRIANGLES 2u

layout(constant_id = 0) const uint GLOBAL_0 = 0u;
layout(constant_id = 1) const uint GLOBAL_1 = 0u;
layout(constant_id = 2) const uint UNIT_0_0 = 0u;
layout(constant_id = 3) const uint UNIT_0_1 = 0u;
layout(constant_id = 4) const uint UNIT_0_2 = 0u;
layout(constant_id = 5) const uint UNIT_1_0 = 0u;
layout(constant_id = 6) const uint UNIT_1_1 = 0u;
layout(constant_id = 7) const uint UNIT_1_2 = 0u;
layout(constant_id = 8) const uint UNIT_2_0 = 0u;
layout(constant_id = 9) const uint UNIT_2_1 = 0u;
layout(constant_id = 10) const uint UNIT_2_2 = 0u;
layout(constant_id = 11) const uint UNIT_3_0 = 0u;
layout(constant_id = 12) const uint UNIT_3_1 = 0u;
layout(constant_id = 13) const uint UNIT_3_2 = 0u;
// The draw's VertexLayout.
layout(constant_id = 14) const uint VERTEX_LAYOUT = 0u;
// A TOPOLOGY_ constant.
layout(constant_id = 15) const uint TOPOLOGY = TOPOLOGY_TRIANGLES;
// Coordinates that GL_CLAMP wraps: 3 bits a unit.
layout(constant_id = 16) const uint CLAMPS = 0u;

#if STATE_WORDS != 2 || UNIT_WORDS != 3 || TEXTURE_UNITS != 4
#error "the constants above are not those of the state words"
#endif

GlobalState specialized_global() {
    return decode_global(uint[STATE_WORDS](GLOBAL_0, GLOBAL_1));
}

UnitState[TEXTURE_UNITS] specialized_units() {
    UnitState units[TEXTURE_UNITS];
    units[0] = decode_unit(uint[UNIT_WORDS](UNIT_0_0, UNIT_0_1, UNIT_0_2));
    units[1] = decode_unit(uint[UNIT_WORDS](UNIT_1_0, UNIT_1_1, UNIT_1_2));
    units[2] = decode_unit(uint[UNIT_WORDS](UNIT_2_0, UNIT_2_1, UNIT_2_2));
    units[3] = decode_unit(uint[UNIT_WORDS](UNIT_3_0, UNIT_3_1, UNIT_3_2));
    return units;
}

#endif
