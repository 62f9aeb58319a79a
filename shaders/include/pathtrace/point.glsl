// A point of a surface as paths take it: made from what a ray has met.

#ifndef AFTERGLOW_PATHTRACE_POINT_GLSL
#define AFTERGLOW_PATHTRACE_POINT_GLSL

#include "accept.glsl"
#include "lights.glsl"
#include "materials.glsl"
#include "ray_cone.glsl"
#include "said.glsl"
#include "surface.glsl"

struct SurfacePoint {
    vec3 start;     // where rays start, a little off the surface
    vec3 position;  // where lights are asked from: off the surface, one that is seen at a grazing angle would be another
    vec3 normal;    // that light is reflected by
    vec3 geometric; // of the triangle, on the same side as the viewer
    Bsdf bsdf;
    vec3 emission;  // radiance to the viewer that no ray has to be asked for
    uint light;     // the light that it is; NO_LIGHT
    bool is_end;    // it reflects nothing more
};

// A point that gives off light and reflects none.
SurfacePoint shining_point(vec3 emission, uint light) {
    return SurfacePoint(vec3(0.0), vec3(0.0), vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0), diffuse_bsdf(vec3(0.0)), emission, light, true);
}

// A surface of a scene file: flat, of one material, shining from its front.
void plain_surface(DrawReference draw, bool is_front, inout SurfacePoint point) {
    vec3 albedo = mix(draw.it.base_color, vec3(MOST_ALBEDO), greaterThan(draw.it.base_color, vec3(1.0)));
    point.bsdf = draw.it.roughness < 0.0
        ? diffuse_bsdf(albedo) : rough_bsdf(albedo, draw.it.roughness, draw.it.metallic);
    point.emission = is_front ? draw.it.emission : vec3(0.0);
}

// A surface as the program has it. Where baked light is known, that is what is reflected: it has come from everywhere.
void program_surface(ViewRecord view, DrawReference draw, uint draw_index, uint triangle, vec3 weights, float cones,
    inout SurfacePoint point) {
    vec3 baked;
    bool is_baked;
    vec3 color = unlit_color(view, draw_index, triangle, weights, cones, baked, is_baked);
    vec4 lobe = vec4(0.0);
    GlobalState state = global_state(draw);
    if (state.lighting) {
        vec4 followed = state.color_material_faces == 0u ? vec4(0.0) : vertex_color(view, draw, state, triangle, weights);
        MaterialFace material = point_material(view, draw, state, followed);
        point.emission = linear_from_srgb(color * clamp(material.emission.rgb, 0.0, 1.0));
        lobe = highlight_lobe(view, linear_from_srgb(clamp(material.specular.rgb, 0.0, 1.0)), material.shininess);
        color *= clamp(material.diffuse.rgb, 0.0, 1.0);
    }
    color = linear_from_srgb(color);
    if (is_baked) {
        point.emission += color * baked * view.bake_scale;
        point.is_end = true;
    } else if (draw.it.kind != SURFACE_LIT) {
        // Full-bright surfaces among relit ones are lights already, or none.
        point.emission += is_relit(view) && draw.it.kind == SURFACE_BAKED ? vec3(0.0) : color;
        point.is_end = true;
    }
    bool is_said = draw.it.roughness >= 0.0 || draw.it.emission != vec3(0.0);
    float texels = is_said ? cone_texels(cones, map_area(view, draw, triangle)) : 0.0;
    point.emission += said_emission(view, draw, triangle, weights, texels);
    vec3 albedo = min(color, MOST_ALBEDO);
    point.bsdf = Bsdf(albedo, lobe.rgb, alpha_of(lobe.w));
    if (draw.it.roughness >= 0.0) {
        vec2 varied = said_roughness_metallic(draw, map_coordinates(view, draw, triangle, weights), texels);
        point.bsdf = rough_bsdf(albedo, varied.x, varied.y);
    }
}

// What a ray along `direction` has met, of length 1; `cone` is the ray's where it ends.
SurfacePoint surface_point(ViewRecord view, Hit hit, vec3 direction, RayCone cone) {
    uint triangle;
    uint draw_index = member_of(view, hit.instance, hit.primitive, triangle);
    if ((draw_index & MEMBER_OF_LIGHTS) != 0u) {
        uint light = (draw_index & ~MEMBER_OF_LIGHTS) + triangle;
        return shining_point(light_source(view, light).color, light);
    }
    DrawReference draw = surface_draw(view, draw_index);
    vec3 weights = corner_weights(hit.barycentrics);
    vec4 positions[3] = corner_positions(draw, triangle);
    vec3 first = world_position(draw, positions[0]);
    vec3 edge_1 = world_position(draw, positions[1]) - first;
    vec3 edge_2 = world_position(draw, positions[2]) - first;
    vec3 across = cross(edge_1, edge_2);
    vec3 normal = unit_vector(across);
    bool is_towards = dot(normal, direction) <= 0.0;
    // A matrix that mirrors turns corners the other way about, and no front inside.
    bool is_front = is_towards != mirrors(draw.it.object_to_world);
    normal = is_towards ? normal : -normal;
    vec3 position = first + edge_1 * weights.y + edge_2 * weights.z;
    SurfacePoint point = shining_point(vec3(0.0), NO_LIGHT);
    point.position = position;
    point.start = offset_ray(position, normal) + normal * start_distance(draw, positions);
    point.normal = normal;
    point.geometric = normal;
    point.light = draw.it.first_light == NO_LIGHT ? NO_LIGHT : draw.it.first_light + triangle;
    point.is_end = false;
    if (draw.it.base_color.x >= 0.0) {
        plain_surface(draw, is_front, point);
    } else {
        float cones = cones_along(cone, dot(normal, direction), length(across));
        program_surface(view, draw, draw_index, triangle, weights, cones, point);
    }
    return point;
}

#endif
