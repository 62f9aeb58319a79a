//! Choosing one of many by their weights in constant time (Walker 1977; Vose, A Linear Algorithm for Generating
//! Random Numbers with a Given Distribution, 1991).

/// One of the equally likely slots of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AliasSlot {
    /// Numbers below this mean the slot's own entry.
    pub threshold: f32,
    /// The entry that all others mean.
    pub alias: u32,
}

/// A table of at least one entry with a weight.
#[derive(Clone, Debug, PartialEq)]
pub struct AliasTable {
    slots: Vec<AliasSlot>,
}

impl AliasTable {
    /// A table of these weights, of any unit. Weights that are not positive and finite count as 0, and are never chosen; None
    /// if none is left, or if there are 2^32 and more.
    pub fn new(weights: &[f32]) -> Option<Self> {
        let sane = |weight: &f32| if weight.is_finite() && *weight > 0.0 { f64::from(*weight) } else { 0.0 };
        let weights: Vec<f64> = weights.iter().map(sane).collect();
        u32::try_from(weights.len()).ok()?;
        let total: f64 = weights.iter().sum();
        let heaviest = (0..weights.len()).max_by(|&a, &b| weights[a].total_cmp(&weights[b]))?;
        if total == 0.0 {
            return None;
        }
        // In units of a slot. What a slot does not fill itself is filled by an entry that has too much.
        let mut fill: Vec<f64> = weights.iter().map(|weight| weight / total * weights.len() as f64).collect();
        let (mut small, mut large): (Vec<usize>, Vec<usize>) = (0..fill.len()).partition(|&i| fill[i] < 1.0);
        // Of what rounding leaves over, an entry without weight must get nothing.
        let own = |i: usize| AliasSlot {
            threshold: if weights[i] > 0.0 { 1.0 } else { 0.0 },
            alias: if weights[i] > 0.0 { i as u32 } else { heaviest as u32 },
        };
        let mut slots: Vec<AliasSlot> = (0..fill.len()).map(own).collect();
        while let (Some(i), Some(&giver)) = (small.pop(), large.last()) {
            slots[i] = AliasSlot { threshold: fill[i] as f32, alias: giver as u32 };
            fill[giver] -= 1.0 - fill[i];
            if fill[giver] < 1.0 {
                large.pop();
                small.push(giver);
            }
        }
        Some(Self { slots })
    }

    /// The slots, at least one.
    pub fn slots(&self) -> &[AliasSlot] {
        &self.slots
    }

    /// The entry that a random word and a number in [0, 1) choose.
    pub fn sample(&self, word: u32, random: f32) -> u32 {
        // The upper half of a 64-bit product: less than the number of slots.
        let slot = (u64::from(word) * self.slots.len() as u64) >> 32;
        let AliasSlot { threshold, alias } = self.slots[slot as usize];
        if random < threshold { slot as u32 } else { alias }
    }

    /// The chance of each entry, as the table has it.
    pub fn probabilities(&self) -> Vec<f64> {
        let mut chances = vec![0.0; self.slots.len()];
        for (i, slot) in self.slots.iter().enumerate() {
            let threshold = f64::from(slot.threshold);
            chances[i] += threshold / self.slots.len() as f64;
            chances[slot.alias as usize] += (1.0 - threshold) / self.slots.len() as f64;
        }
        chances
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{independent, pcg4d};
    use crate::testing::assert_chi_square;
    use glam::UVec4;

    /// Weights over `decades`, every fifth of them 0.
    fn weights(count: u32, decades: f32) -> Vec<f32> {
        let weight = |i| if i % 5 == 4 { 0.0 } else { 10f32.powf(decades * independent(i, 0, 0, 3).x) };
        (0..count).map(weight).collect()
    }

    #[test]
    fn the_table_has_the_weights_in_it() {
        for (count, decades) in [(2, 1.0), (7, 2.0), (1000, 6.0), (70_000, 2.0)] {
            let weights = weights(count, decades);
            let table = AliasTable::new(&weights).unwrap();
            let total: f64 = weights.iter().copied().map(f64::from).sum();
            for (i, chance) in table.probabilities().into_iter().enumerate() {
                let expected = f64::from(weights[i]) / total;
                assert!(
                    (chance - expected).abs() < 1e-6 * expected.max(1.0 / f64::from(count)),
                    "{i}: {chance}"
                );
                assert_eq!(chance == 0.0, weights[i] == 0.0, "{i} of {count}");
            }
        }
    }

    #[test]
    fn draws_are_as_likely_as_they_should_be() {
        let weights = weights(300, 2.0);
        let total: f64 = weights.iter().copied().map(f64::from).sum();
        let table = AliasTable::new(&weights).unwrap();
        let mut counts = [0.0; 300];
        for i in 0..1_000_000 {
            let word = pcg4d(UVec4::new(i, 1, 2, 3)).x;
            counts[table.sample(word, independent(i, 4, 5, 6).y) as usize] += 1.0;
        }
        let expected: Vec<f64> = weights.iter().map(|&weight| f64::from(weight) / total * 1e6).collect();
        assert_chi_square(&counts, &expected, "draws");
        let never = counts.iter().zip(&weights).filter(|&(_, &weight)| weight == 0.0);
        assert!(never.into_iter().all(|(&count, _)| count == 0.0));
    }

    #[test]
    fn nothing_to_choose_from_is_no_table() {
        assert_eq!(AliasTable::new(&[]), None);
        assert_eq!(AliasTable::new(&[0.0, -1.0, f32::NAN, f32::INFINITY]), None);
    }

    #[test]
    fn one_entry_is_chosen_whatever_else_there_is() {
        let most = 1.0 - f32::EPSILON / 2.0;
        let mut hundred = vec![0.0; 100];
        hundred[37] = 1e-30;
        for (weights, only) in [(vec![3.0], 0), (vec![0.0, f32::NAN, 2.0], 2), (hundred, 37)] {
            let table = AliasTable::new(&weights).unwrap();
            for word in [0, 1, 1 << 31, u32::MAX] {
                for random in [0.0, 0.5, most] {
                    assert_eq!(table.sample(word, random), only);
                }
            }
        }
    }

    #[test]
    fn extreme_weights_keep_their_sum() {
        let table = AliasTable::new(&[f32::MAX, f32::MAX, 1e-45, f32::MAX]).unwrap();
        let chances = table.probabilities();
        assert!((chances.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert!((chances[0] - 1.0 / 3.0).abs() < 1e-6 && chances[2] < 1e-30, "{chances:?}");
    }
}
