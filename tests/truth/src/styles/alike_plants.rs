//! A land in blocks, each with a matrix of its own and culled by itself, on which alike plants grow at other places in each;
//! rows of alike posts in world coordinates, as many as are seen in one batch. Nothing moves but the camera.

use afterglow_api::constants::*;
use afterglow_scene::Class;
use glam::{Affine3A, DMat4, DVec3, Vec2, Vec3};

use crate::client::{Attributes, Client, Texture, Thing, thing};
use crate::kit::{Mesh, Picture, Random, Vertex, boxed, draw_hud, in_sight, look_at, perspective};
use crate::truth::TrueCamera;

/// Blocks along each axis, and the side of one.
const BLOCKS: i32 = 9;
const SIDE: f32 = 16.0;
/// How far this program draws.
const FAR: f64 = 60.0;

/// A land of blocks.
pub struct AlikePlants {
    blocks: Vec<Block>,
    posts: Vec<(DVec3, Mesh)>,
    textures: [Texture; 3],
}

struct Block {
    object: u64,
    place: DVec3,
    ground: Mesh,
    plants: Mesh,
}

impl AlikePlants {
    /// Loads everything.
    pub fn begin(gl: &mut Client) -> AlikePlants {
        gl.set_extent(f64::from(BLOCKS as f32 * SIDE) * std::f64::consts::SQRT_2);
        let mut random = Random::new(11);
        let blocks = (0..BLOCKS * BLOCKS).map(|index| block(index, &mut random)).collect();
        let posts = (0..160).map(|index| {
            let along = 1.7 * (index / 4) as f32 - 34.0;
            let place = Vec3::new([-3.0, 3.0, -5.0, 5.0][index % 4], 0.0, along);
            let post = boxed(Vec3::new(-0.2, 0.0, -0.2), Vec3::new(0.2, 2.5, 0.2));
            (place.as_dvec3(), post.transformed(Affine3A::from_translation(place)))
        });
        AlikePlants {
            blocks,
            posts: posts.collect(),
            textures: [
                gl.texture(&Picture::grain(3, [0.35, 0.5, 0.25], 0.1)),
                gl.texture(&Picture::grain(4, [0.2, 0.6, 0.15], 0.2)),
                gl.texture(&Picture::bricks([0.6, 0.55, 0.5])),
            ],
        }
    }
}

/// Uneven ground, so that no two are the same, and two to four plants.
fn block(index: i32, random: &mut Random) -> Block {
    let cell = Vec3::new((index % BLOCKS) as f32, 0.0, (index / BLOCKS) as f32);
    let middle = 0.5 * BLOCKS as f32;
    let mut ground = Mesh::default();
    let dip = Vec3::Y * random.between(-0.3, 0.0);
    ground.parallelogram(dip, [Vec3::Z * SIDE, Vec3::X * SIDE], 4, Vec2::splat(4.0));
    let mut plants = Mesh::default();
    for _ in 0..2 + index as u64 % 3 {
        let mut node = || random.between(0.0, SIDE - 1.0).floor();
        plant(&mut plants, Vec3::new(node(), 0.0, node()));
    }
    let place = ((cell - Vec3::new(middle, 0.0, middle)) * SIDE).as_dvec3();
    Block { object: 1 + index as u64, place, ground, plants }
}

/// Two crossed quads.
fn plant(mesh: &mut Mesh, at: Vec3) {
    for along in [Vec3::new(1.0, 0.0, 1.0), Vec3::new(1.0, 0.0, -1.0)] {
        let start = at + Vec3::Z * (0.5 - 0.5 * along.z);
        let corner = |share: Vec2| Vertex::new(start + along * share.x + Vec3::Y * share.y, Vec3::Y, share);
        mesh.push(GL_QUADS, &[Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y].map(corner));
    }
}

impl super::Style for AlikePlants {
    fn draw(&mut self, gl: &mut Client, frame: u32) {
        let t = f64::from(frame) / 30.0;
        // It turns in steps, as a mouse does.
        let turn = 0.9 * t + 0.06 * f64::from(frame % 3);
        let eye = DVec3::new(2.0 * (1.3 * t).sin(), 1.7, 14.0 * t - 20.0);
        let camera = TrueCamera {
            view: look_at(eye, eye + DVec3::new(turn.sin(), -0.1, turn.cos())),
            projection: perspective(60.0, 0.2, FAR),
        };
        gl.clear_color([0.6, 0.7, 0.9]);
        gl.begin_world(0, camera);
        let half = f64::from(SIDE) / 2.0;
        let centre = |block: &Block| block.place + DVec3::new(half, 0.0, half);
        let is_seen = |block: &&Block| {
            in_sight(&camera, centre(block), 1.5 * half) && eye.distance(centre(block)) < FAR
        };
        let seen: Vec<&Block> = self.blocks.iter().filter(is_seen).collect();
        for block in &seen {
            gl.modelview(camera.view * DMat4::from_translation(block.place));
            gl.bind(self.textures[0]);
            gl.draw_arrays(thing(Class::Static, block.object), &block.ground, Attributes::COLORED);
        }
        for block in &seen {
            gl.modelview(camera.view * DMat4::from_translation(block.place));
            gl.bind(self.textures[1]);
            gl.draw_arrays(thing(Class::Static, 200 + block.object), &block.plants, Attributes::COLORED);
        }
        gl.modelview(camera.view);
        gl.bind(self.textures[2]);
        let posts = self.posts.iter().enumerate().filter(|(_, (place, _))| in_sight(&camera, *place, 2.6));
        let posts: Vec<(Thing, &Mesh)> =
            posts.map(|(index, (_, post))| (thing(Class::Static, 400 + index as u64), post)).collect();
        gl.draw_batch(&posts, Attributes::COLORED);
        draw_hud(gl, frame);
    }
}
