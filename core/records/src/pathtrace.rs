//! What path tracing reads: draws as surfaces that rays meet, lights, and one record of a view's passes.
//!
//! Positions and directions are in the world, relative to the camera, unless a name says otherwise. Radiance is
//! linear RGB in which 1 is what an 8-bit picture shows as white.

use afterglow_layout::{packed_words, shared_struct};

/// State words of a draw: two global ones, three for each of four texture units.
pub const SURFACE_STATE_WORDS: usize = 14;

shared_struct! {
    /// A draw of triangles as a surface: geometry by address, fixed-function state as data.
    pub struct SurfaceDraw {
        /// Address of vertex 0.
        pub vertices: u64,
        /// Address of the first index.
        pub indices: u64,
        /// Where the corners were in the frame before, object space, three f32 an index; 0 where they are as they were.
        pub corners_before: u64,
        /// Object to world, the rows of a 3x4 matrix.
        pub object_to_world: [[f32; 4]; 3],
        /// The same in the frame before, relative to this frame's camera; zeros where it was not there.
        pub object_to_world_before: [[f32; 4]; 3],
        /// Left, bottom, width, height of the viewport in pixels, counted from the window's lower left corner.
        pub viewport: [f32; 4],
        /// `StateWords`.
        pub state: [u32; SURFACE_STATE_WORDS],
        /// A unit's bindless image in the lower 20 bits and its sampler in the upper 12.
        pub textures: [u32; 4],
        /// `VertexLayout`.
        pub vertex_layout: u32,
        /// The greatest index that is a vertex; greater ones are taken for it.
        pub last_vertex: u32,
        pub transform: u32,
        pub material: u32,
        pub environment: u32,
        pub current: u32,
        /// How light is found for it: a `SURFACE_` constant.
        pub kind: u32,
        /// The next draw of the same triangles, blended over this one; its own number at the end of the list.
        pub next_layer: u32,
        /// How this draw is blended over the one before it in the list: see `BlendWord`.
        pub blend: u32,
        /// The instance mask of rays that start here.
        pub ray_mask: u32,
        /// Radiance that the program says it gives off, linear RGB; what its map is multiplied with.
        pub emission: [f32; 3],
        /// Perceptual roughness that the program says; below 0 where it says none.
        pub roughness: f32,
        /// Metallic that it says, with the roughness.
        pub metallic: f32,
        /// Maps that the program names, as `textures` has them, or [`NO_MAP`].
        pub normal_map: u32,
        pub metallic_roughness_map: u32,
        pub emission_map: u32,
        /// What of its colour is baked light that traced light takes the place of: a `BAKE_` constant.
        pub bake: u32,
        /// The light that its first triangle is, the next one's follows; [`NO_LIGHT`] if they are none.
        pub first_light: u32,
        /// Albedo in place of all colours, linear RGB; below 0 if there is none. Such a surface shines from its front only.
        pub base_color: [f32; 3],
        /// How its maps are to be read: see `MapWord`.
        pub maps: u32,
        /// Object-space distance along an axis, at most, from where rays are taken relative to in the mesh that it is part of;
        /// infinite if that is the object's origin.
        pub reach: f32,
        /// What it is part of, told apart from frame to frame: 0 is all that stands still.
        pub object: u32,
    }
}

packed_words! {
    /// How a surface's maps are to be read: all fields are 0 for those that the program names.
    pub struct MapWord: "maps", 1 {
        word 0 {
            /// The texture unit whose coordinates they are read with.
            unit: 2,
            /// 1 if how much is metal is in the normal map's alpha, and not in the blue of `metallic_roughness_map`.
            metal_in_normal: 1,
            /// 1 if roughness is in the emission map's alpha, and not in the green of `metallic_roughness_map`.
            roughness_in_emission: 1,
            /// 1 if the normal map has x and y only.
            normal_of_two: 1,
        }
    }
}

packed_words! {
    /// How a layer is blended over the surface below it.
    pub struct BlendWord: "blend", 1 {
        word 0 {
            /// 0 if it replaces what is below.
            enabled: 1,
            /// `BlendFactor` of the layer's own colour.
            source: 4,
            /// `BlendFactor` of the colour below.
            destination: 4,
            /// `BlendEquation`.
            equation: 3,
        }
    }
}

shared_struct! {
    /// Triangles of one draw within a bottom level: a hit's primitive has the member's number in its upper bits.
    pub struct MeshMember {
        /// Index of the [`SurfaceDraw`].
        pub draw: u32,
        /// The draw's triangle that is the member's first.
        pub first_triangle: u32,
    }
}

shared_struct! {
    /// A light source. Those infinitely far come first in the list.
    pub struct LightSource {
        /// Where it is (of a triangle: its first corner), or the unit vector to it if it is infinitely far.
        pub position: [f32; 3],
        /// Radius of the sphere that shines; of a far light the sine of its angular radius. 0 for triangles.
        pub radius: f32,
        /// Linear RGB: radiance of spheres and triangles; of others what a facing white surface shows, where falloff is 1.
        pub color: [f32; 3],
        /// A `LIGHT_` constant.
        pub kind: u32,
        /// Of OpenGL's lights: constant, linear, quadratic falloff.
        pub attenuation: [f32; 3],
        /// Cosine of the spot's cut-off; -1 when it is no spot.
        pub spot_cos_cutoff: f32,
        /// Unit vector along which a spot shines.
        pub spot_axis: [f32; 3],
        pub spot_exponent: f32,
        /// From a triangle's first corner to its second and third.
        pub edge_1: [f32; 3],
        pub edge_2: [f32; 3],
        /// Turns from the root of the light tree, the first in the lowest bit: 1 is to the second child. [`NO_TRAIL`] if it is
        /// not in the tree.
        pub trail: u32,
        /// Unused.
        pub padding: u32,
    }
}

shared_struct! {
    /// A node of the tree over lights with a place. The first child of an inner node follows it.
    pub struct LightNode {
        /// The box of all its lights.
        pub least: [f32; 3],
        /// Luminance that they bring to a facing white surface one unit away, were there no falloff but by area.
        pub power: f32,
        pub greatest: [f32; 3],
        /// The second child's number; of a leaf the light's, with [`LIGHT_LEAF`].
        pub next: u32,
        /// Axis of the cone that holds the normals of lights that shine to one side.
        pub axis: [f32; 3],
        /// Cosine of the cone's half angle; -1 where lights shine everywhere.
        pub cos_spread: f32,
        /// Falloff, the mean of its lights by power.
        pub attenuation: [f32; 3],
        pub padding: u32,
    }
}

shared_struct! {
    /// All that the passes of one view read, found by its address.
    pub struct ViewRecord {
        /// [`FrameRecord`](crate::FrameRecord).
        pub frame: u64,
        /// [`SurfaceDraw`]s.
        pub draws: u64,
        /// [`MeshMember`]s.
        pub members: u64,
        /// [`LightSource`]s.
        pub lights: u64,
        /// [`LightNode`]s.
        pub light_nodes: u64,
        /// [`TraceCounters`].
        pub counters: u64,
        /// Of each pixel the mean radiance and what its variance follows from ([`RadianceTexel`]); 0 where nobody asks for it.
        pub radiance: u64,
        /// [`ReservoirTexel`]s of this frame and of the one before; 0 where lights are not kept from frame to frame, or were not.
        pub reservoirs: u64,
        pub reservoirs_before: u64,
        /// [`SurfaceTexel`]s of the frame before; 0 where they were not kept.
        pub surfaces_before: u64,
        /// The top level.
        pub world: u64,
        /// [`SurfaceTexel`]s, one a pixel, rows from the top.
        pub surfaces: u64,
        /// [`LightTexel`]s; 0 where light goes through a denoiser.
        pub light: u64,
        /// [`GuideTexel`](crate::GuideTexel)s of this frame and of the one before (0 if that has left none), and [`MotionTexel`](crate::MotionTexel)s.
        pub guides: u64,
        pub guides_before: u64,
        pub motions: u64,
        /// [`ChannelTexel`](crate::ChannelTexel)s: as they were traced, as earlier frames left them, and as composition takes them.
        pub noisy: u64,
        pub history: u64,
        pub denoised: u64,
        /// [`StratumTexel`](crate::StratumTexel)s, and [`GradientTexel`](crate::GradientTexel)s as the history is judged by; 0 for denoisers without.
        pub strata: u64,
        pub gradients: u64,
        /// [`LuminanceTexel`](crate::LuminanceTexel)s: of this frame's light once it is traced, and of the frame's before until then.
        pub luminances: u64,
        /// [`FitRecord`](crate::FitRecord)s, three for each block of texels; 0 for denoisers without.
        pub fits: u64,
        /// Four half floats a pixel: what is shown before edges are smoothed, linear.
        pub composed: u64,
        /// [`ExposureSum`]s, one a workgroup.
        pub sums: u64,
        /// [`MoverSum`]s, one a [`SurfaceDraw`].
        pub movers: u64,
        /// [`Exposure`].
        pub exposure: u64,
        /// What the program draws behind everything, by direction: four f32 a texel, of [`SKY_LEVELS`] levels (see sky.glsl).
        /// 0 where the sky is the same everywhere.
        pub sky_map: u64,
        /// Pixels.
        pub width: u32,
        pub height: u32,
        /// Texels of light, and pixels from one to the next.
        pub light_width: u32,
        pub light_height: u32,
        pub light_step: [f32; 2],
        /// Bindless index of the visibility buffer as a storage image.
        pub visibility: u32,
        /// Bindless index of the colour as a storage image.
        pub color: u32,
        /// Bindless index of the albedo as a storage image.
        pub albedo: u32,
        /// What baked light is multiplied by to be light as sources give it.
        pub bake_scale: f32,
        /// How much of what surfaces then reflect reaches others; below 0 where baked light is not replaced.
        pub bounce: [f32; 3],
        /// Lights infinitely far.
        pub far_count: u32,
        pub light_count: u32,
        /// Surfaces of a path that scatter, at most.
        pub most_surfaces: u32,
        /// Lights that are asked at the first surface, of those with a place.
        pub asked: u32,
        /// Candidates of which one light is kept.
        pub candidates: u32,
        /// Combination of `TRACE_` constants.
        pub traits: u32,
        /// Radiance that one sample brings at most, where it is limited.
        pub most_radiance: f32,
        /// How bright OpenGL's highlights are beside the light that surfaces scatter, 0 to 1.
        pub highlight: f32,
        /// Samples a pixel of this frame.
        pub samples: u32,
        /// The number of the first one in the pixel's sequence, and of the first one in the frame before.
        pub first_sample: u32,
        pub first_sample_before: u32,
        /// Samples a pixel that [`ViewRecord::light`] holds already.
        pub accumulated: u32,
        pub seed: u32,
        /// Radiance of the sky, its mean where there is a map.
        pub sky: [f32; 3],
        /// What the map holds is at least so much light, and then this many times as much.
        pub sky_least: [f32; 3],
        pub sky_scale: [f32; 3],
        /// How far moving things darken surfaces with baked light.
        pub contact_reach: f32,
        /// Ambient light of the program.
        pub ambient: [f32; 3],
        /// What is painted: a `PAINT_` constant.
        pub paint: u32,
        /// Height of a pixel at depth 1, or anywhere where pixels look side by side.
        pub pixel_spread: f32,
        /// 1 if something moves that could darken baked surfaces.
        pub has_movers: u32,
        /// Workgroups of the exposure's sums.
        pub sum_count: u32,
        /// How much of the way to its new value exposure goes: 1 at once.
        pub exposure_rate: f32,
        /// A position's product with this is its depth: the distance along the view. Where pixels look side by side, the unit
        /// vector along which they do.
        pub forward: [f32; 3],
        /// Where the upper left pixel's centre is at depth 1 (on the near plane where pixels look side by side), and how far it is from there to the next pixel to the
        /// right and to the next one below.
        pub pixel_origin: [f32; 3],
        pub pixel_right: [f32; 3],
        pub pixel_down: [f32; 3],
        /// Positions to clip space of the frame before, rows of a 4x4 matrix, and to its depth along the view.
        pub clip_before: [[f32; 4]; 4],
        pub depth_before: [f32; 4],
        /// Frames that direct, indirect and specular light are gathered over, at most.
        pub longest: [f32; 3],
        /// Samples that may be spent in a frame on texels whose history is short, besides all others, and on one of them.
        pub spare_samples: u32,
        pub most_spare_samples: u32,
        /// What is added to positions of the frame before to be relative to this one's camera.
        pub origin_before: [f32; 3],
        /// Frames traced before this one.
        pub frame_number: u32,
        pub padding: u32,
    }
}

shared_struct! {
    /// What a pixel shows, packed.
    pub struct SurfaceTexel {
        /// Where its rays start.
        pub start: [f32; 3],
        /// Shading normal, octahedral, two snorm16.
        pub normal: u32,
        /// Geometric normal towards the viewer, likewise.
        pub geometric: u32,
        /// Albedo, sRGB in 11, 11 and 10 bits.
        pub albedo: u32,
        /// What the specular lobe reflects straight on, likewise.
        pub specular: u32,
        /// Radiance that it gives off, linear RGB, nine bits each and a shared exponent of five.
        pub emission: u32,
        /// From the lowest bit: eight bits of how much the program's fog leaves of it, eight of roughness, four with a
        /// `SURFACE_` constant, four with the mask of rays from here, eight of where an edge of its triangle is (see edge.glsl).
        pub properties: u32,
    }
}

shared_struct! {
    /// Light of a pixel before it meets albedo: means over samples.
    pub struct LightTexel {
        /// Irradiance over pi straight from light sources.
        pub direct: [f32; 3],
        /// The same by way of other surfaces and the sky.
        pub indirect: [f32; 3],
        /// Radiance of highlights over what the lobe reflects straight on.
        pub specular: [f32; 3],
        /// How the luminance of indirect light grows along each axis of the normal: the second of two bands of spherical harmonics,
        /// so that it can be mixed with that of places which face elsewhere.
        pub towards: [f32; 3],
    }
}

shared_struct! {
    /// What a pixel of `reference` has gathered; otherwise its radiance with smooth edges, and before they are.
    pub struct RadianceTexel {
        /// Mean radiance of all samples.
        pub mean: [f32; 3],
        /// Sum of squared differences from the mean (Welford, Note on a Method for Calculating Corrected Sums of Squares
        /// and Products, 1962).
        pub squares: [f32; 3],
    }
}

shared_struct! {
    /// A light that a pixel has kept of many, with the point of it, in the space of the numbers that choose the point.
    pub struct ReservoirTexel {
        pub light: u32,
        /// The numbers, two unorm16.
        pub point: u32,
        /// What the light's sample is multiplied by in place of 1 over the chance of its choice.
        pub weight: f32,
        /// How many candidates it was kept of.
        pub count: f32,
        /// What it brings unshadowed, before the weight.
        pub brings: f32,
    }
}

shared_struct! {
    /// What was left out of light, counted over a frame.
    pub struct TraceCounters {
        /// Samples that were no number.
        pub non_finite: u32,
        /// Samples that were limited.
        pub limited: u32,
        /// Luminance that limiting has removed, in units of 1/16.
        pub removed: u32,
        /// Rays.
        pub rays: u32,
        /// Texels of light whose history is short, and which may have more samples.
        pub needy: u32,
        pub padding: u32,
    }
}

shared_struct! {
    /// Sums of luminance over lit pixels for exposure.
    pub struct ExposureSum {
        /// As traced.
        pub traced: f32,
        /// As the program has it.
        pub program: f32,
    }
}

shared_struct! {
    /// The same over the pixels of one moving draw among baked surfaces: red, green and blue in units of 1/256.
    pub struct MoverSum {
        pub traced: [u32; 3],
        pub program: [u32; 3],
    }
}

shared_struct! {
    /// What the light of lit surfaces is multiplied by, kept from frame to frame.
    pub struct Exposure {
        pub scale: f32,
    }
}

shared_struct! {
    /// Push constants of the passes of a view.
    pub struct ViewPush {
        /// Address of the [`ViewRecord`].
        pub view: u64,
        /// Where the pass reads and writes, if it has more than one place to.
        pub source: u64,
        pub target: u64,
        /// Pixels between the taps of the filter.
        pub step: u32,
        pub padding: u32,
    }
}

shared_struct! {
    /// Push constants of a step of a refit; everything but the numbers is an address.
    pub struct RefitPush {
        pub structure: u64,
        /// The number of the triangle that each leaf record is of.
        pub sources: u64,
        /// Three corners a triangle.
        pub corners: u64,
        /// Numbers of nodes, the deepest level first.
        pub order: u64,
        /// What rays through each node cost, an f32.
        pub costs: u64,
        /// The root's goes here, too.
        pub answer: u64,
        /// How many nodes there are.
        pub nodes: u32,
        /// Which records, or which part of the order.
        pub first: u32,
        pub count: u32,
        pub padding: u32,
    }
}

shared_struct! {
    /// Push constants of the passes that make the map of the sky.
    pub struct SkyPush {
        /// What was drawn, four bytes a texel, side by side.
        pub drawn: u64,
        /// As [`ViewRecord::sky_map`].
        pub map: u64,
        /// Linear RGB where nothing is drawn.
        pub open: [f32; 3],
        /// Which level is made.
        pub level: u32,
        /// 1 if the map holds what earlier frames have drawn.
        pub remembers: u32,
        pub padding: u32,
    }
}

/// Texels along a side of the finest level of a sky's map: two thirds of a degree each.
pub const SKY_EDGE: u32 = 128;
/// Levels of a sky's map, each half as fine as the one before. The last one has 4 texels along a side: light of fewer
/// directions would come from behind the horizon.
pub const SKY_LEVELS: u32 = 6;

/// Bits of a hit's primitive below the member's number.
pub const MEMBER_SHIFT: u32 = 20;

/// Beside a surface's number in the push constants of its draw: its vertices' colours are light and not paint.
pub const WHITE_ALBEDO: u32 = 1 << 31;
/// Likewise: from here on a `BAKE_` constant, in [`BAKE_MASK`].
pub const BAKE_SHIFT: u32 = 28;
pub const BAKE_MASK: u32 = 7 << BAKE_SHIFT;
/// No part of a draw's colour is baked light. That of a texture unit is, by the unit's number and 1.
pub const BAKE_NONE: u32 = 0;
/// All of a draw's colour is, and it multiplies the surface below.
pub const BAKE_LAYER: u32 = 5;
/// Likewise, by twice its colour.
pub const BAKE_DOUBLED_LAYER: u32 = 6;
/// The vertices' colours are.
pub const BAKE_COLORS: u32 = 7;

/// Of a [`SurfaceDraw`]: the program names no such map.
pub const NO_MAP: u32 = u32::MAX;
/// Of a [`SurfaceDraw`]: it is no light.
pub const NO_LIGHT: u32 = u32::MAX;
/// In [`LightSource::trail`]: no walk down the light tree ends there. Trees are not so deep.
pub const NO_TRAIL: u32 = u32::MAX;
/// In the draw of a [`MeshMember`]: it is the light of this number and the next ones, spheres.
pub const MEMBER_OF_LIGHTS: u32 = 1 << 31;
/// In [`LightNode::next`]: it is a light's number.
pub const LIGHT_LEAF: u32 = 1 << 31;

/// Infinitely far: a disc if it has a radius, which rays that meet nothing see.
pub const LIGHT_FAR: u32 = 0;
/// A sphere's middle that shines as OpenGL has it, with a soft shadow: no ray meets it.
pub const LIGHT_POINT: u32 = 1;
/// A sphere that rays meet.
pub const LIGHT_SPHERE: u32 = 2;
/// A triangle that rays meet, shining from its front, or from both sides.
pub const LIGHT_TRIANGLE: u32 = 3;
pub const LIGHT_TRIANGLE_BOTH: u32 = 4;

/// In [`ViewRecord::traits`]: numbers are independent, not of a sequence.
pub const TRACE_INDEPENDENT: u32 = 1;
/// Likewise: a light is chosen among all with equal chances.
pub const TRACE_UNIFORM_LIGHTS: u32 = 2;
/// Likewise: no sample is limited.
pub const TRACE_UNLIMITED: u32 = 4;
/// Likewise: paths end at random by what they carry.
pub const TRACE_ROULETTE: u32 = 8;
/// The projection is orthographic: pixels look side by side.
pub const TRACE_PARALLEL: u32 = 16;
/// Edges of triangles are smoothed.
pub const TRACE_SMOOTH_EDGES: u32 = 32;

/// Instances that never move.
pub const MASK_STATIC: u32 = 1;
/// Instances that move or change.
pub const MASK_MOVING: u32 = 2;
/// The first-person weapon.
pub const MASK_VIEW_MODEL: u32 = 4;
