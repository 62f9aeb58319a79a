//! The structures of each file, in the order in which they are declared: before their use.

use afterglow_gl::frame::*;
use afterglow_layout::{SharedStruct, StructDescription};
use afterglow_records::*;

macro_rules! descriptions {
    ($($structure:ident),* $(,)?) => { vec![$($structure::description()),*] };
}

/// A frame's own blocks.
pub fn gl_blocks() -> Vec<StructDescription> {
    descriptions![
        Transform,
        Light,
        Lights,
        MaterialFace,
        Material,
        Environment,
        TexGenUnit,
        TexGen,
        Matrix,
        TextureMatrices,
        Plane,
        ClipPlanes,
        CurrentAttributes,
    ]
}

/// What the renderer writes for its shaders, beside them.
pub fn records() -> Vec<StructDescription> {
    descriptions![
        FrameRecord,
        DrawRecord,
        DrawPush,
        PixelRecord,
        ClearPush,
        FlipRecord,
        FlipPush,
        AccumulatePush,
    ]
}

/// What path tracing's passes share.
pub fn pathtrace() -> Vec<StructDescription> {
    descriptions![
        SurfaceDraw,
        MeshMember,
        LightSource,
        LightNode,
        ViewRecord,
        SurfaceTexel,
        LightTexel,
        ChannelTexel,
        GuideTexel,
        MotionTexel,
        StratumTexel,
        GradientTexel,
        FeatureFit,
        FitRecord,
        LuminanceTexel,
        RadianceTexel,
        TraceCounters,
        ReservoirTexel,
        ExposureSum,
        MoverSum,
        Exposure,
        ViewPush,
        RefitPush,
        SkyPush,
    ]
}
