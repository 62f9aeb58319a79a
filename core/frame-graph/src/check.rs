//! Phase 1: do the declared resources make sense by themselves?

use std::collections::HashSet;

use crate::pass::Declared;
use crate::resource::Resource;
use crate::{GraphError, Layout, Residence};

/// What the check finds out about each resource, in the order of declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct CheckedResource {
    /// Payload, without padding.
    pub bytes: u64,
    /// The layout in which the frame finds it.
    pub initial_layout: Layout,
    /// Its contents matter after the frame.
    pub is_output: bool,
}

/// Checks sizes, states, keys and outputs.
pub(crate) fn resources(declared: &Declared) -> Result<Vec<CheckedResource>, GraphError> {
    check_keys(&declared.resources)?;
    let mut checked = declared.resources.iter().map(check_resource).collect::<Result<Vec<_>, _>>()?;
    for output in &declared.outputs {
        let unknown = GraphError::UnknownOutput { resource: output.0 };
        let resource = declared.resources.get(output.index()).ok_or(unknown)?;
        if resource.residence == Residence::Transient {
            let resource = resource.name.to_string();
            return Err(GraphError::TransientOutput { resource });
        }
        checked[output.index()].is_output = true;
    }
    Ok(checked)
}

fn check_resource(resource: &Resource) -> Result<CheckedResource, GraphError> {
    let bytes =
        resource.desc.bytes().ok_or_else(|| GraphError::BadSize { resource: resource.name.to_string() })?;
    let initial_layout = resource.initial.layout(&resource.desc).ok_or_else(|| GraphError::BadState {
        resource: resource.name.to_string(),
        accesses: resource.initial.accesses(),
    })?;
    Ok(CheckedResource { bytes, initial_layout, is_output: false })
}

/// Two history resources of one key would be the same memory under two ids.
fn check_keys(resources: &[Resource]) -> Result<(), GraphError> {
    let mut keys = HashSet::new();
    let repeated = resources
        .iter()
        .filter(|resource| resource.residence == Residence::History)
        .find(|resource| !keys.insert(&resource.name));
    match repeated {
        Some(resource) => Err(GraphError::DuplicateHistory { key: resource.name.to_string() }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use crate::{Access, Format, GraphBuilder, GraphError, ImageDesc, ResourceDesc, ResourceState};

    const BUFFER: ResourceDesc = ResourceDesc::Buffer { bytes: 16 };

    fn error(declare: impl FnOnce(&mut GraphBuilder)) -> GraphError {
        let mut graph = GraphBuilder::new();
        declare(&mut graph);
        graph.compile().unwrap_err()
    }

    #[test]
    fn sizes_are_checked() {
        let found = error(|graph| {
            graph.transient("empty", ResourceDesc::Buffer { bytes: 0 });
        });
        let resource = "empty".into();
        assert_eq!(found, GraphError::BadSize { resource });
    }

    #[test]
    fn states_are_checked() {
        let image = ImageDesc::flat((1, 1), Format::Rgba8Unorm);
        let found = error(|graph| {
            graph.import("image", image, ResourceState::after(Access::IndexRead));
        });
        assert!(matches!(found, GraphError::BadState { .. }), "{found}");
    }

    #[test]
    fn keys_are_unique_among_history() {
        let found = error(|graph| {
            graph.import("a", BUFFER, ResourceState::UNDEFINED);
            graph.history("a", BUFFER, ResourceState::UNDEFINED);
            graph.history("a", BUFFER, ResourceState::UNDEFINED);
        });
        assert_eq!(found, GraphError::DuplicateHistory { key: "a".into() });
    }

    #[test]
    fn outputs_outlive_the_frame() {
        let found = error(|graph| {
            let transient = graph.transient("t", BUFFER);
            graph.output(transient);
        });
        let resource = "t".into();
        assert_eq!(found, GraphError::TransientOutput { resource });
    }

    #[test]
    fn outputs_are_known() {
        let mut other = GraphBuilder::new();
        let foreign = other.import("other", BUFFER, ResourceState::UNDEFINED);
        let found = error(|graph| graph.output(foreign));
        assert_eq!(found, GraphError::UnknownOutput { resource: 0 });
    }
}
