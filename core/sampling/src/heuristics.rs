//! How techniques that find the same light share it: the twin of `sampling.glsl`, third part.
//!
//! Multiple importance sampling (Veach and Guibas, Optimally Combining Sampling Techniques, 1995): the weight of a
//! sample found by one technique with density `own` where another finds it with density `other`. Weights of the two
//! add up to 1; 0 where neither finds it. Densities are not negative and at most 1e30.

/// Densities below this count as none: devices may flush them to 0.
pub const LEAST_DENSITY: f32 = f32::MIN_POSITIVE;

/// The balance heuristic.
pub fn balance(own: f32, other: f32) -> f32 {
    let sum = own + other;
    if sum >= LEAST_DENSITY { own / sum } else { 0.0 }
}

/// The power heuristic with exponent 2; of ratios, since squares of densities overflow.
pub fn power_heuristic(own: f32, other: f32) -> f32 {
    let greater = own.max(other);
    if greater < LEAST_DENSITY {
        return 0.0;
    }
    let own_share = own / greater;
    let other_share = other / greater;
    own_share * own_share / (own_share * own_share + other_share * other_share)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DENSITIES: [f32; 11] = [0.0, 1e-45, 1e-39, 2e-38, 1e-30, 1e-5, 0.3, 1.0, 7e4, 1.6e8, 1e30];

    #[test]
    fn weights_of_both_techniques_add_up_to_one() {
        for heuristic in [balance, power_heuristic] {
            for own in DENSITIES {
                for other in DENSITIES {
                    let sum = heuristic(own, other) + heuristic(other, own);
                    let expected = if own + other < LEAST_DENSITY { 0.0 } else { 1.0 };
                    assert!((sum - expected).abs() < 2e-7, "{own} {other}: {sum}");
                }
            }
        }
    }

    #[test]
    fn the_values_are_the_definitions() {
        assert_eq!((balance(0.0, 0.0), power_heuristic(0.0, 0.0)), (0.0, 0.0));
        assert_eq!((balance(3.0, 1.0), power_heuristic(3.0, 1.0)), (0.75, 0.9));
        assert_eq!((balance(0.0, 5.0), power_heuristic(0.0, 1e30)), (0.0, 0.0));
        assert_eq!((balance(1e30, 1.0), power_heuristic(1e30, 1e-30)), (1.0, 1.0));
    }
}
