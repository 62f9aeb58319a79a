//! What can be wrong with a declared frame.

use thiserror::Error;

use crate::{Access, AccessSet, PassKind};

/// Why a frame cannot be compiled. Passes and resources are given by name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum GraphError {
    #[error("pass '{pass}' uses resource {resource}, which this graph does not have")]
    UnknownResource { pass: String, resource: u32 },

    #[error("resource {resource}, named as an output, is not one of this graph")]
    UnknownOutput { resource: u32 },

    #[error("transient '{resource}' is an output, but ends with the frame")]
    TransientOutput { resource: String },

    #[error("resource '{resource}' has an empty or impossible size")]
    BadSize { resource: String },

    #[error("resource '{resource}' cannot be in the state {accesses:?}")]
    BadState { resource: String, accesses: AccessSet },

    #[error("history '{key}' is declared twice")]
    DuplicateHistory { key: String },

    #[error("pass '{pass}' reads '{resource}' by {access:?}, which writes")]
    ReadByWritingAccess { pass: String, resource: String, access: Access },

    #[error("pass '{pass}' writes '{resource}' by {access:?}, which only reads")]
    WriteByReadingAccess { pass: String, resource: String, access: Access },

    #[error("pass '{pass}' is of kind {kind:?} and has no stage for {access:?}")]
    WrongKind { pass: String, kind: PassKind, access: Access },

    #[error("pass '{pass}' uses '{resource}' by {access:?}, which is not for such a resource")]
    WrongResource { pass: String, resource: String, access: Access },

    #[error("pass '{pass}' uses '{resource}' in ways that exclude each other: {accesses:?}")]
    Conflict { pass: String, resource: String, accesses: AccessSet },

    #[error("pass '{pass}' reads '{resource}', which nothing has written")]
    NeverWritten { pass: String, resource: String },

    #[error(
        "pass '{pass}' reads '{resource}', which pass '{writer}' would have written, but that was not required: {reason}"
    )]
    WriterNotRequired { pass: String, resource: String, writer: String, reason: String },
}
