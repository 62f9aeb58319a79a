//! How light is found for surfaces, and what pictures show instead of themselves.

/// How light is found for a pixel, as `SurfaceDraw::kind` holds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum SurfaceKind {
    /// Nothing traced.
    None = 0,
    /// By the program's lights: albedo times irradiance.
    Lit = 1,
    /// The program's own colour, darkened by what the lights do not reach: unlit among lit surfaces.
    Catcher = 2,
    /// The program's own colour is its light, darkened by moving things nearby.
    Baked = 3,
    /// Something that moves among baked surfaces: lit by them.
    BakedMover = 4,
}

/// What pictures show for debugging, as `ViewRecord::paint` holds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u32)]
pub enum Paint {
    /// The picture itself.
    #[default]
    Picture = 0,
    /// How light is found, a colour a [`SurfaceKind`].
    Kind = 1,
    /// Shading normals.
    Normal = 2,
    /// Albedo.
    Albedo = 3,
    /// Direct light.
    Direct = 4,
    /// Indirect light.
    Indirect = 5,
    /// The sky as rays see it, in all directions: longitude to the right, latitude of the world's y axis upward.
    Sky = 6,
    /// Light of the specular lobe.
    Specular = 7,
    /// Where what is seen was in the frame before: to the right red, down green, by up to 16 pixels; blue where it was not there.
    Motion = 8,
    /// Standard deviation of each sample's direct, indirect and specular light.
    Variance = 9,
    /// How much of the earlier frames' direct, indirect and specular light is not believed.
    Gradient = 10,
    /// Over how many frames direct, indirect and specular light are gathered, of as many as may be.
    History = 11,
    /// Edges that are smoothed.
    Edges = 12,
}

impl Paint {
    /// All, in the order of their numbers.
    pub const ALL: [Paint; 13] = [
        Paint::Picture,
        Paint::Kind,
        Paint::Normal,
        Paint::Albedo,
        Paint::Direct,
        Paint::Indirect,
        Paint::Sky,
        Paint::Specular,
        Paint::Motion,
        Paint::Variance,
        Paint::Gradient,
        Paint::History,
        Paint::Edges,
    ];

    /// As options write it.
    pub fn name(self) -> &'static str {
        match self {
            Paint::Picture => "picture",
            Paint::Kind => "kind",
            Paint::Normal => "normal",
            Paint::Albedo => "albedo",
            Paint::Direct => "direct",
            Paint::Indirect => "indirect",
            Paint::Sky => "sky",
            Paint::Specular => "specular",
            Paint::Motion => "motion",
            Paint::Variance => "variance",
            Paint::Gradient => "gradient",
            Paint::History => "history",
            Paint::Edges => "edges",
        }
    }
}
