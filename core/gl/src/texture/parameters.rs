//! glTexParameter (specification, table 3.19).

use afterglow_api::constants::*;

use crate::get::Value;
use crate::params::Values;
use crate::pixel::GlResult;

/// GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT.
pub const MAX_ANISOTROPY: f32 = 16.0;
/// GL_MAX_TEXTURE_LOD_BIAS.
pub const MAX_LOD_BIAS: f32 = 16.0;

/// Parameters of a texture object, by OpenGL's numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameters {
    /// GL_TEXTURE_MIN_FILTER.
    pub min_filter: u32,
    /// GL_TEXTURE_MAG_FILTER.
    pub mag_filter: u32,
    /// GL_TEXTURE_WRAP_S, T, R.
    pub wrap: [u32; 3],
    /// GL_TEXTURE_BORDER_COLOR, between 0 and 1.
    pub border_color: [f32; 4],
    /// GL_TEXTURE_PRIORITY, between 0 and 1.
    pub priority: f32,
    /// GL_TEXTURE_MIN_LOD.
    pub min_lod: f32,
    /// GL_TEXTURE_MAX_LOD.
    pub max_lod: f32,
    /// GL_TEXTURE_BASE_LEVEL.
    pub base_level: usize,
    /// GL_TEXTURE_MAX_LEVEL.
    pub max_level: usize,
    /// GL_TEXTURE_LOD_BIAS.
    pub lod_bias: f32,
    /// GL_GENERATE_MIPMAP.
    pub generate_mipmap: bool,
    /// GL_TEXTURE_COMPARE_MODE is GL_COMPARE_R_TO_TEXTURE.
    pub compare: bool,
    /// GL_TEXTURE_COMPARE_FUNC.
    pub compare_func: u32,
    /// GL_DEPTH_TEXTURE_MODE.
    pub depth_mode: u32,
    /// GL_TEXTURE_MAX_ANISOTROPY_EXT, at least 1.
    pub anisotropy: f32,
}

impl Default for Parameters {
    fn default() -> Self {
        Parameters {
            min_filter: GL_NEAREST_MIPMAP_LINEAR,
            mag_filter: GL_LINEAR,
            wrap: [GL_REPEAT; 3],
            border_color: [0.0; 4],
            priority: 1.0,
            min_lod: -1000.0,
            max_lod: 1000.0,
            base_level: 0,
            max_level: 1000,
            lod_bias: 0.0,
            generate_mipmap: false,
            compare: false,
            compare_func: GL_LEQUAL,
            depth_mode: GL_LUMINANCE,
            anisotropy: 1.0,
        }
    }
}

impl Parameters {
    /// glTexParameter.
    ///
    /// # Errors
    /// GL_INVALID_ENUM for an unknown name or enumerant, or a border colour that is no vector;
    /// GL_INVALID_VALUE for a number out of range.
    pub fn set(&mut self, pname: u32, values: &Values) -> GlResult<()> {
        let given = values.enumerant();
        let one_of = |allowed: &[u32]| allowed.contains(&given).then_some(given).ok_or(GL_INVALID_ENUM);
        match pname {
            GL_TEXTURE_MIN_FILTER => self.min_filter = one_of(&MIN_FILTERS)?,
            GL_TEXTURE_MAG_FILTER => self.mag_filter = one_of(&MIN_FILTERS[..2])?,
            GL_TEXTURE_WRAP_S => self.wrap[0] = one_of(&WRAPS)?,
            GL_TEXTURE_WRAP_T => self.wrap[1] = one_of(&WRAPS)?,
            GL_TEXTURE_WRAP_R => self.wrap[2] = one_of(&WRAPS)?,
            GL_TEXTURE_BORDER_COLOR if values.count() == 4 => {
                self.border_color = values.color().map(|component| component.clamp(0.0, 1.0));
            }
            GL_TEXTURE_PRIORITY => self.priority = values.float().clamp(0.0, 1.0),
            GL_TEXTURE_MIN_LOD => self.min_lod = values.float(),
            GL_TEXTURE_MAX_LOD => self.max_lod = values.float(),
            GL_TEXTURE_BASE_LEVEL => self.base_level = level(values)?,
            GL_TEXTURE_MAX_LEVEL => self.max_level = level(values)?,
            GL_TEXTURE_LOD_BIAS => self.lod_bias = values.float(),
            GL_GENERATE_MIPMAP => self.generate_mipmap = values.float() != 0.0,
            GL_TEXTURE_COMPARE_MODE => {
                self.compare = one_of(&[GL_NONE, GL_COMPARE_R_TO_TEXTURE])? != GL_NONE;
            }
            GL_TEXTURE_COMPARE_FUNC => match given {
                GL_NEVER..=GL_ALWAYS => self.compare_func = given,
                _ => return Err(GL_INVALID_ENUM),
            },
            GL_DEPTH_TEXTURE_MODE => self.depth_mode = one_of(&DEPTH_MODES)?,
            GL_TEXTURE_MAX_ANISOTROPY_EXT if values.float() >= 1.0 => self.anisotropy = values.float(),
            GL_TEXTURE_MAX_ANISOTROPY_EXT => return Err(GL_INVALID_VALUE),
            _ => return Err(GL_INVALID_ENUM),
        }
        Ok(())
    }

    /// glGetTexParameter; `None` for an unknown name.
    pub fn get(&self, pname: u32) -> Option<Value> {
        let name = |number: u32| Value::Ints(vec![number.into()]);
        let float = |value: f32| Value::Floats(vec![value.into()]);
        let level = |level: usize| Value::Ints(vec![level.try_into().unwrap_or(i64::MAX)]);
        Some(match pname {
            GL_TEXTURE_MIN_FILTER => name(self.min_filter),
            GL_TEXTURE_MAG_FILTER => name(self.mag_filter),
            GL_TEXTURE_WRAP_S => name(self.wrap[0]),
            GL_TEXTURE_WRAP_T => name(self.wrap[1]),
            GL_TEXTURE_WRAP_R => name(self.wrap[2]),
            GL_TEXTURE_BORDER_COLOR => Value::Fractions(self.border_color.map(f64::from).to_vec()),
            GL_TEXTURE_PRIORITY => Value::Fractions(vec![self.priority.into()]),
            GL_TEXTURE_RESIDENT => Value::Bools(vec![true]),
            GL_TEXTURE_MIN_LOD => float(self.min_lod),
            GL_TEXTURE_MAX_LOD => float(self.max_lod),
            GL_TEXTURE_BASE_LEVEL => level(self.base_level),
            GL_TEXTURE_MAX_LEVEL => level(self.max_level),
            GL_TEXTURE_LOD_BIAS => float(self.lod_bias),
            GL_GENERATE_MIPMAP => Value::Bools(vec![self.generate_mipmap]),
            GL_TEXTURE_COMPARE_MODE if self.compare => name(GL_COMPARE_R_TO_TEXTURE),
            GL_TEXTURE_COMPARE_MODE => name(GL_NONE),
            GL_TEXTURE_COMPARE_FUNC => name(self.compare_func),
            GL_DEPTH_TEXTURE_MODE => name(self.depth_mode),
            GL_TEXTURE_MAX_ANISOTROPY_EXT => float(self.anisotropy),
            _ => return None,
        })
    }

    /// Minification takes other levels than the base.
    pub fn mipmaps(&self) -> bool {
        !matches!(self.min_filter, GL_NEAREST | GL_LINEAR)
    }

    /// What decides which levels an image must have.
    pub(super) fn levels_key(&self) -> (bool, usize, usize, bool) {
        (self.mipmaps(), self.base_level, self.max_level, self.generate_mipmap)
    }
}

/// Filters; the first two are magnification's too.
const MIN_FILTERS: [u32; 6] = [
    GL_NEAREST,
    GL_LINEAR,
    GL_NEAREST_MIPMAP_NEAREST,
    GL_LINEAR_MIPMAP_NEAREST,
    GL_NEAREST_MIPMAP_LINEAR,
    GL_LINEAR_MIPMAP_LINEAR,
];

const WRAPS: [u32; 5] = [GL_CLAMP, GL_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER, GL_MIRRORED_REPEAT];

/// In the order of [`UnitWords::depth_mode`](crate::frame::UnitWords).
pub(super) const DEPTH_MODES: [u32; 3] = [GL_LUMINANCE, GL_INTENSITY, GL_ALPHA];

fn level(values: &Values) -> GlResult<usize> {
    usize::try_from(values.int()).map_err(|_| GL_INVALID_VALUE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::context::Params;

    fn set(parameters: &mut Parameters, pname: u32, value: i32) -> GlResult<()> {
        parameters.set(pname, &Values::new(Params::Ints(&[value])))
    }

    #[test]
    fn enumerants() {
        let mut parameters = Parameters::default();
        for (pname, good, bad) in [
            (GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST, GL_REPEAT),
            (GL_TEXTURE_MAG_FILTER, GL_NEAREST, GL_LINEAR_MIPMAP_NEAREST),
            (GL_TEXTURE_WRAP_R, GL_MIRRORED_REPEAT, GL_LINEAR),
            (GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE, GL_LEQUAL),
            (GL_TEXTURE_COMPARE_FUNC, GL_GREATER, GL_NONE),
            (GL_DEPTH_TEXTURE_MODE, GL_ALPHA, GL_RGB),
        ] {
            assert_eq!(set(&mut parameters, pname, bad as i32), Err(GL_INVALID_ENUM));
            assert_eq!(set(&mut parameters, pname, good as i32), Ok(()));
            assert_eq!(parameters.get(pname), Some(Value::Ints(vec![good.into()])));
        }
        assert_eq!(set(&mut parameters, GL_RGBA, 0), Err(GL_INVALID_ENUM));
        assert_eq!(set(&mut parameters, GL_TEXTURE_BORDER_COLOR, 0), Err(GL_INVALID_ENUM));
        assert_eq!(parameters.get(GL_RGBA), None);
    }

    #[test]
    fn numbers() {
        let mut parameters = Parameters::default();
        assert_eq!(set(&mut parameters, GL_TEXTURE_BASE_LEVEL, -1), Err(GL_INVALID_VALUE));
        assert_eq!(set(&mut parameters, GL_TEXTURE_MAX_ANISOTROPY_EXT, 0), Err(GL_INVALID_VALUE));
        let border = [i32::MAX, i32::MIN, 0, i32::MAX / 2];
        parameters.set(GL_TEXTURE_BORDER_COLOR, &Values::new(Params::Ints(&border))).unwrap();
        assert_eq!(parameters.border_color[..2], [1.0, 0.0]);
        assert!((parameters.border_color[3] - 0.5).abs() < 1e-6);
        set(&mut parameters, GL_TEXTURE_PRIORITY, 7).unwrap();
        assert_eq!(parameters.priority, 1.0);
    }
}
