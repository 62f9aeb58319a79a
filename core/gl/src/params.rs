//! Parameters of commands with scalar, vector, float and integer forms, owned and of fixed size.

use afterglow_api::constants::*;

use crate::context::Params;

/// At most four values, with what the integer forms need: colours are normalised, the rest is not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Values {
    count: u8,
    floats: [f32; 4],
    ints: Option<[i32; 4]>,
}

impl Values {
    /// The first four of `params`.
    pub fn new(params: Params) -> Values {
        let mut values = Values { count: 0, floats: [0.0; 4], ints: None };
        match params {
            Params::Floats(floats) => {
                values.count = floats.len().min(4) as u8;
                values.floats[..values.count as usize].copy_from_slice(&floats[..values.count as usize]);
            }
            Params::Ints(given) => {
                values.count = given.len().min(4) as u8;
                let mut ints = [0; 4];
                ints[..values.count as usize].copy_from_slice(&given[..values.count as usize]);
                values.ints = Some(ints);
                values.floats = ints.map(|i| i as f32);
            }
        }
        values
    }

    /// How many values there are.
    pub fn count(&self) -> usize {
        self.count as usize
    }

    /// The first as a float.
    pub fn float(&self) -> f32 {
        self.floats[0]
    }

    /// The first as an integer; floats are rounded (specification 2.8.1 of glTexParameter and the like).
    pub fn int(&self) -> i32 {
        self.ints.map_or_else(|| self.floats[0].round() as i32, |ints| ints[0])
    }

    /// The first as an enumerant; no enumerant is negative, so such a value names none.
    pub fn enumerant(&self) -> u32 {
        self.int() as u32
    }

    /// The floats, integers converted as they are.
    pub fn floats(&self) -> [f32; 4] {
        self.floats
    }

    /// The floats, integers mapped so that the greatest becomes 1 and the least -1.
    pub fn color(&self) -> [f32; 4] {
        self.ints.map_or(self.floats, |ints| {
            ints.map(|i| ((2.0 * f64::from(i) + 1.0) / f64::from(u32::MAX)) as f32)
        })
    }
}

/// How many values the vector form of glLight, glMaterial, glFog, glTexEnv and the like takes for a parameter.
pub fn parameter_values(pname: u32) -> usize {
    match pname {
        GL_AMBIENT
        | GL_DIFFUSE
        | GL_SPECULAR
        | GL_POSITION
        | GL_EMISSION
        | GL_AMBIENT_AND_DIFFUSE
        | GL_LIGHT_MODEL_AMBIENT
        | GL_FOG_COLOR
        | GL_TEXTURE_ENV_COLOR
        | GL_TEXTURE_BORDER_COLOR
        | GL_OBJECT_PLANE
        | GL_EYE_PLANE => 4,
        GL_SPOT_DIRECTION | GL_COLOR_INDEXES | GL_POINT_DISTANCE_ATTENUATION => 3,
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_have_four_values() {
        assert_eq!(parameter_values(GL_FOG_COLOR), 4);
        assert_eq!(parameter_values(GL_SPOT_DIRECTION), 3);
        assert_eq!(parameter_values(GL_SHININESS), 1);
        assert_eq!(parameter_values(0), 1);
    }
}
