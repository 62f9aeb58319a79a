//! What builders refuse.

/// Input that no structure can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuildError {
    /// References are 29-bit counts of 16 bytes.
    #[error("{count} primitives in one structure, more than the {limit} that references reach")]
    TooMany {
        /// How many were given.
        count: usize,
        /// How many fit.
        limit: usize,
    },
    /// Attributes are given for each triangle, and each sphere, or not at all.
    #[error("{attributes} attributes for {primitives} triangles or spheres")]
    AttributeCount {
        /// Attributes given.
        attributes: usize,
        /// Triangles, or spheres, given.
        primitives: usize,
    },
}

/// Most primitives of one structure.
pub(crate) const MAX_PRIMITIVES: usize = 1 << 25;

/// Refuses what references cannot reach.
pub(crate) fn check_count(count: usize) -> Result<(), BuildError> {
    let limit = MAX_PRIMITIVES;
    if count > limit {
        return Err(BuildError::TooMany { count, limit });
    }
    Ok(())
}
