//! What rays go through, of either backend, behind one interface.
//!
//! A frame says which meshes it has, by content; those that are new are built; then instances of them become the top level.
//! What must be done on the device for that is recorded by the `build` pass, before any ray is shot.
//!
//! Which meshes are there, how long they stay, and which one of the last frame has become which of this one is kept here, for
//! both backends; what a backend does is [`Builder`].

use afterglow_bvh::Aabb;
use afterglow_gpu::{Commands, Gpu, GpuError};
use hashbrown::HashMap;

use super::backend::Backend;
use super::driver_input::DriverInput;
use super::formers::Formers;
use super::hardware::HardwareStructures;
use super::meshes::Meshes;
use crate::uploads::UploadArena;

/// Frames after which a mesh that no frame has used is given up.
const IDLE_FRAMES: u64 = 60;

/// A mesh to build.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeshInput<'a> {
    pub(crate) shapes: Shapes<'a>,
    /// Whether it will be used for long.
    pub(crate) is_lasting: bool,
}

/// What a mesh is made of, in object space. A hit's primitive is the number of the member, shifted by `MEMBER_SHIFT`, and
/// of the triangle in it; spheres are one member.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Shapes<'a> {
    /// Three corners a triangle, the members' triangles one after another.
    Triangles { corners: &'a [[f32; 3]], members: &'a [Member] },
    /// Centre and radius of each; instances may be moved, but nothing else.
    Spheres(&'a [[f32; 4]]),
}

impl Shapes<'_> {
    /// Triangles or spheres.
    fn count(&self) -> usize {
        match self {
            Self::Triangles { corners, .. } => corners.len() / 3,
            Self::Spheres(spheres) => spheres.len(),
        }
    }
}

/// Triangles of one draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Member {
    /// At most `1 << MEMBER_SHIFT`.
    pub(crate) triangles: u32,
    pub(crate) is_alpha_tested: bool,
}

/// An instance of a mesh that is there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) content: u64,
    pub(crate) object_to_world: [[f32; 4]; 3],
    /// Number of the first member among the frame's.
    pub(crate) id: u32,
    pub(crate) mask: u8,
}

/// A frame's top level.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct TopLevel {
    pub(crate) address: u64,
    pub(crate) instances: u32,
    /// The longest side of the box of all that rays can meet.
    pub(crate) extent: f32,
}

/// What a backend does. It has meshes by their contents; which of them are there, and for how long, is not its business.
pub(super) trait Builder: Send {
    /// A new frame begins.
    fn begin_frame(&mut self, arena: &mut UploadArena) -> Result<(), GpuError>;

    /// Whether a mesh that lasts, of so many triangles, may be built now; if not, it is asked for in the next frame again.
    fn has_room(&self, _triangles: usize) -> bool {
        true
    }

    /// Builds a mesh, or moves the one of [`Changing::former`].
    fn build(
        &mut self,
        content: u64,
        input: &MeshInput<'_>,
        changing: Option<&Changing<'_>>,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError>;

    /// Whether rays can meet anything of a mesh.
    fn is_met(&self, content: u64) -> bool;

    /// Whether a mesh is still being built.
    fn is_waiting(&self, _content: u64) -> bool {
        false
    }

    /// Gives a mesh up; frames in flight may still use it.
    fn free(&mut self, content: u64);

    /// Makes the top level of a frame.
    fn top_level(&mut self, placed: &[Placed], arena: &mut UploadArena) -> Result<TopLevel, GpuError>;

    /// Whether this frame has anything to record.
    fn has_work(&self) -> bool;

    /// Records what brings this frame's structures to the device.
    fn record(&self, commands: &Commands<'_>);
}

/// A mesh that does not last.
pub(super) struct Changing<'a> {
    pub(super) input: DriverInput<'a>,
    /// One of the same topology that the last frame used and this one does not. It is the backend's to move or to free.
    pub(super) former: Option<u64>,
}

/// A mesh that was built.
struct Entry {
    /// Of meshes that do not last and that rays can meet.
    topology: Option<u64>,
    /// The frame that has used it last.
    used: u64,
}

/// The structures of a backend, kept from frame to frame.
pub(crate) struct Structures {
    builder: Box<dyn Builder>,
    entries: HashMap<u64, Entry>,
    formers: Formers,
    frame: u64,
    /// Triangles and spheres built in this frame.
    built: usize,
}

impl Structures {
    /// `waits`: frames wait for all that they need.
    ///
    /// # Errors
    /// If the device lacks what the backend needs.
    pub(crate) fn new(gpu: &Gpu, backend: Backend, waits: bool) -> Result<Self, GpuError> {
        Ok(Self::with(match backend {
            Backend::Software => Box::new(Meshes::new(gpu, waits)),
            Backend::Hardware => Box::new(HardwareStructures::new(gpu)?),
        }))
    }

    fn with(builder: Box<dyn Builder>) -> Self {
        Self { builder, entries: HashMap::new(), formers: Formers::default(), frame: 0, built: 0 }
    }

    /// A new frame begins: what was not used for long goes.
    pub(crate) fn begin_frame(&mut self, arena: &mut UploadArena) -> Result<(), GpuError> {
        self.frame += 1;
        self.built = 0;
        self.formers.begin_frame();
        let (frame, builder) = (self.frame, &mut self.builder);
        self.entries.retain(|content, entry| {
            let is_kept = entry.used + IDLE_FRAMES > frame;
            if !is_kept {
                builder.free(*content);
            }
            is_kept
        });
        self.builder.begin_frame(arena)
    }

    /// Whether a mesh is there, so that it need not be built.
    pub(crate) fn has(&self, content: u64) -> bool {
        self.entries.contains_key(&content)
    }

    /// Whether a mesh that lasts, of so many triangles, may be built now.
    pub(crate) fn has_room(&self, triangles: usize) -> bool {
        self.builder.has_room(triangles)
    }

    /// Whether rays miss a mesh that they could meet, because it is still being built or was not begun.
    pub(crate) fn is_waiting(&self, content: u64) -> bool {
        !self.has(content) || self.builder.is_waiting(content)
    }

    /// Builds a mesh that is not there, or moves one that the last frame used and this one does not.
    pub(crate) fn build(
        &mut self,
        content: u64,
        input: &MeshInput<'_>,
        arena: &mut UploadArena,
    ) -> Result<(), GpuError> {
        let sound = if input.is_lasting { None } else { DriverInput::new(&input.shapes) };
        let changing = sound.map(|input| Changing { former: self.former(input.topology), input });
        let topology = changing.as_ref().map(|changing| changing.input.topology);
        if input.is_lasting || changing.is_some() {
            self.built += input.shapes.count();
            self.builder.build(content, input, changing.as_ref(), arena)?;
        }
        self.entries.insert(content, Entry { topology, used: 0 });
        Ok(())
    }

    /// A mesh that the last frame used and this one does not. It is no longer there.
    fn former(&mut self, topology: u64) -> Option<u64> {
        while let Some(content) = self.formers.next(topology) {
            let is_idle = self.entries.get(&content).is_some_and(|entry| entry.used != self.frame);
            if is_idle && self.entries.remove(&content).is_some() {
                return Some(content);
            }
        }
        None
    }

    /// Says that this frame uses a mesh, and whether rays can meet anything of it.
    pub(crate) fn take(&mut self, content: u64) -> bool {
        let Some(entry) = self.entries.get_mut(&content) else {
            return false;
        };
        if let (Some(topology), true) = (entry.topology, entry.used != self.frame) {
            self.formers.note(topology, content);
        }
        entry.used = self.frame;
        self.builder.is_met(content)
    }

    /// Makes the top level of a frame. It is empty if the instances are more than a device takes.
    pub(crate) fn top_level(
        &mut self,
        placed: &[Placed],
        arena: &mut UploadArena,
    ) -> Result<TopLevel, GpuError> {
        self.builder.top_level(placed, arena)
    }

    /// Triangles and spheres built in this frame.
    pub(crate) fn built(&self) -> usize {
        self.built
    }

    /// Whether this frame has anything to record.
    pub(crate) fn has_work(&self) -> bool {
        self.builder.has_work()
    }

    /// Records what brings this frame's structures to the device.
    pub(crate) fn record(&self, commands: &Commands<'_>) {
        self.builder.record(commands);
    }
}

/// The longest side of a box, 0 if it is empty.
pub(super) fn longest_side(bounds: &Aabb) -> f32 {
    if bounds.is_empty() { 0.0 } else { (bounds.max - bounds.min).max_element() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::gpu;
    use std::sync::{Arc, Mutex};

    /// What was asked of a builder that builds nothing.
    #[derive(Debug, PartialEq)]
    enum Asked {
        Build(u64, Option<u64>),
        Free(u64),
    }

    struct Noting(Arc<Mutex<Vec<Asked>>>);

    impl Builder for Noting {
        fn begin_frame(&mut self, _: &mut UploadArena) -> Result<(), GpuError> {
            Ok(())
        }

        fn build(
            &mut self,
            content: u64,
            _: &MeshInput<'_>,
            changing: Option<&Changing<'_>>,
            _: &mut UploadArena,
        ) -> Result<(), GpuError> {
            let former = changing.and_then(|changing| changing.former);
            self.0.lock().unwrap().push(Asked::Build(content, former));
            Ok(())
        }

        fn is_met(&self, _: u64) -> bool {
            true
        }

        fn free(&mut self, content: u64) {
            self.0.lock().unwrap().push(Asked::Free(content));
        }

        fn top_level(&mut self, _: &[Placed], _: &mut UploadArena) -> Result<TopLevel, GpuError> {
            Ok(TopLevel::default())
        }

        fn has_work(&self) -> bool {
            false
        }

        fn record(&self, _: &Commands<'_>) {}
    }

    /// Frames that use these meshes, all of one changing triangle; what each asks for.
    fn frames(used: &[&[u64]]) -> Vec<Vec<Asked>> {
        let asked = Arc::new(Mutex::new(Vec::new()));
        let mut structures = Structures::with(Box::new(Noting(asked.clone())));
        let mut arena = UploadArena::new(&gpu());
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let shapes = Shapes::Triangles {
            corners: &corners,
            members: &[Member { triangles: 1, is_alpha_tested: false }],
        };
        let mut frame = |used: &&[u64]| {
            structures.begin_frame(&mut arena).unwrap();
            for content in *used {
                structures.take(*content);
            }
            for content in *used {
                if !structures.has(*content) {
                    let input = MeshInput { shapes, is_lasting: false };
                    structures.build(*content, &input, &mut arena).unwrap();
                }
                assert!(structures.take(*content));
            }
            std::mem::take(&mut *asked.lock().unwrap())
        };
        used.iter().map(&mut frame).collect()
    }

    #[test]
    fn only_what_is_gone_becomes_something_else() {
        let asked = frames(&[&[1, 2], &[1, 3], &[4, 3, 5]]);
        assert_eq!(asked[0], [Asked::Build(1, None), Asked::Build(2, None)]);
        assert_eq!(asked[1], [Asked::Build(3, Some(2))]);
        assert_eq!(asked[2], [Asked::Build(4, Some(1)), Asked::Build(5, None)]);
    }

    #[test]
    fn what_no_frame_uses_goes() {
        let idle = vec![&[][..]; IDLE_FRAMES as usize];
        let asked = frames(&[&[&[1][..]], &idle[..]].concat());
        assert_eq!(asked.last().unwrap(), &[Asked::Free(1)]);
        assert!(asked[1..IDLE_FRAMES as usize].iter().all(Vec::is_empty));
    }

    #[test]
    fn nothing_to_meet_is_not_built() {
        let mut structures = Structures::new(&gpu(), Backend::Software, true).unwrap();
        let mut arena = UploadArena::new(&gpu());
        structures.begin_frame(&mut arena).unwrap();
        let members = [Member { triangles: 1, is_alpha_tested: false }];
        let shapes = Shapes::Triangles { corners: &[[f32::NAN; 3]; 3], members: &members };
        for (content, is_lasting) in [(1, false), (2, true)] {
            structures.build(content, &MeshInput { shapes, is_lasting }, &mut arena).unwrap();
            assert!(structures.has(content) && !structures.take(content));
        }
    }
}
