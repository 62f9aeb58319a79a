//! `enum_names.rs`: names of enumerants by value, for people.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use crate::model::{Enumerant, Model};
use crate::rules::Rules;
use crate::rust::NOTICE;

/// For each value the names that it may have, the oldest first.
type Names<'a> = BTreeMap<u32, &'a Enumerant>;

/// The file: names of all values that are no bits, then names by group.
pub fn enum_names(model: &Model, rules: &Rules) -> String {
    let mut all = Names::new();
    let mut groups: BTreeMap<&str, Names> = BTreeMap::new();
    let wanted = model
        .enumerants
        .values()
        .filter(|enumerant| enumerant.name.starts_with("GL_") && !enumerant.origins.is_empty());
    for enumerant in wanted {
        // Below this, numbers are shared by primitives, truth values and the like.
        if !enumerant.bitmask && enumerant.value >= 0x100 {
            keep_better(&mut all, enumerant);
        }
        for group in &enumerant.groups {
            keep_better(groups.entry(group).or_default(), enumerant);
        }
    }
    let used = used_groups(model, rules);
    groups.retain(|group, _| used.contains(group));
    let mut text =
        format!("{NOTICE}\npub static NAMES: [(u32, &str); {}] = [\n{}];\n", all.len(), rows(&all, "    "));
    let _ = write!(text, "\npub static GROUPS: [(&str, &[(u32, &str)]); {}] = [\n", groups.len());
    for (group, names) in &groups {
        let _ = write!(text, "    ({group:?}, &[\n{}    ]),\n", rows(names, "        "));
    }
    text + "];\n"
}

fn rows(names: &Names, indent: &str) -> String {
    names.iter().fold(String::new(), |mut text, (value, enumerant)| {
        let _ = writeln!(text, "{indent}({value:#06x}, {:?}),", enumerant.name);
        text
    })
}

/// Keeps the enumerant of the oldest version, then the one with the shortest name.
fn keep_better<'a>(names: &mut Names<'a>, enumerant: &'a Enumerant) {
    let rank = |enumerant: &'a Enumerant| {
        let version = enumerant.origins.iter().find(|origin| origin.starts_with("GL_VERSION_"));
        (version.is_none(), version, enumerant.name.len(), &enumerant.name)
    };
    let kept = names.entry(enumerant.value).or_insert(enumerant);
    if rank(enumerant) < rank(kept) {
        *kept = enumerant;
    }
}

/// Groups that parameters or results of commands in scope name.
fn used_groups<'a>(model: &'a Model, rules: &Rules) -> BTreeSet<&'a str> {
    let commands = rules.commands(model);
    let params = commands.iter().flat_map(|&name| &model.commands[name].params);
    params.map(|param| param.group.as_str()).collect()
}
