//! Phase 4: the order in which passes run.
//!
//! The order of declaration is kept: it is the program's own order of operations, and blending,
//! copies and read-backs depend on it. What remains is to prove that it is one, that is, that
//! everything has been written by the time it is read.

use crate::cull::Fate;
use crate::pass::Declared;
use crate::uses::{ResourceUse, Uses};
use crate::{GraphError, PassId};

/// The passes that run, in order.
pub(crate) fn live_passes(
    declared: &Declared,
    uses: &Uses,
    fates: &[Fate],
) -> Result<Vec<PassId>, GraphError> {
    let initial = declared.resources.iter().map(|resource| resource.initial);
    let mut defined: Vec<bool> = initial.map(|state| state.is_defined()).collect();
    let mut order = Vec::with_capacity(declared.passes.len());
    for index in (0..fates.len()).filter(|index| fates[*index] == Fate::Live) {
        let pass = PassId(index as u32);
        for used in uses.of(pass) {
            let defined = &mut defined[used.resource.index()];
            if used.reads && !*defined {
                return Err(undefined_read(declared, uses, fates, pass, used));
            }
            *defined |= used.writes;
        }
        order.push(pass);
    }
    Ok(order)
}

/// Says whether the contents are missing because their writer was declared as not required.
/// Culling for want of readers cannot be the cause, since here is a reader.
fn undefined_read(
    declared: &Declared,
    uses: &Uses,
    fates: &[Fate],
    reader: PassId,
    read: &ResourceUse,
) -> GraphError {
    let pass = declared.passes[reader.index()].name.to_string();
    let resource = declared.resources[read.resource.index()].name.to_string();
    let writes = |writer: &usize| {
        let mut uses = uses.of(PassId(*writer as u32)).iter();
        uses.any(|used| used.resource == read.resource && used.writes)
    };
    let writer = (0..reader.index())
        .rev()
        .filter(|writer| fates[*writer] == Fate::NotRequired)
        .find(writes)
        .map(|writer| &declared.passes[writer]);
    match writer {
        Some(writer) => GraphError::WriterNotRequired {
            pass,
            resource,
            writer: writer.name.to_string(),
            reason: writer.not_required.as_deref().unwrap_or_default().into(),
        },
        None => GraphError::NeverWritten { pass, resource },
    }
}

#[cfg(test)]
mod tests {
    use crate::{Access::*, GraphBuilder, GraphError, PassKind, ResourceDesc, ResourceState};

    const BUFFER: ResourceDesc = ResourceDesc::Buffer { bytes: 16 };

    #[test]
    fn transients_are_written_before_they_are_read() {
        let mut graph = GraphBuilder::new();
        let buffer = graph.transient("buffer", BUFFER);
        graph.pass("reader", PassKind::Compute).read(buffer, StorageReadCompute).side_effect();
        graph.pass("writer", PassKind::Compute).write(buffer, StorageWriteCompute).side_effect();
        let (pass, resource) = ("reader".into(), "buffer".into());
        let expected = GraphError::NeverWritten { pass, resource };
        assert_eq!(graph.compile().unwrap_err(), expected);
    }

    #[test]
    fn modifying_is_reading() {
        let mut graph = GraphBuilder::new();
        let buffer = graph.history("buffer", BUFFER, ResourceState::UNDEFINED);
        graph.output(buffer);
        graph.pass("accumulate", PassKind::Compute).read_write(buffer, StorageWriteCompute);
        let found = graph.compile().unwrap_err();
        assert!(matches!(found, GraphError::NeverWritten { .. }), "{found}");
    }

    #[test]
    fn a_reader_of_what_was_not_required_is_told_so() {
        let mut graph = GraphBuilder::new();
        let buffer = graph.transient("sun-light", BUFFER);
        graph.pass("sun", PassKind::Compute).write(buffer, StorageWriteCompute).when(false, "no sun");
        graph.pass("composite", PassKind::Compute).read(buffer, StorageReadCompute).side_effect();
        let expected = GraphError::WriterNotRequired {
            pass: "composite".into(),
            resource: "sun-light".into(),
            writer: "sun".into(),
            reason: "no sun".into(),
        };
        assert_eq!(graph.compile().unwrap_err(), expected);
    }

    #[test]
    fn culled_readers_are_not_checked() {
        let mut graph = GraphBuilder::new();
        let buffer = graph.transient("buffer", BUFFER);
        graph.pass("reader", PassKind::Compute).read(buffer, StorageReadCompute);
        assert!(graph.compile().is_ok());
    }
}
