//! Contexts from outside: calls in, frames out.

#![allow(clippy::unwrap_used, reason = "a failure is what a test reports")]

mod recorder;

use std::sync::Arc;

use afterglow_api::constants::*;
use afterglow_gl::backend::End;
use afterglow_gl::frame::{Draw, Frame, Operation, Slot, Topology, VertexSource};
use afterglow_gl::texture::{ImageDefinition, SubImage};
use afterglow_gl::{Context, Params, Pointer};
use recorder::{Recorder, context};

/// The frame that the calls made.
fn frame(calls: impl FnOnce(&mut Context)) -> Frame {
    let (mut context, recorder) = context();
    calls(&mut context);
    context.swap_buffers();
    recorder.0.lock().unwrap().pop().unwrap().0
}

fn draws(frame: &Frame) -> Vec<&Draw> {
    frame.draws().map(|(_, draw)| draw).collect()
}

#[test]
fn a_stipple_lies_in_memory_as_pixel_store_says() {
    let (mut context, _) = context();
    context.pixel_store(GL_UNPACK_LSB_FIRST, 1.0);
    context.pixel_store(GL_UNPACK_ALIGNMENT, 8.0);
    let mut image = [0; 256];
    (image[0], image[8]) = (0x01, 0x80);
    context.polygon_stipple_image(&image);
    let pattern = context.get_polygon_stipple();
    assert_eq!((pattern[0], pattern[4], pattern[8]), (0x80, 0x01, 0));
    let mut written = [0; 256];
    context.pixel_store(GL_PACK_LSB_FIRST, 1.0);
    context.pixel_store(GL_PACK_ALIGNMENT, 8.0);
    context.get_polygon_stipple_image(&mut written);
    assert_eq!(written, image);
    context.polygon_stipple_image(&image[..128]);
    assert_eq!(context.get_error(), GL_INVALID_OPERATION);
}

#[test]
fn a_mapped_buffer_has_an_address() {
    let (mut context, _) = context();
    assert_eq!(context.get_buffer_pointer(GL_ARRAY_BUFFER, GL_BUFFER_MAP_POINTER), None);
    assert_eq!(context.get_error(), GL_INVALID_OPERATION);
    context.bind_buffer(GL_ARRAY_BUFFER, 1);
    context.buffer_data(GL_ARRAY_BUFFER, 4, None, GL_STATIC_DRAW);
    assert_eq!(context.get_buffer_pointer(GL_ARRAY_BUFFER, GL_BUFFER_MAP_POINTER), Some(0));
    assert!(context.map_buffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY));
    assert_ne!(context.get_buffer_pointer(GL_ARRAY_BUFFER, GL_BUFFER_MAP_POINTER), Some(0));
    assert_eq!(context.get_buffer_pointer(GL_ARRAY_BUFFER, GL_BUFFER_SIZE), None);
    assert_eq!(context.get_error(), GL_INVALID_ENUM);
}

#[test]
fn pixel_maps_of_colours_are_fractions_and_those_of_indices_are_not() {
    let (mut context, _) = context();
    for map in [GL_PIXEL_MAP_I_TO_R, GL_PIXEL_MAP_I_TO_I] {
        context.pixel_map_integers(map, &[0, 0xffff], 0xffff);
        assert_eq!(context.get_pixel_map_integers(map, 0xffff), [0, 0xffff]);
    }
    assert_eq!(context.get_pixel_map(GL_PIXEL_MAP_I_TO_R), [0.0, 1.0]);
    assert_eq!(context.get_pixel_map(GL_PIXEL_MAP_I_TO_I), [0.0, 65535.0]);
}

fn triangle(context: &mut Context) {
    context.begin(GL_TRIANGLES);
    for corner in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]] {
        context.vertex([corner[0], corner[1], 0.0, 1.0]);
    }
    context.end();
}

/// The value that a vertex of a draw has for an attribute, from its own words or from the current values.
fn attribute(frame: &Frame, draw: &Draw, vertex: usize, slot: Slot) -> [f32; 4] {
    let (words, _) = frame.geometry(draw);
    let (format, offset) = (draw.layout.format(slot as usize), draw.layout.offset(slot as usize));
    let current = &frame.current[draw.current as usize];
    if format.words() == 0 {
        return match slot {
            Slot::Color => current.color,
            Slot::Normal => current.normal,
            _ => panic!("not asked for here"),
        };
    }
    let mut value = [0.0, 0.0, 0.0, 1.0];
    for (c, v) in value.iter_mut().enumerate().take(format.words()) {
        *v = f32::from_bits(words[vertex * draw.layout.stride() + offset + c]);
    }
    value
}

#[test]
fn a_frame_is_handed_over_in_parts() {
    let (mut gl, recorder) = context();
    assert!(!gl.hand_over_so_far());
    triangle(&mut gl);
    gl.begin(GL_TRIANGLES);
    assert!(!gl.hand_over_so_far());
    gl.end();
    assert!(gl.hand_over_so_far());
    assert!(!gl.hand_over_so_far());
    triangle(&mut gl);
    gl.swap_buffers();
    let frames = recorder.0.lock().unwrap();
    let ends: Vec<_> = frames.iter().map(|(frame, end)| (draws(frame).len(), *end)).collect();
    assert_eq!(ends, [(1, End::Continued), (1, End::Swap)]);
    assert!(frames.iter().all(|(frame, _)| frame.size == (64, 48)));
}

#[test]
fn primitives_that_meet_the_same_state_become_one_draw() {
    let frame = frame(|gl| {
        triangle(gl);
        triangle(gl);
        gl.translate(1.0, 0.0, 0.0);
        triangle(gl);
    });
    let draws = draws(&frame);
    assert_eq!(draws.len(), 2);
    assert_eq!(draws[0].index_count, 6);
    assert_eq!(frame.geometry(draws[0]).1, [2, 0, 1, 5, 3, 4]);
    assert_ne!(draws[0].transform, draws[1].transform);
}

#[test]
fn a_state_that_changes_nothing_keeps_the_draw_together() {
    let frame = frame(|gl| {
        gl.color([1.0, 0.0, 0.0, 1.0]);
        gl.depth_mask(true);
        triangle(gl);
        gl.depth_mask(true);
        gl.blend_func(GL_ONE, GL_ZERO);
        triangle(gl);
    });
    assert_eq!(draws(&frame).len(), 1);
}

#[test]
fn lists_inherit_the_current_colour_and_leave_theirs() {
    let frame = frame(|gl| {
        gl.new_list(1, GL_COMPILE);
        triangle(gl);
        gl.color([0.0, 1.0, 0.0, 1.0]);
        gl.end_list();
        gl.color([1.0, 0.0, 0.0, 1.0]);
        gl.call_list(1);
        gl.call_list(1);
    });
    let draws = draws(&frame);
    assert_eq!(draws.len(), 2);
    assert_eq!(attribute(&frame, draws[0], 0, Slot::Color), [1.0, 0.0, 0.0, 1.0]);
    assert_eq!(attribute(&frame, draws[1], 0, Slot::Color), [0.0, 1.0, 0.0, 1.0]);
    assert!(draws.iter().all(|draw| matches!(draw.source, VertexSource::Retained { .. })));
    assert_eq!(
        frame.retained.iter().map(|range| range.id()).collect::<std::collections::HashSet<_>>().len(),
        1
    );
}

#[test]
fn an_attribute_that_comes_late_in_a_list_is_inherited_by_the_vertices_before() {
    let frame = frame(|gl| {
        gl.new_list(1, GL_COMPILE);
        gl.begin(GL_TRIANGLES);
        gl.vertex([0.0, 0.0, 0.0, 1.0]);
        gl.color([0.0, 1.0, 0.0, 1.0]);
        gl.vertex([1.0, 0.0, 0.0, 1.0]);
        gl.vertex([0.0, 1.0, 0.0, 1.0]);
        gl.end();
        gl.end_list();
        gl.color([0.0, 0.0, 1.0, 1.0]);
        gl.call_list(1);
        triangle(gl);
    });
    let draws = draws(&frame);
    assert_eq!(attribute(&frame, draws[0], 0, Slot::Color), [0.0, 0.0, 1.0, 1.0]);
    assert_eq!(attribute(&frame, draws[0], 1, Slot::Color), [0.0, 1.0, 0.0, 1.0]);
    // What the primitive set last is current after the list.
    assert_eq!(attribute(&frame, draws[1], 0, Slot::Color), [0.0, 1.0, 0.0, 1.0]);
}

#[test]
fn compile_and_execute_draws_once_now_and_again_when_called() {
    let frame = frame(|gl| {
        gl.new_list(3, GL_COMPILE_AND_EXECUTE);
        triangle(gl);
        gl.end_list();
        gl.call_list(3);
    });
    let draws = draws(&frame);
    assert_eq!(draws.iter().map(|draw| draw.index_count).sum::<u32>(), 6);
}

#[test]
fn nested_lists_stop_at_the_limit() {
    let (mut gl, _) = context();
    gl.new_list(1, GL_COMPILE);
    gl.call_list(1);
    gl.end_list();
    gl.call_list(1);
    assert_eq!(gl.get_error(), GL_NO_ERROR);
}

fn positions(values: &[f32]) -> Pointer {
    Pointer::Blob(values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>().into())
}

#[test]
fn arrays_in_memory_are_copied_and_rebased() {
    let frame = frame(|gl| {
        gl.enable_client_state(GL_VERTEX_ARRAY);
        gl.vertex_pointer(2, GL_FLOAT, 0, positions(&[9.0, 9.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]));
        let indices = [1u16, 2, 3].iter().flat_map(|i| i.to_le_bytes()).collect::<Vec<u8>>();
        gl.draw_elements(GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, Pointer::Blob(indices.into()));
    });
    let draws = draws(&frame);
    let (words, indices) = frame.geometry(draws[0]);
    assert_eq!(indices, [2, 0, 1]);
    assert_eq!(words.iter().map(|&w| f32::from_bits(w)).collect::<Vec<_>>(), [0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
}

#[test]
fn an_enabled_array_without_a_pointer_is_not_read() {
    let frame = frame(|gl| {
        gl.enable_client_state(GL_VERTEX_ARRAY);
        gl.enable_client_state(GL_COLOR_ARRAY);
        gl.color([0.0, 1.0, 0.0, 1.0]);
        gl.vertex_pointer(2, GL_FLOAT, 0, positions(&[0.0; 6]));
        gl.draw_arrays(GL_TRIANGLES, 0, 3);
    });
    assert_eq!(attribute(&frame, draws(&frame)[0], 0, Slot::Color), [0.0, 1.0, 0.0, 1.0]);
}

#[test]
fn arrays_that_end_early_draw_nothing() {
    let frame = frame(|gl| {
        gl.enable_client_state(GL_VERTEX_ARRAY);
        gl.vertex_pointer(3, GL_FLOAT, 0, positions(&[1.0; 8]));
        gl.draw_arrays(GL_TRIANGLES, 0, 3);
        gl.draw_arrays(GL_TRIANGLES, i32::MAX, 3);
        gl.draw_arrays(GL_TRIANGLES, 0, i32::MAX);
    });
    assert!(draws(&frame).is_empty());
}

#[test]
fn unchanged_buffers_become_a_range_that_a_change_replaces() {
    let (mut gl, recorder) = context();
    let buffers = gl.gen_buffers(1);
    gl.bind_buffer(GL_ARRAY_BUFFER, buffers[0]);
    let bytes: Vec<u8> = [0.0f32, 0.0, 1.0, 0.0, 0.0, 1.0].iter().flat_map(|v| v.to_le_bytes()).collect();
    gl.buffer_data(GL_ARRAY_BUFFER, 24, Some(&bytes), GL_STATIC_DRAW);
    gl.enable_client_state(GL_VERTEX_ARRAY);
    gl.vertex_pointer(2, GL_FLOAT, 0, Pointer::Offset(0));
    let mut ids = Vec::new();
    for change in [false, false, false, true, false, false] {
        if change {
            gl.buffer_sub_data(GL_ARRAY_BUFFER, 0, &5.0f32.to_le_bytes());
        }
        gl.draw_arrays(GL_TRIANGLES, 0, 3);
        gl.swap_buffers();
        let (frame, _) = recorder.0.lock().unwrap().pop().unwrap();
        ids.push(frame.retained.first().map(|range| range.id()));
    }
    assert_eq!((ids[0], ids[3]), (None, None));
    assert!(ids[1].is_some() && ids[1] == ids[2]);
    assert!(ids[4].is_some() && ids[4] == ids[5] && ids[4] != ids[1]);
}

#[test]
fn buffers_that_are_written_for_each_frame_are_not_kept() {
    let (mut gl, recorder) = context();
    gl.bind_buffer(GL_ARRAY_BUFFER, 1);
    gl.enable_client_state(GL_VERTEX_ARRAY);
    gl.vertex_pointer(2, GL_FLOAT, 0, Pointer::Offset(0));
    for frame in 0..3u8 {
        gl.buffer_data(GL_ARRAY_BUFFER, 24, Some(&[frame; 24]), GL_STREAM_DRAW);
        gl.draw_arrays(GL_TRIANGLES, 0, 3);
        gl.draw_arrays(GL_TRIANGLES, 0, 3);
        gl.swap_buffers();
        let (frame, _) = recorder.0.lock().unwrap().pop().unwrap();
        assert!(frame.retained.is_empty() && !draws(&frame).is_empty());
    }
}

#[test]
fn a_range_that_is_not_drawn_for_long_is_forgotten() {
    let (mut gl, recorder) = context();
    gl.bind_buffer(GL_ARRAY_BUFFER, 1);
    gl.buffer_data(GL_ARRAY_BUFFER, 24, None, GL_STATIC_DRAW);
    gl.enable_client_state(GL_VERTEX_ARRAY);
    gl.vertex_pointer(2, GL_FLOAT, 0, Pointer::Offset(0));
    let mut range = std::sync::Weak::new();
    for frame in 0..1000 {
        if frame < 2 {
            gl.draw_arrays(GL_TRIANGLES, 0, 3);
        }
        gl.swap_buffers();
        let (handed_over, _) = recorder.0.lock().unwrap().pop().unwrap();
        if frame == 1 {
            range = Arc::downgrade(&handed_over.retained[0]);
        }
        assert!(frame != 100 || range.upgrade().is_some());
    }
    assert!(range.upgrade().is_none());
}

#[test]
fn a_late_attribute_leaves_the_vertices_before_all_of_their_value() {
    let primitive = |gl: &mut Context| {
        gl.begin(GL_TRIANGLES);
        gl.vertex([0.0, 0.0, 0.0, 1.0]);
        gl.color([0.0, 1.0, 0.0, 1.0]);
        gl.vertex([1.0, 0.0, 0.0, 1.0]);
        gl.vertex([0.0, 1.0, 0.0, 1.0]);
        gl.end();
    };
    let drawn = frame(|gl| {
        gl.color([1.0, 1.0, 1.0, 0.25]);
        primitive(gl);
    });
    let called = frame(|gl| {
        gl.new_list(1, GL_COMPILE);
        primitive(gl);
        gl.end_list();
        gl.color([1.0, 1.0, 1.0, 0.25]);
        gl.call_list(1);
    });
    for frame in [drawn, called] {
        let draw = draws(&frame)[0];
        assert_eq!(attribute(&frame, draw, 0, Slot::Color), [1.0, 1.0, 1.0, 0.25]);
        assert_eq!(attribute(&frame, draw, 1, Slot::Color), [0.0, 1.0, 0.0, 1.0]);
    }
}

#[test]
fn edge_flags_and_indices_wait_in_lists() {
    let (mut gl, _) = context();
    gl.new_list(1, GL_COMPILE);
    gl.edge_flag(false);
    gl.index(7.0);
    gl.end_list();
    assert_eq!((gl.get_boolean(GL_EDGE_FLAG), gl.get_float(GL_CURRENT_INDEX)), (vec![true], vec![1.0]));
    gl.call_list(1);
    assert_eq!((gl.get_boolean(GL_EDGE_FLAG), gl.get_float(GL_CURRENT_INDEX)), (vec![false], vec![7.0]));
}

#[test]
fn a_name_that_another_context_gave_a_new_object_is_bound_anew() {
    let (mut gl, _) = context();
    let mut other = Context::new(Box::<Recorder>::default(), gl.shared_names());
    for context in [&mut gl, &mut other] {
        context.bind_buffer(GL_ARRAY_BUFFER, 1);
        context.bind_texture(GL_TEXTURE_2D, 1);
    }
    other.delete_buffers(&[1]);
    other.delete_textures(&[1]);
    other.bind_buffer(GL_ARRAY_BUFFER, 1);
    other.buffer_data(GL_ARRAY_BUFFER, 12, None, GL_STATIC_DRAW);
    other.bind_texture(GL_TEXTURE_2D, 1);
    other.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, Params::Ints(&[GL_CLAMP as i32]));
    let wrap = |gl: &mut Context| gl.get_tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S).unwrap().floats();
    let size = |gl: &mut Context| gl.get_buffer_parameter(GL_ARRAY_BUFFER, GL_BUFFER_SIZE);
    assert_eq!((size(&mut gl), wrap(&mut gl)), (Some(0), vec![GL_REPEAT as f32]));
    gl.bind_buffer(GL_ARRAY_BUFFER, 1);
    gl.bind_texture(GL_TEXTURE_2D, 1);
    assert_eq!((size(&mut gl), wrap(&mut gl)), (Some(12), vec![GL_CLAMP as f32]));
}

#[test]
fn mapped_buffers_change_when_they_are_unmapped() {
    let (mut gl, _) = context();
    let names = gl.gen_buffers(1);
    gl.bind_buffer(GL_ARRAY_BUFFER, names[0]);
    gl.buffer_data(GL_ARRAY_BUFFER, 4, None, GL_STREAM_DRAW);
    assert!(gl.map_buffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY));
    gl.mapped_buffer(GL_ARRAY_BUFFER).unwrap().lock().data.copy_from_slice(&[1, 2, 3, 4]);
    gl.buffer_sub_data(GL_ARRAY_BUFFER, 0, &[9]);
    assert_eq!(gl.get_error(), GL_INVALID_OPERATION);
    assert!(gl.unmap_buffer(GL_ARRAY_BUFFER));
    assert_eq!(gl.get_buffer_sub_data(GL_ARRAY_BUFFER, 1, 2), [2, 3]);
    assert!(!gl.unmap_buffer(GL_ARRAY_BUFFER));
    assert_eq!(gl.get_error(), GL_INVALID_OPERATION);
}

#[test]
fn a_texture_changed_between_two_draws_is_uploaded_between_them() {
    let frame = frame(|gl| {
        let definition = ImageDefinition { level: 0, internal_format: GL_RGBA, size: [1, 1, 1], border: 0 };
        gl.bind_texture(GL_TEXTURE_2D, 7);
        gl.tex_parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, Params::Ints(&[GL_NEAREST as i32]));
        gl.tex_image((GL_TEXTURE_2D, 2), definition, (GL_RGBA, GL_UNSIGNED_BYTE), Some(&[1, 2, 3, 4]));
        gl.enable(GL_TEXTURE_2D);
        triangle(gl);
        let part = SubImage { level: 0, offset: [0; 3], size: [1; 3] };
        gl.tex_sub_image((GL_TEXTURE_2D, 2), part, (GL_RGBA, GL_UNSIGNED_BYTE), &[5, 6, 7, 8]);
        triangle(gl);
    });
    let kinds: Vec<char> = frame
        .operations
        .iter()
        .filter_map(|operation| match operation {
            Operation::Draw(_) => Some('d'),
            Operation::Upload(_) => Some('u'),
            Operation::DefineImage { .. } => Some('i'),
            _ => None,
        })
        .collect();
    assert_eq!(kinds, ['i', 'u', 'd', 'u', 'd']);
}

#[test]
fn incomplete_textures_turn_their_unit_off() {
    let frame = frame(|gl| {
        gl.bind_texture(GL_TEXTURE_2D, 7);
        gl.enable(GL_TEXTURE_2D);
        triangle(gl);
    });
    let draw = draws(&frame)[0];
    assert_eq!(frame.fixed[draw.fixed as usize].words.units[0].target(), 0);
    assert_eq!(frame.bindings[draw.bindings as usize][0], None);
}

#[test]
fn attribute_groups_come_back() {
    let (mut gl, _) = context();
    gl.enable(GL_LIGHTING);
    gl.push_attrib(GL_ENABLE_BIT | GL_DEPTH_BUFFER_BIT | GL_CURRENT_BIT);
    gl.disable(GL_LIGHTING);
    gl.depth_func(GL_ALWAYS);
    gl.color([0.0; 4]);
    gl.line_width(5.0);
    gl.pop_attrib();
    assert!(gl.is_enabled(GL_LIGHTING));
    assert_eq!(gl.get_integer(GL_DEPTH_FUNC), [GL_LESS as i32]);
    assert_eq!(gl.get_float(GL_CURRENT_COLOR), [1.0; 4]);
    assert_eq!(gl.get_float(GL_LINE_WIDTH), [5.0]);
    gl.pop_attrib();
    assert_eq!(gl.get_error(), GL_STACK_UNDERFLOW);
}

#[test]
fn errors_are_those_of_the_specification() {
    let (mut gl, _) = context();
    let mut expect = |call: &mut dyn FnMut(&mut Context), error: u32| {
        call(&mut gl);
        assert_eq!(gl.get_error(), error);
        assert_eq!(gl.get_error(), GL_NO_ERROR);
    };
    expect(&mut |gl| gl.begin(GL_POLYGON + 1), GL_INVALID_ENUM);
    expect(&mut |gl| gl.end(), GL_INVALID_OPERATION);
    expect(&mut |gl| gl.enable(0x1234), GL_INVALID_ENUM);
    expect(&mut |gl| gl.viewport(0, 0, -1, 1), GL_INVALID_VALUE);
    expect(&mut |gl| gl.pop_matrix(), GL_STACK_UNDERFLOW);
    expect(&mut |gl| (0..100).for_each(|_| gl.push_matrix()), GL_STACK_OVERFLOW);
    expect(&mut |gl| gl.material(GL_FRONT, GL_SHININESS, Params::Floats(&[1000.0])), GL_INVALID_VALUE);
    expect(&mut |gl| gl.light(GL_LIGHT0, GL_SPOT_CUTOFF, Params::Floats(&[100.0])), GL_INVALID_VALUE);
    expect(&mut |gl| gl.new_list(0, GL_COMPILE), GL_INVALID_VALUE);
    expect(&mut |gl| drop(gl.get_float(0xdead)), GL_INVALID_ENUM);
    expect(
        &mut |gl| {
            gl.begin(GL_POINTS);
            gl.matrix_mode(GL_PROJECTION);
            gl.end();
        },
        GL_INVALID_OPERATION,
    );
}

#[test]
fn unfilled_quads_are_lines_without_the_diagonal() {
    let frame = frame(|gl| {
        gl.polygon_mode(GL_FRONT_AND_BACK, GL_LINE);
        gl.begin(GL_QUADS);
        for corner in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            gl.vertex([corner[0], corner[1], 0.0, 1.0]);
        }
        gl.end();
    });
    let draw = draws(&frame)[0];
    assert_eq!((draw.topology, draw.index_count), (Topology::Lines, 8));
}

#[test]
fn a_read_back_hands_over_what_was_drawn_before() {
    let (mut gl, recorder) = context();
    triangle(&mut gl);
    let mut pixels = [7; 16];
    gl.read_pixels(0, 0, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, &mut pixels);
    triangle(&mut gl);
    gl.swap_buffers();
    let frames = recorder.0.lock().unwrap();
    assert_eq!(
        frames.iter().map(|(frame, end)| (draws(frame).len(), *end)).collect::<Vec<_>>(),
        [(1, End::Continued), (1, End::Swap)]
    );
}

#[test]
fn lists_that_grow_beyond_all_bounds_end() {
    let mut gl = Context::new(Box::new(afterglow_gl::backend::NullBackend), Default::default());
    gl.set_drawable(8, 8);
    for list in 1..=40 {
        gl.new_list(list, GL_COMPILE);
        gl.color([1.0; 4]);
        if list > 1 {
            gl.call_list(list - 1);
            gl.call_list(list - 1);
        }
        gl.end_list();
    }
    gl.call_list(40);
    assert_eq!(gl.get_error(), GL_OUT_OF_MEMORY);
    gl.call_list(10);
    assert_eq!(gl.get_error(), GL_NO_ERROR);
}
