"""The GL renderer's shader programs. Colours are linear inside and (nearly) sRGB in the picture.

The programs are optimised for software rendering, in which every varying and every texel costs time, `if`
saves nothing, and triangles cost more than pixels. So lighting is computed for each vertex, and fragment
shaders only mix colours.
"""

from __future__ import annotations

from typing import Final

HORIZON: Final = "vec3(0.62, 0.71, 0.80)"

_PLACE: Final = """
uniform sampler2D matrices;

mat4x3 placing(float row) {
    int at = int(row);
    return transpose(mat3x4(texelFetch(matrices, ivec2(0, at), 0), texelFetch(matrices, ivec2(1, at), 0),
                            texelFetch(matrices, ivec2(2, at), 0)));
}
"""

_LIGHT: Final = """
uniform vec3 sun_direction;
uniform vec3 sun_color;
uniform mat4 light;

vec3 sky_light(vec3 normal) {
    return mix(vec3(0.30, 0.29, 0.28), vec3(0.52, 0.55, 0.60), normal.z * 0.5 + 0.5);
}

vec3 sun_light(vec3 normal) { return max(dot(normal, -sun_direction), 0.0) * sun_color; }

vec3 in_light(vec3 place, vec3 normal) {
    return (light * vec4(place + normal * 0.02, 1.0)).xyz;
}
"""

_FINISH: Final = f"""
uniform sampler2DShadow shadow_map;

float lit(vec3 uvd) {{
#ifdef GATHER
    // The four texels round the place in one go: for a CPU the ready-made filter is four times as much work.
    vec4 near = textureGather(shadow_map, uvd.xy, uvd.z - 0.0006);
    vec2 at = fract(uvd.xy * SHADOW_SIZE - 0.5);
    vec2 columns = mix(near.wx, near.zy, at.x);
    return mix(columns.x, columns.y, at.y);
#else
    return texture(shadow_map, vec3(uvd.xy, uvd.z - 0.0006));
#endif
}}

vec4 finish(vec3 color) {{
    // 1 / gl_FragCoord.w is how far ahead it is. A gamma of 2 for 2.2: powers are what a CPU is slow at.
    float haze = clamp((1.0 / gl_FragCoord.w - 18.0) / 40.0, 0.0, 1.0);
    return vec4(sqrt(mix(color, {HORIZON}, haze)), 1.0);
}}
"""

SHADOW_VERTEX: Final = f"""
{_PLACE}
uniform mat4 light;
in vec3 in_position;
in float in_row;
void main() {{
    vec3 place = placing(in_row) * vec4(in_position, 1.0);
    gl_Position = vec4((light * vec4(place, 1.0)).xyz * 2.0 - 1.0, 1.0);
}}
"""

SHADOW_FRAGMENT: Final = """
void main() {}
"""

OBJECT_VERTEX: Final = f"""
{_PLACE}
{_LIGHT}
uniform mat4 view_projection;
in vec3 in_position;
in vec3 in_normal;
in vec4 in_color;
in float in_row;
out vec3 dark;
out vec3 bright;
out vec3 uvd;
void main() {{
    mat4x3 placed = placing(in_row);
    vec3 place = placed * vec4(in_position, 1.0);
    vec3 normal = mat3(placed) * in_normal;
    vec3 color = in_color.rgb * in_color.rgb;
    dark = color * sky_light(normal);
    bright = dark + color * sun_light(normal);
    uvd = in_light(place, normal);
    gl_Position = view_projection * vec4(place, 1.0);
}}
"""

OBJECT_FRAGMENT: Final = f"""
{_FINISH}
in vec3 dark;
in vec3 bright;
in vec3 uvd;
out vec4 picture;
void main() {{ picture = finish(mix(dark, bright, lit(uvd))); }}
"""

# The same with a texture, sampled for each fragment, and squared as colours are.
TEXTURED_VERTEX: Final = OBJECT_VERTEX.replace(
    "out vec3 dark;", "in vec3 in_uv;\nout vec3 uv;\nout vec3 dark;"
).replace("gl_Position =", "uv = in_uv;\n    gl_Position =")

TEXTURED_FRAGMENT: Final = f"""
{_FINISH}
uniform sampler2DArray pictures;
in vec3 uv;
in vec3 dark;
in vec3 bright;
in vec3 uvd;
out vec4 picture;
void main() {{
    vec3 paint = texture(pictures, uv).rgb;
    picture = finish(mix(dark, bright, lit(uvd)) * paint * paint);
}}
"""

GROUND_VERTEX: Final = f"""
{_LIGHT}
uniform mat4 view_projection;
uniform vec3 eye;
in vec3 in_position;
out vec2 place;
out vec3 uvd;
void main() {{
    vec3 at = vec3(eye.xy + in_position.xy * 240.0, 0.0);
    place = at.xy;
    uvd = in_light(at, vec3(0.0, 0.0, 1.0));
    gl_Position = view_projection * vec4(at, 1.0);
}}
"""

GROUND_FRAGMENT: Final = f"""
{_FINISH}
uniform vec3 dark;
uniform vec3 bright;
in vec2 place;
in vec3 uvd;
out vec4 picture;

float line(vec2 at, float width) {{
    vec2 wide = fwidth(at) + width;
    vec2 away = abs(fract(at - 0.5) - 0.5);
    vec2 on = clamp(1.5 - away / wide, 0.0, 1.0) * clamp(0.35 / wide, 0.0, 1.0);
    return max(on.x, on.y);
}}

void main() {{ picture = finish(mix(dark, bright, lit(uvd)) * (1.0 - 0.16 * line(place, 0.012))); }}
"""

TEXTURED_GROUND_FRAGMENT: Final = f"""
{_FINISH}
uniform sampler2DArray pictures;
uniform vec2 tile;
uniform float layer;
uniform vec3 dark;
uniform vec3 bright;
in vec2 place;
in vec3 uvd;
out vec4 picture;
void main() {{
    vec3 paint = texture(pictures, vec3(place / tile, layer)).rgb;
    picture = finish(mix(dark, bright, lit(uvd)) * paint * paint);
}}
"""

SKY_VERTEX: Final = f"""
uniform mat4 to_world;
in vec3 in_position;
out vec3 color;
void main() {{
    vec2 at = in_position.xy * 2.0;
    vec4 far = to_world * vec4(at, 1.0, 1.0);
    float up = clamp(normalize(far.xyz / far.w).z, 0.0, 1.0);
    color = sqrt(mix({HORIZON}, vec3(0.27, 0.45, 0.70), sqrt(up)));
    gl_Position = vec4(at, 1.0, 1.0);
}}
"""

SKY_FRAGMENT: Final = """
in vec3 color;
out vec4 picture;
void main() { picture = vec4(color, 1.0); }
"""

# For depth and segmentation: depth in m, and the row of the object.
MEASURE_VERTEX: Final = f"""
{_PLACE}
uniform mat4 view_projection;
in vec3 in_position;
in float in_row;
flat out float row;
void main() {{
    row = in_row;
    gl_Position = view_projection * vec4(placing(in_row) * vec4(in_position, 1.0), 1.0);
}}
"""

MEASURE_GROUND_VERTEX: Final = """
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
flat in float row;
out vec2 measured;
void main() { measured = vec2(1.0 / gl_FragCoord.w, row); }
"""
