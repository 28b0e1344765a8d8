"""The GL renderer's shader programs. Colours are linear inside and (nearly) sRGB in the picture."""

from __future__ import annotations

from typing import Final

SHADOW_VERTEX: Final = """
#version 330
uniform mat4 light;
in vec3 in_position;
in mat4 in_model;
void main() { gl_Position = light * (in_model * vec4(in_position, 1.0)); }
"""

SHADOW_FRAGMENT: Final = """
#version 330
void main() {}
"""

_LIGHTING: Final = """
uniform vec3 sun_direction;
uniform vec3 sun_color;
uniform mat4 light;
uniform sampler2DShadow shadow_map;

float lit(vec3 place, vec3 normal) {
    vec4 at = light * vec4(place + normal * 0.015, 1.0);
    vec3 uvd = at.xyz * 0.5 + 0.5;
    if (any(lessThan(uvd, vec3(0.0))) || any(greaterThan(uvd, vec3(1.0)))) return 1.0;
    return texture(shadow_map, vec3(uvd.xy, uvd.z - 0.0012));
}

vec3 shade(vec3 color, vec3 place, vec3 normal) {
    float facing = max(dot(normal, -sun_direction), 0.0);
    float sun = facing > 0.0 ? facing * lit(place, normal) : 0.0;
    vec3 sky = mix(vec3(0.30, 0.29, 0.28), vec3(0.52, 0.55, 0.60), normal.z * 0.5 + 0.5);
    return color * (sky + sun * sun_color);
}

vec3 finish(vec3 color) {
    // 1 / gl_FragCoord.w is how far ahead it is. A gamma of 2 for 2.2: powers are what a CPU is slow at.
    float haze = clamp((1.0 / gl_FragCoord.w - 18.0) / 40.0, 0.0, 1.0);
    return sqrt(mix(color, vec3(0.62, 0.71, 0.80), haze));
}
"""

OBJECT_VERTEX: Final = """
#version 330
uniform mat4 view_projection;
in vec3 in_position;
in vec3 in_normal;
in mat4 in_model;
in vec4 in_color;
out vec3 place;
out vec3 normal;
out vec3 color;
void main() {
    vec4 world = in_model * vec4(in_position, 1.0);
    mat3 turn = mat3(in_model);
    vec3 squares = vec3(dot(turn[0], turn[0]), dot(turn[1], turn[1]), dot(turn[2], turn[2]));
    place = world.xyz;
    normal = turn * (in_normal / squares);
    color = in_color.rgb;
    gl_Position = view_projection * world;
}
"""

OBJECT_FRAGMENT: Final = f"""
#version 330
{_LIGHTING}
in vec3 place;
in vec3 normal;
in vec3 color;
out vec4 picture;
void main() {{
    vec3 n = normalize(normal);
    vec3 shaded = shade(color, place, n);
    picture = vec4(finish(shaded), 1.0);
}}
"""

GROUND_VERTEX: Final = """
#version 330
uniform mat4 view_projection;
uniform vec3 eye;
in vec3 in_position;
out vec3 place;
void main() {
    place = vec3(eye.xy + in_position.xy * 240.0, 0.0);
    gl_Position = view_projection * vec4(place, 1.0);
}
"""

GROUND_FRAGMENT: Final = f"""
#version 330
{_LIGHTING}
uniform vec3 ground_color;
in vec3 place;
out vec4 picture;
float line(vec2 at, float width) {{
    vec2 wide = fwidth(at) + width;
    vec2 away = abs(fract(at - 0.5) - 0.5);
    vec2 on = clamp(1.5 - away / wide, 0.0, 1.0);
    return max(on.x, on.y) * clamp(0.35 / max(wide.x, wide.y), 0.0, 1.0);
}}
void main() {{
    float tiles = line(place.xy, 0.012);
    vec3 color = ground_color * (1.0 - 0.16 * tiles);
    picture = vec4(finish(shade(color, place, vec3(0.0, 0.0, 1.0))), 1.0);
}}
"""

SKY_VERTEX: Final = """
#version 330
uniform mat4 to_world;
in vec3 in_position;
out vec3 color;
void main() {
    vec2 at = in_position.xy * 2.0;
    vec4 far = to_world * vec4(at, 1.0, 1.0);
    float up = clamp(normalize(far.xyz / far.w).z, 0.0, 1.0);
    color = sqrt(mix(vec3(0.62, 0.71, 0.80), vec3(0.27, 0.45, 0.70), sqrt(up)));
    gl_Position = vec4(at, 1.0, 1.0);
}
"""

SKY_FRAGMENT: Final = """
#version 330
in vec3 color;
out vec4 picture;
void main() { picture = vec4(color, 1.0); }
"""

# What a depth camera and a labelled picture see: metres ahead, and the row of the object.
MEASURE_VERTEX: Final = """
#version 330
uniform mat4 view_projection;
in vec3 in_position;
in mat4 in_model;
in float in_row;
flat out float row;
void main() {
    row = in_row;
    gl_Position = view_projection * (in_model * vec4(in_position, 1.0));
}
"""

MEASURE_GROUND_VERTEX: Final = """
#version 330
uniform mat4 view_projection;
uniform vec3 eye;
uniform float ground;
in vec3 in_position;
flat out float row;
void main() {
    row = ground;
    gl_Position = view_projection * vec4(eye.xy + in_position.xy * 240.0, 0.0, 1.0);
}
"""

MEASURE_FRAGMENT: Final = """
#version 330
flat in float row;
out vec2 measured;
void main() { measured = vec2(1.0 / gl_FragCoord.w, row); }
"""
