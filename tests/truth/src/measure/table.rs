//! Reports for people.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::Report;

/// Writes a line a style and class: how many settled triangles there are, precision and recall in percent, the recall of
/// young ones; a line a style on camera, lights and identities (switches of chances); and one on where the static world is on
/// screen and on what is traced though it should not be.
///
/// # Errors
/// Those of `out`.
pub fn write_table(out: &mut impl Write, reports: &[Report]) -> io::Result<()> {
    writeln!(
        out,
        "{:<18} {:<12} {:>9} {:>9} {:>9} {:>9} {:>9}  mostly taken for",
        "style", "class", "triangles", "found", "precision", "recall", "young"
    )?;
    for report in reports {
        for score in &report.classes {
            let line = format!(
                "{:<18} {:<12} {:>9} {:>9} {:>9} {:>9} {:>9}  {}",
                report.style,
                score.class,
                score.settled.told,
                score.settled.found,
                percent(score.precision),
                percent(score.recall),
                percent(score.young.recall()),
                mostly(&score.taken_for),
            );
            writeln!(out, "{}", line.trim_end())?;
        }
    }
    writeln!(out)?;
    writeln!(
        out,
        "{:<18} {:>7} {:>7} {:>10} {:>9} {:>11} {:>9} {:>9} {:>9}",
        "style", "camera", "right", "position", "degrees", "projection", "invented", "lights", "switches"
    )?;
    for report in reports {
        let camera = &report.camera;
        let lights = format!("{}/{}", report.lights.right, report.lights.told);
        let switches = report.identity.map_or("-".into(), |i| format!("{}/{}", i.switches, i.chances));
        writeln!(
            out,
            "{:<18} {:>7} {:>7} {:>10.2e} {:>9.3} {:>11.2e} {:>9} {:>9} {:>9}",
            report.style,
            percent(Some(camera.found)),
            percent(Some(camera.right)),
            camera.worst_position,
            camera.worst_angle,
            camera.worst_projection,
            camera.invented,
            lights,
            switches,
        )?;
    }
    writeln!(out)?;
    writeln!(
        out,
        "{:<18} {:>7} {:>9} {:>9} {:>9}   traced: {:>9} {:>11} {:>7} {:>10}",
        "style", "stable", "of frames", "pixels", "worst", "interface", "translucent", "others", "undecided"
    )?;
    for report in reports {
        let stability = report.stability.unwrap_or_default();
        let traced = report.traced;
        writeln!(
            out,
            "{:<18} {:>7} {:>9} {:>9.3} {:>9.3}           {:>9} {:>11} {:>7} {:>10}",
            report.style,
            percent((stability.frames > 0).then_some(stability.stable)),
            stability.frames,
            stability.median,
            stability.worst,
            traced.interface,
            traced.translucent,
            traced.others,
            traced.undecided,
        )?;
    }
    Ok(())
}

/// The class that most of those triangles were taken for.
fn mostly(taken_for: &BTreeMap<&'static str, u64>) -> &'static str {
    taken_for.iter().max_by_key(|(_, count)| **count).map_or("", |(class, _)| class)
}

/// A share in percent.
fn percent(share: Option<f64>) -> String {
    share.map_or("-".into(), |share| format!("{:.1}", 100.0 * share))
}

/// Writes for what triangles were taken where for something else, and why.
///
/// # Errors
/// Where `out` cannot be written.
pub fn write_wrong(out: &mut impl Write, reports: &[Report]) -> io::Result<()> {
    for report in reports {
        for score in &report.classes {
            for (taken_for, count) in &score.because {
                writeln!(out, "{:<18} {:<11} {count:>9} taken for {taken_for}", report.style, score.class)?;
            }
        }
    }
    Ok(())
}
