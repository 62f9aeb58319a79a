//! Floating-point numbers as C's `%g` writes them.

use std::fmt::{Display, Formatter, Result, Write};

/// A number with a number of significant digits: in plain or scientific notation, whichever is short, and without
/// trailing zeros (C99, section 7.19.6.1, conversion `g`).
pub(super) struct General {
    value: f64,
    digits: i32,
}

impl General {
    /// Seven digits, which tell nearly all floats apart.
    pub fn float(value: f32) -> Self {
        Self { value: value.into(), digits: f32::DIGITS as i32 + 1 }
    }

    /// Sixteen digits.
    pub fn double(value: f64) -> Self {
        Self { value, digits: f64::DIGITS as i32 + 1 }
    }
}

impl Display for General {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        if self.value.is_sign_negative() {
            f.write_str("-")?;
        }
        let magnitude = self.value.abs();
        if magnitude.is_nan() {
            return f.write_str("nan");
        }
        if magnitude.is_infinite() {
            return f.write_str("inf");
        }
        // Whole numbers are most of what old programs pass.
        if magnitude < 1e6 && magnitude.trunc() == magnitude {
            return (magnitude as u32).fmt(f);
        }
        let (digits, exponent) = scientific(magnitude, self.digits);
        match exponent {
            -4..0 => {
                f.write_str("0.")?;
                zeros(f, -exponent - 1)?;
                f.write_str(&digits)
            }
            _ if (0..self.digits).contains(&exponent) => plain(f, &digits, exponent as usize + 1),
            _ => {
                plain(f, &digits, 1)?;
                let sign = if exponent < 0 { '-' } else { '+' };
                write!(f, "e{sign}{:02}", exponent.abs())
            }
        }
    }
}

/// Significant digits of a number, without trailing zeros, and the decimal exponent of the first.
fn scientific(magnitude: f64, digits: i32) -> (String, i32) {
    let text = format!("{magnitude:.*e}", digits as usize - 1);
    // `{:e}` of a finite number always has an exponent.
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let mut significant = mantissa.replace('.', "");
    significant.truncate(significant.trim_end_matches('0').len());
    (significant, exponent.parse().unwrap_or(0))
}

/// Writes digits with the point after the first `whole` of them.
fn plain(f: &mut Formatter<'_>, digits: &str, whole: usize) -> Result {
    match digits.split_at_checked(whole) {
        Some((before, "")) => f.write_str(before),
        Some((before, after)) => write!(f, "{before}.{after}"),
        None => {
            f.write_str(digits)?;
            zeros(f, (whole - digits.len()) as i32)
        }
    }
}

fn zeros(f: &mut Formatter<'_>, count: i32) -> Result {
    (0..count).try_for_each(|_| f.write_char('0'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_have_seven_digits() {
        let cases = [
            (0.0, "0"),
            (-0.0, "-0"),
            (1.0, "1"),
            (3.65, "3.65"),
            (-1.595_466e-7, "-1.595466e-07"),
            (0.0001, "0.0001"),
            (0.00001, "1e-05"),
            (0.000_123_456_78, "0.0001234568"),
            (999_999.0, "999999"),
            (1_000_000.0, "1000000"),
            (9_999_999.0, "9999999"),
            (10_000_000.0, "1e+07"),
            (16_777_215.0, "1.677722e+07"),
            (1_234_500.0, "1234500"),
            (123_456.7, "123456.7"),
            (f32::MAX, "3.402823e+38"),
            (f32::from_bits(1), "1.401298e-45"),
            (f32::INFINITY, "inf"),
            (f32::NEG_INFINITY, "-inf"),
            (f32::NAN.abs(), "nan"),
        ];
        for (value, text) in cases {
            assert_eq!(General::float(value).to_string(), text);
        }
    }

    #[test]
    fn doubles_have_sixteen_digits() {
        let cases = [
            (0.1, "0.1"),
            (1.0 / 3.0, "0.3333333333333333"),
            (1e16, "1e+16"),
            (1e15, "1000000000000000"),
            (1e100, "1e+100"),
            (2.5e-300, "2.5e-300"),
        ];
        for (value, text) in cases {
            assert_eq!(General::double(value).to_string(), text);
        }
    }
}
