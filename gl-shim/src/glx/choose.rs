//! Which configurations serve a program, and in which order (GLX 1.4 specification, 3.3.3, table 3.4).

use std::cmp::Reverse;

use afterglow_api::constants::glx::*;

use super::attributes::{Attribute, value};
use super::config::Config;

const DONT_CARE: i32 = GLX_DONT_CARE as i32;

/// How an attribute's value decides.
#[derive(Clone, Copy)]
enum Rule {
    /// The configuration has at least so much.
    AtLeast,
    /// It has exactly this.
    Exact,
    /// It has at least these bits.
    Mask,
    /// It does not decide.
    Ignored,
}

/// Attributes that glXChooseFBConfig knows, how they decide, and their values where a program gives none.
const CRITERIA: &[(u32, Rule, i32)] = &[
    (GLX_FBCONFIG_ID, Rule::Exact, DONT_CARE),
    (GLX_BUFFER_SIZE, Rule::AtLeast, 0),
    (GLX_LEVEL, Rule::Exact, 0),
    (GLX_DOUBLEBUFFER, Rule::Exact, DONT_CARE),
    (GLX_STEREO, Rule::Exact, 0),
    (GLX_AUX_BUFFERS, Rule::AtLeast, 0),
    (GLX_RED_SIZE, Rule::AtLeast, 0),
    (GLX_GREEN_SIZE, Rule::AtLeast, 0),
    (GLX_BLUE_SIZE, Rule::AtLeast, 0),
    (GLX_ALPHA_SIZE, Rule::AtLeast, 0),
    (GLX_DEPTH_SIZE, Rule::AtLeast, 0),
    (GLX_STENCIL_SIZE, Rule::AtLeast, 0),
    (GLX_ACCUM_RED_SIZE, Rule::AtLeast, 0),
    (GLX_ACCUM_GREEN_SIZE, Rule::AtLeast, 0),
    (GLX_ACCUM_BLUE_SIZE, Rule::AtLeast, 0),
    (GLX_ACCUM_ALPHA_SIZE, Rule::AtLeast, 0),
    (GLX_SAMPLE_BUFFERS, Rule::AtLeast, 0),
    (GLX_SAMPLES, Rule::AtLeast, 0),
    (GLX_RENDER_TYPE, Rule::Mask, GLX_RGBA_BIT as i32),
    (GLX_DRAWABLE_TYPE, Rule::Mask, GLX_WINDOW_BIT as i32),
    (GLX_X_RENDERABLE, Rule::Exact, DONT_CARE),
    (GLX_X_VISUAL_TYPE, Rule::Exact, DONT_CARE),
    (GLX_CONFIG_CAVEAT, Rule::Exact, DONT_CARE),
    (GLX_TRANSPARENT_TYPE, Rule::Exact, GLX_NONE as i32),
    (GLX_TRANSPARENT_INDEX_VALUE, Rule::Ignored, DONT_CARE),
    (GLX_TRANSPARENT_RED_VALUE, Rule::Ignored, DONT_CARE),
    (GLX_TRANSPARENT_GREEN_VALUE, Rule::Ignored, DONT_CARE),
    (GLX_TRANSPARENT_BLUE_VALUE, Rule::Ignored, DONT_CARE),
    (GLX_TRANSPARENT_ALPHA_VALUE, Rule::Ignored, DONT_CARE),
    (GLX_MAX_PBUFFER_WIDTH, Rule::Ignored, DONT_CARE),
    (GLX_MAX_PBUFFER_HEIGHT, Rule::Ignored, DONT_CARE),
    (GLX_MAX_PBUFFER_PIXELS, Rule::Ignored, DONT_CARE),
    (GLX_VISUAL_ID, Rule::Ignored, DONT_CARE),
    (GLX_SCREEN, Rule::Ignored, DONT_CARE),
    (GLX_FRAMEBUFFER_SRGB_CAPABLE_ARB, Rule::Exact, DONT_CARE),
    (GLX_BIND_TO_TEXTURE_RGB_EXT, Rule::Exact, DONT_CARE),
    (GLX_BIND_TO_TEXTURE_RGBA_EXT, Rule::Exact, DONT_CARE),
    (GLX_SWAP_METHOD_OML, Rule::Ignored, DONT_CARE),
];

/// Attributes of glXChooseVisual that have no value in its list.
pub const VISUAL_FLAGS: &[u32] = &[GLX_USE_GL, GLX_RGBA, GLX_DOUBLEBUFFER, GLX_STEREO];

/// The configurations that serve, best first. Attributes that are unknown do not decide: programs give GLX_RGBA here.
pub fn configs<'a>(table: &'a [Config], wanted: &[Attribute]) -> Vec<&'a Config> {
    if let Some(id) = value(wanted, GLX_FBCONFIG_ID).filter(|id| *id != DONT_CARE) {
        return table.iter().filter(|config| config.id == id).collect();
    }
    let mut found: Vec<_> = table.iter().filter(|config| serves(config, wanted)).collect();
    found.sort_by_key(|config| order(config, wanted, false));
    found
}

/// The best configuration for glXChooseVisual.
pub fn visual<'a>(table: &'a [Config], wanted: &[Attribute]) -> Option<&'a Config> {
    let has = |flag| value(wanted, flag).is_some();
    // Colour indices are not drawn.
    if !has(GLX_RGBA) {
        return None;
    }
    let mut rules: Vec<_> = wanted
        .iter()
        // A size of the colour index: of no meaning with RGBA.
        .filter(|(attribute, _)| ![GLX_USE_GL, GLX_RGBA, GLX_BUFFER_SIZE].contains(attribute))
        .copied()
        .collect();
    if !has(GLX_DOUBLEBUFFER) {
        rules.push((GLX_DOUBLEBUFFER, 0));
    }
    if rules.iter().any(|(attribute, _)| !CRITERIA.iter().any(|(known, ..)| known == attribute)) {
        return None;
    }
    let found = table.iter().filter(|config| serves(config, &rules));
    // Where no depth buffer is asked for, the smallest is preferred.
    let less_depth = value(wanted, GLX_DEPTH_SIZE).unwrap_or(0) == 0;
    found.min_by_key(|config| order(config, &rules, less_depth))
}

fn serves(config: &Config, wanted: &[Attribute]) -> bool {
    CRITERIA.iter().all(|&(attribute, rule, default)| {
        let wanted = value(wanted, attribute).unwrap_or(default);
        let has = config.get(attribute).unwrap_or(0);
        match rule {
            _ if wanted == DONT_CARE && attribute != GLX_LEVEL => true,
            Rule::AtLeast => has >= wanted,
            Rule::Exact => has == wanted,
            Rule::Mask => has & wanted == wanted,
            Rule::Ignored => true,
        }
    })
}

/// Sorts a screen's whole table as if nothing was asked for.
pub fn sort_table(table: &mut [Config]) {
    table.sort_by_key(|config| order(config, &[], false));
}

/// The specification's sorting rules, in their order. What is equal keeps the order of the visuals.
fn order(config: &Config, wanted: &[Attribute], less_depth: bool) -> impl Ord + use<> {
    let get = |attribute| config.get(attribute).unwrap_or(0);
    // Components that are not asked for do not count.
    let bits = |attributes: [u32; 4]| -> i32 {
        let is_asked = |a: &u32| value(wanted, *a).is_some_and(|value| value != 0 && value != DONT_CARE);
        attributes.into_iter().filter(is_asked).map(get).sum()
    };
    let caveat = match get(GLX_CONFIG_CAVEAT) as u32 {
        GLX_NONE => 0,
        GLX_SLOW_CONFIG => 1,
        _ => 2,
    };
    let depth = get(GLX_DEPTH_SIZE);
    (
        caveat,
        Reverse(bits([GLX_RED_SIZE, GLX_GREEN_SIZE, GLX_BLUE_SIZE, GLX_ALPHA_SIZE])),
        get(GLX_BUFFER_SIZE),
        get(GLX_DOUBLEBUFFER),
        get(GLX_AUX_BUFFERS),
        get(GLX_SAMPLE_BUFFERS),
        get(GLX_SAMPLES),
        if less_depth { depth } else { -depth },
        get(GLX_STENCIL_SIZE),
        Reverse(bits([GLX_ACCUM_RED_SIZE, GLX_ACCUM_GREEN_SIZE, GLX_ACCUM_BLUE_SIZE, GLX_ACCUM_ALPHA_SIZE])),
    )
}

#[cfg(test)]
mod tests {
    use super::super::config::{Visual, all};
    use super::*;

    fn table() -> Vec<Config> {
        let mut table = all(0, &[Visual { id: 0x21, depth: 24 }, Visual { id: 0x40, depth: 32 }]);
        sort_table(&mut table);
        table
    }

    #[test]
    fn nothing_asked_finds_all_single_buffered_first() {
        let table = table();
        let found = configs(&table, &[]);
        assert_eq!(found.len(), table.len());
        assert!(!found[0].is_double && found[0].depth == 24 && found[0].stencil == 0);
        assert_eq!(found[0].visual.id, 0x21);
        let first_double = found.iter().position(|config| config.is_double).unwrap();
        assert!(found[first_double..].iter().all(|config| config.is_double));
    }

    #[test]
    fn what_is_asked_for_is_there() {
        let table = table();
        let wanted =
            [(GLX_DOUBLEBUFFER, 1), (GLX_DEPTH_SIZE, 16), (GLX_STENCIL_SIZE, 1), (GLX_ALPHA_SIZE, 1)];
        let found = configs(&table, &wanted);
        assert!(found.iter().all(|c| c.is_double && c.depth == 24 && c.stencil == 8));
        assert_eq!(found.len(), 4);
        assert_eq!(found[0].visual.depth, 24);
        let accumulating = configs(&table, &[(GLX_ACCUM_RED_SIZE, 16)]);
        assert!(!accumulating.is_empty() && accumulating.iter().all(|c| c.accum == 16));
    }

    #[test]
    fn what_nobody_has_finds_nothing() {
        let table = table();
        for wanted in [
            (GLX_SAMPLES, 4),
            (GLX_SAMPLE_BUFFERS, 1),
            (GLX_STEREO, 1),
            (GLX_LEVEL, 1),
            (GLX_LEVEL, DONT_CARE),
            (GLX_DEPTH_SIZE, 32),
            (GLX_RENDER_TYPE, GLX_COLOR_INDEX_BIT as i32),
            (GLX_X_VISUAL_TYPE, GLX_PSEUDO_COLOR as i32),
            (GLX_FRAMEBUFFER_SRGB_CAPABLE_ARB, 1),
            (GLX_BIND_TO_TEXTURE_RGB_EXT, 1),
            (GLX_FBCONFIG_ID, 1),
        ] {
            assert!(configs(&table, &[wanted]).is_empty(), "{wanted:x?}");
        }
    }

    #[test]
    fn an_id_overrules_the_rest() {
        let table = table();
        let id = table[7].id;
        assert_eq!(configs(&table, &[(GLX_SAMPLES, 4), (GLX_FBCONFIG_ID, id)]), [&table[7]]);
    }

    #[test]
    fn visuals() {
        let table = table();
        assert_eq!(visual(&table, &[(GLX_DOUBLEBUFFER, 1)]), None);
        assert_eq!(visual(&table, &[(GLX_RGBA, 1), (GLX_SAMPLES, 4)]), None);
        assert_eq!(visual(&table, &[(GLX_RGBA, 1), (0x7777, 4)]), None);
        let single = visual(&table, &[(GLX_USE_GL, 1), (GLX_RGBA, 1)]).unwrap();
        assert!(!single.is_double && single.depth == 0);
        let wanted = [
            (GLX_RGBA, 1),
            (GLX_DOUBLEBUFFER, 1),
            (GLX_DEPTH_SIZE, 1),
            (GLX_BUFFER_SIZE, 64),
            (GLX_RED_SIZE, 1),
        ];
        let double = visual(&table, &wanted).unwrap();
        assert!(double.is_double && double.depth == 24 && double.stencil == 0 && double.accum == 0);
        assert_eq!(double.visual.depth, 24);
    }
}
