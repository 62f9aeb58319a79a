//! Frames in parts: a later part joined to the ones before it.

use super::{Draw, Frame, Operation, PixelCopy, PixelRectangle, VertexSource};

/// How far the entries of each table move.
struct Offsets {
    words: u32,
    indices: u32,
    retained: u32,
    fixed: u32,
    viewports: u32,
    bindings: u32,
    transforms: u32,
    lights: u32,
    materials: u32,
    environments: u32,
    texgens: u32,
    texture_matrices: u32,
    clip_planes: u32,
    current: u32,
}

impl Frame {
    /// Joins what a later part of the same frame has to this one, and leaves the other empty. If the device was lost in
    /// between, only images stay of what was before.
    pub fn append(&mut self, later: &mut Frame) {
        if self.device != later.device {
            self.keep_images();
            self.device = later.device;
        }
        let offsets = Offsets {
            words: self.words.len() as u32,
            indices: self.indices.len() as u32,
            retained: self.retained.len() as u32,
            fixed: self.fixed.len() as u32,
            viewports: self.viewports.len() as u32,
            bindings: self.bindings.len() as u32,
            transforms: self.transforms.len() as u32,
            lights: self.lights.len() as u32,
            materials: self.materials.len() as u32,
            environments: self.environments.len() as u32,
            texgens: self.texgens.len() as u32,
            texture_matrices: self.texture_matrices.len() as u32,
            clip_planes: self.clip_planes.len() as u32,
            current: self.current.len() as u32,
        };
        self.size = later.size;
        self.operations.extend(later.operations.drain(..).map(|operation| offsets.operation(operation)));
        self.words.append(&mut later.words);
        self.indices.append(&mut later.indices);
        self.seams.extend(later.seams.drain(..).map(|seam| seam + offsets.indices));
        self.retained.append(&mut later.retained);
        self.fixed.append(&mut later.fixed);
        self.viewports.append(&mut later.viewports);
        self.bindings.append(&mut later.bindings);
        self.transforms.append(&mut later.transforms);
        self.lights.append(&mut later.lights);
        self.materials.append(&mut later.materials);
        self.environments.append(&mut later.environments);
        self.texgens.append(&mut later.texgens);
        self.texture_matrices.append(&mut later.texture_matrices);
        self.clip_planes.append(&mut later.clip_planes);
        self.current.append(&mut later.current);
    }
}

impl Offsets {
    fn operation(&self, operation: Operation) -> Operation {
        match operation {
            Operation::Draw(draw) => Operation::Draw(self.draw(draw)),
            Operation::Pixels(pixels) => Operation::Pixels(Box::new(PixelRectangle {
                fixed: pixels.fixed + self.fixed,
                viewport: pixels.viewport + self.viewports,
                bindings: pixels.bindings + self.bindings,
                environment: pixels.environment + self.environments,
                current: pixels.current + self.current,
                ..*pixels
            })),
            Operation::CopyPixels(copy) => Operation::CopyPixels(Box::new(PixelCopy {
                fixed: copy.fixed + self.fixed,
                viewport: copy.viewport + self.viewports,
                bindings: copy.bindings + self.bindings,
                environment: copy.environment + self.environments,
                current: copy.current + self.current,
                ..*copy
            })),
            other => other,
        }
    }

    fn draw(&self, draw: Draw) -> Draw {
        let source = match draw.source {
            VertexSource::Arena { first_word, vertices, first_index } => VertexSource::Arena {
                first_word: first_word + self.words,
                vertices,
                first_index: first_index + self.indices,
            },
            VertexSource::Retained { range, first_index } => {
                VertexSource::Retained { range: range + self.retained, first_index }
            }
        };
        Draw {
            source,
            fixed: draw.fixed + self.fixed,
            viewport: draw.viewport + self.viewports,
            bindings: draw.bindings + self.bindings,
            transform: draw.transform + self.transforms,
            lights: draw.lights + self.lights,
            material: draw.material + self.materials,
            environment: draw.environment + self.environments,
            texgen: draw.texgen + self.texgens,
            texture_matrices: draw.texture_matrices + self.texture_matrices,
            clip_planes: draw.clip_planes + self.clip_planes,
            current: draw.current + self.current,
            ..draw
        }
    }
}
