//! Offsets that the shader compiler gives to the generated structures are those of Rust.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::process::{Command, Stdio};

use afterglow_layout::StructDescription;

use super::{NOTICE, lists, structures};

/// Opcodes and decorations of SPIR-V (specification 3.42, 3.20).
mod spirv {
    pub const NAME: u32 = 5;
    pub const MEMBER_NAME: u32 = 6;
    pub const RUNTIME_ARRAY: u32 = 29;
    pub const DECORATE: u32 = 71;
    pub const MEMBER_DECORATE: u32 = 72;
    pub const ARRAY_STRIDE: u32 = 6;
    pub const OFFSET: u32 = 35;
}

/// A shader with a buffer of each structure.
fn shader(all: &[StructDescription]) -> String {
    let mut text = "#version 460\n#extension GL_EXT_scalar_block_layout : require\n\
        #extension GL_EXT_shader_explicit_arithmetic_types_int64 : require\n"
        .to_owned();
    text += NOTICE;
    text += &structures(all);
    for (binding, StructDescription { name, .. }) in all.iter().enumerate() {
        let _ = writeln!(
            text,
            "layout(scalar, binding = {binding}) buffer Buffer{name} {{ {name} array_{name}[]; }};"
        );
    }
    text + "void main() {}\n"
}

fn compile(text: &str) -> Vec<u32> {
    let compiler = std::env::var("GLSLC").unwrap_or_else(|_| "glslc".into());
    let mut glslc = Command::new(compiler)
        .args(["--target-env=vulkan1.2", "-fshader-stage=compute", "-O0", "-g", "-", "-o", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("./x setup installs glslc");
    glslc.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    let output = glslc.wait_with_output().unwrap();
    assert!(output.status.success());
    output.stdout.as_chunks().0.iter().map(|&bytes| u32::from_le_bytes(bytes)).collect()
}

/// Offsets of members and stride in an array, by structure.
#[derive(Default)]
struct Layouts {
    names: HashMap<u32, String>,
    members: HashMap<(u32, u32), String>,
    offsets: HashMap<(u32, u32), u32>,
    strides: HashMap<u32, u32>,
    elements: HashMap<u32, u32>,
}

impl Layouts {
    fn read(words: &[u32]) -> Layouts {
        let mut layouts = Layouts::default();
        let mut rest = &words[5..];
        while let Some(&first) = rest.first() {
            let (operands, next) = rest[1..].split_at((first >> 16) as usize - 1);
            layouts.instruction(first & 0xffff, operands);
            rest = next;
        }
        layouts
    }

    fn instruction(&mut self, opcode: u32, operands: &[u32]) {
        match (opcode, operands) {
            (spirv::NAME, [id, text @ ..]) => drop(self.names.insert(*id, string(text))),
            (spirv::MEMBER_NAME, [id, member, text @ ..]) => {
                self.members.insert((*id, *member), string(text));
            }
            (spirv::MEMBER_DECORATE, [id, member, spirv::OFFSET, offset]) => {
                self.offsets.insert((*id, *member), *offset);
            }
            (spirv::DECORATE, [id, spirv::ARRAY_STRIDE, stride]) => drop(self.strides.insert(*id, *stride)),
            (spirv::RUNTIME_ARRAY, [id, element]) => drop(self.elements.insert(*id, *element)),
            _ => {}
        }
    }

    /// Size and members of a structure that is an element of a runtime array.
    fn structure(&self, name: &str) -> Option<(u32, Vec<(String, u32)>)> {
        let of_name = |(_, element): &(&u32, &u32)| self.names.get(element).is_some_and(|n| n == name);
        let (array, structure) = self.elements.iter().find(of_name)?;
        let member = |i: u32| {
            Some((self.members.get(&(*structure, i))?.clone(), *self.offsets.get(&(*structure, i))?))
        };
        Some((*self.strides.get(array)?, (0..).map_while(member).collect()))
    }
}

fn string(words: &[u32]) -> String {
    let bytes: Vec<u8> =
        words.iter().flat_map(|word| word.to_le_bytes()).take_while(|&byte| byte != 0).collect();
    String::from_utf8(bytes).unwrap()
}

#[test]
fn the_compiler_places_fields_as_rust_does() {
    let all = [lists::gl_blocks(), lists::records(), lists::pathtrace()].concat();
    let layouts = Layouts::read(&compile(&shader(&all)));
    for structure in &all {
        let (size, members) =
            layouts.structure(structure.name).unwrap_or_else(|| panic!("no {}", structure.name));
        let fields = structure.fields.iter().map(|field| (field.name.to_owned(), field.offset as u32));
        assert_eq!(members, fields.collect::<Vec<_>>(), "{}", structure.name);
        assert_eq!(size as usize, structure.size, "{}", structure.name);
    }
}
