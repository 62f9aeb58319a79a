//! What a frame consists of, for people and for `--json`.

use std::borrow::Cow;

use serde::Serialize;

use crate::{CompiledGraph, Lifetime, PassKind, Residence, ResourceId};

/// A frame's passes, culled passes and memory.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Report {
    /// The passes that run, in order.
    pub passes: Vec<PassReport>,
    pub culled: Vec<CulledReport>,
    pub bytes: BytesReport,
    pub resources: Vec<ResourceReport>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PassReport {
    pub name: Cow<'static, str>,
    pub kind: PassKind,
    /// How many barriers come before it.
    pub barriers: usize,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CulledReport {
    pub pass: Cow<'static, str>,
    pub reason: String,
}

/// Payload in bytes, without padding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct BytesReport {
    /// All transients that live passes touch, each in memory of its own.
    pub transient_unaliased: u64,
    /// The most that transients hold at one step: no placement can do with less.
    pub transient_peak: u64,
    /// All history.
    pub persistent: u64,
    /// All that lives outside.
    pub imported: u64,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ResourceReport {
    pub name: Cow<'static, str>,
    pub residence: Residence,
    /// Payload, without padding.
    pub bytes: u64,
    /// The first and last pass that touch it, counted in [`Report::passes`].
    pub first: Option<u32>,
    pub last: Option<u32>,
}

impl CompiledGraph {
    /// Describes the frame.
    pub fn report(&self) -> Report {
        Report {
            passes: self.report_passes(),
            culled: self.report_culled(),
            bytes: self.report_bytes(),
            resources: self.resources().map(|id| self.report_resource(id)).collect(),
        }
    }

    fn report_passes(&self) -> Vec<PassReport> {
        let describe = |step: crate::Step<'_>| {
            let pass = &self.declared.passes[step.pass.index()];
            PassReport { name: pass.name.clone(), kind: pass.kind, barriers: step.barriers.len() }
        };
        self.steps().map(describe).collect()
    }

    fn report_culled(&self) -> Vec<CulledReport> {
        self.culled()
            .map(|(pass, reason)| CulledReport {
                pass: self.declared.passes[pass.index()].name.clone(),
                reason: reason.to_string(),
            })
            .collect()
    }

    fn report_resource(&self, id: ResourceId) -> ResourceReport {
        let resource = &self.declared.resources[id.index()];
        let lifetime = self.lifetimes[id.index()];
        ResourceReport {
            name: resource.name.clone(),
            residence: resource.residence,
            bytes: self.checked[id.index()].bytes,
            first: lifetime.map(|lifetime| lifetime.first),
            last: lifetime.map(|lifetime| lifetime.last),
        }
    }

    fn report_bytes(&self) -> BytesReport {
        let mut report = BytesReport { transient_peak: self.transient_peak(), ..BytesReport::default() };
        for id in self.resources() {
            let index = id.index();
            let total = match self.declared.resources[index].residence {
                Residence::Transient if self.lifetimes[index].is_none() => continue,
                Residence::Transient => &mut report.transient_unaliased,
                Residence::History => &mut report.persistent,
                Residence::Imported => &mut report.imported,
            };
            *total = total.saturating_add(self.checked[index].bytes);
        }
        report
    }

    /// The largest sum of the bytes of transients alive at one step.
    fn transient_peak(&self) -> u64 {
        let mut begins = vec![0_u64; self.order.len()];
        let mut ends = vec![0_u64; self.order.len()];
        for (bytes, lifetime) in self.transient_lifetimes() {
            let begin = &mut begins[lifetime.first as usize];
            *begin = begin.saturating_add(bytes);
            let end = &mut ends[lifetime.last as usize];
            *end = end.saturating_add(bytes);
        }
        let mut alive = 0_u64;
        let mut peak = 0;
        for (begin, end) in begins.into_iter().zip(ends) {
            alive = alive.saturating_add(begin);
            peak = peak.max(alive);
            alive = alive.saturating_sub(end);
        }
        peak
    }

    fn transient_lifetimes(&self) -> impl Iterator<Item = (u64, Lifetime)> {
        self.resources().filter_map(|id| {
            let index = id.index();
            let is_transient = self.declared.resources[index].residence == Residence::Transient;
            let lifetime = self.lifetimes[index].filter(|_| is_transient)?;
            Some((self.checked[index].bytes, lifetime))
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::{Access::*, GraphBuilder, PassKind, ResourceDesc, ResourceState};

    /// A chain a -> b -> c -> out of three transients, and a fourth that nobody reads.
    fn chain() -> crate::CompiledGraph {
        let mut graph = GraphBuilder::new();
        let buffer = |bytes| ResourceDesc::Buffer { bytes };
        let out = graph.history("out", buffer(1000), ResourceState::UNDEFINED);
        graph.output(out);
        let sized = [("a", 1), ("b", 20), ("c", 300), ("unread", 4000)];
        let [a, b, c, unread] = sized.map(|(name, bytes)| graph.transient(name, buffer(bytes)));
        graph.pass("a", PassKind::Compute).write(a, StorageWriteCompute);
        for (name, from, to) in [("b", a, b), ("c", b, c), ("out", c, out)] {
            graph.pass(name, PassKind::Compute).read(from, StorageReadCompute).write(to, StorageWriteCompute);
        }
        graph.pass("idle", PassKind::Compute).write(unread, StorageWriteCompute);
        graph.compile().unwrap()
    }

    #[test]
    fn bytes_are_counted_by_residence() {
        let bytes = chain().report().bytes;
        assert_eq!(bytes.transient_unaliased, 321);
        assert_eq!(bytes.transient_peak, 320);
        assert_eq!(bytes.persistent, 1000);
        assert_eq!(bytes.imported, 0);
    }

    #[test]
    fn keys_are_stable() {
        let report = serde_json::to_value(chain().report()).unwrap();
        let compute = "compute";
        assert_eq!(report["passes"][1], serde_json::json!({"name": "b", "kind": compute, "barriers": 1}));
        assert_eq!(report["culled"], serde_json::json!([{"pass": "idle", "reason": "unused result"}]));
        assert_eq!(
            report["resources"][1],
            serde_json::json!({"name": "a", "residence": "transient", "bytes": 1, "first": 0, "last": 1})
        );
        assert_eq!(report["resources"][4]["first"], serde_json::Value::Null);
    }
}
