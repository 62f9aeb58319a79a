//! What is known of each triangle, or of each draw that is known as a whole, by key.

use hashbrown::HashMap;

/// The cell of an entry that has none yet.
pub const NO_CELL: u32 = u32::MAX;

/// What is known under a key.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Its key.
    pub key: u64,
    /// The frame in which it was last drawn.
    pub drawn: u32,
    /// The cell that it is in, or [`NO_CELL`].
    pub cell: u32,
    /// Frames in which it was drawn before it was remembered; 0 marks an entry that is free.
    pub sightings: u8,
    /// Tests in a row that it failed: it should be visible.
    pub missing: u8,
    /// Whether the eye was before it (by the right-hand rule) when it was remembered.
    pub from_front: bool,
}

/// Entries by key and by number.
#[derive(Debug, Default)]
pub struct Entries {
    all: Vec<Entry>,
    free: Vec<u32>,
    numbers: HashMap<u64, u32>,
}

impl Entries {
    /// The number of a key, new or known.
    #[inline]
    pub fn number(&mut self, key: u64) -> u32 {
        let (all, free) = (&mut self.all, &mut self.free);
        *self.numbers.entry(key).or_insert_with(|| {
            let entry = Entry { key, drawn: 0, cell: NO_CELL, sightings: 0, missing: 0, from_front: true };
            match free.pop() {
                Some(number) => {
                    all[number as usize] = entry;
                    number
                }
                None => {
                    all.push(entry);
                    all.len() as u32 - 1
                }
            }
        })
    }

    /// Whether a key is known.
    pub fn has(&self, key: u64) -> bool {
        self.numbers.contains_key(&key)
    }

    /// Whether a key is known of something in a cell, or about to be.
    pub fn is_remembered(&self, key: u64) -> bool {
        let number = self.numbers.get(&key);
        number.is_some_and(|number| self.all[*number as usize].sightings >= super::notice::SIGHTINGS)
    }

    /// The entry of a number that was given.
    #[inline]
    pub fn get(&self, number: u32) -> &Entry {
        &self.all[number as usize]
    }

    /// Likewise.
    #[inline]
    pub fn get_mut(&mut self, number: u32) -> &mut Entry {
        &mut self.all[number as usize]
    }

    /// Forgets an entry; its number is given again.
    pub fn remove(&mut self, number: u32) {
        let entry = &mut self.all[number as usize];
        if self.numbers.remove(&entry.key).is_some() {
            entry.sightings = 0;
            entry.cell = NO_CELL;
            self.free.push(number);
        }
    }

    /// Forgets what was seen too seldom to be remembered and was not drawn since `frame`. Says whether anything was.
    pub fn remove_seldom(&mut self, frame: u32, is_seldom: impl Fn(&Entry) -> bool) -> bool {
        let numbers = 0..self.all.len() as u32;
        let gone: Vec<u32> = numbers
            .filter(|&number| {
                let entry = self.get(number);
                entry.sightings > 0 && entry.drawn < frame && is_seldom(entry)
            })
            .collect();
        gone.iter().for_each(|&number| self.remove(number));
        !gone.is_empty()
    }

    /// How many are known.
    pub fn len(&self) -> usize {
        self.numbers.len()
    }
}
