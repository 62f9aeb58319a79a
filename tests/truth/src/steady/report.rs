//! Steadiness in words and figures.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::Steadiness;
use super::objects::Times;

/// Frames of each kind that are named.
const NAMED: usize = 12;

/// Writes what was found.
///
/// # Errors
/// Where `out` cannot be written to.
pub fn write_steadiness(out: &mut impl Write, found: &mut Steadiness) -> io::Result<()> {
    let share = |part: u32, whole: u32| 100.0 * f64::from(part) / f64::from(whole.max(1));
    let Steadiness { frames, solid, blind, .. } = found;
    writeln!(out, "frames        {frames}, {solid} with something solid")?;
    writeln!(
        out,
        "no camera     {} of these ({:.2} %): {}",
        blind.0,
        share(blind.0, *solid),
        named(&blind.1)
    )?;
    writeln!(out, "worlds        begun at {}", named(&found.epochs))?;
    let steps = found.journey.steps();
    writeln!(
        out,
        "eye           median step {:.5}, 90 % {:.5}, longest {:.3} ({:.0} times as long) at {}",
        steps.median,
        steps.long,
        steps.worst.0,
        steps.worst.0 / steps.long.max(1e-9),
        steps.worst.1
    )?;
    writeln!(out, "  jumps       {}: {}", steps.jumps.len(), named(&steps.jumps))?;
    let away: Vec<u32> = steps.returned.iter().map(|(away, _)| *away).collect();
    writeln!(out, "  and back    {}: {}", away.len(), named(&away))?;
    let (sum, count) = found.journey.agreement;
    writeln!(
        out,
        "agreement     {:.2} % of what is the same in two frames; {} frames in doubt",
        100.0 * sum / f64::from(count.max(1)),
        found.journey.doubts.len()
    )?;
    for doubt in found.journey.doubts.iter().take(NAMED) {
        writeln!(
            out,
            "  {:>6}      {:.0} of {:.0} pixels agree, {:.0} with another{}: {} ({})",
            doubt.frame,
            doubt.agree,
            doubt.matched,
            doubt.rival,
            if doubt.rests { " that rests" } else { "" },
            doubt.of.0.name(),
            doubt.of.1
        )?;
    }
    let switches = &found.switches;
    writeln!(
        out,
        "switches      {} of {} times that a surface was there again",
        switches.found.len(),
        switches.chances
    )?;
    for switch in switches.found.iter().take(NAMED) {
        writeln!(
            out,
            "  {:>6}      {:016x} (seen at {}) -> {:016x}, {}: {}",
            switch.frame,
            switch.from,
            switch.seen,
            switch.to,
            switch.class.name(),
            switch.reason
        )?;
    }
    let objects = found.histories.finish();
    let most = found.histories.most.iter().map(|(count, id)| format!("{id:016x} {count}"));
    writeln!(out, "objects       {objects}; most changes: {}", most.collect::<Vec<_>>().join(", "))?;
    write_times(out, "class changes", &found.histories.changes)?;
    write_times(out, "flips", &found.histories.flips)?;
    writeln!(
        out,
        "undecided     in {} frames ({:.1} %)",
        found.undecided,
        share(found.undecided, found.frames)
    )?;
    for (reason, (draws, first)) in &found.reasons {
        writeln!(out, "  {draws:>6}      {reason} (first at {first})")?;
    }
    let mut times = found.times.clone();
    times.sort_unstable();
    let at = |share: f64| {
        times.get((share * (times.len().max(1) - 1) as f64) as usize).copied().unwrap_or_default()
    };
    let total: f64 = times.iter().map(|(time, _)| time.as_secs_f64()).sum();
    let ms = |(time, _): (std::time::Duration, u32)| time.as_secs_f64() * 1e3;
    writeln!(
        out,
        "time          median {:.2} ms, 99 % {:.2} ms, worst {:.2} ms at {}; {:.0} ns a triangle",
        ms(at(0.5)),
        ms(at(0.99)),
        ms(at(1.0)),
        at(1.0).1,
        1e9 * total / found.triangles.max(1) as f64
    )?;
    let quarters: Vec<String> = found
        .times
        .chunks(found.times.len().div_ceil(4).max(1))
        .map(|quarter| {
            let mut quarter = quarter.to_vec();
            quarter.sort_unstable();
            format!("{:.2}", ms(quarter[quarter.len() / 2]))
        })
        .collect();
    writeln!(out, "  by quarter  {} ms", quarters.join(", "))?;
    write!(out, "MiB           frame: process, world remembered;")?;
    for used in &found.uses {
        write!(out, " {}: {}, {};", used.frame, used.resident >> 20, used.remembered >> 20)?;
    }
    writeln!(out)
}

fn write_times(out: &mut impl Write, name: &str, times: &BTreeMap<String, Times>) -> io::Result<()> {
    writeln!(out, "{name:<13} {}", times.values().map(|(count, _)| count).sum::<u32>())?;
    let mut sorted: Vec<_> = times.iter().collect();
    sorted.sort_by_key(|(_, (count, _))| std::cmp::Reverse(*count));
    for (what, (count, frames)) in sorted.into_iter().take(NAMED) {
        writeln!(out, "  {count:>6}      {what} at {}", named(frames))?;
    }
    Ok(())
}

/// The first of some frames.
fn named(frames: &[u32]) -> String {
    let first: Vec<String> = frames.iter().take(NAMED).map(u32::to_string).collect();
    let more = if frames.len() > NAMED { " ..." } else { "" };
    if first.is_empty() { "none".into() } else { first.join(" ") + more }
}
