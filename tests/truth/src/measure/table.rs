//! Reports for people.

use std::io::{self, Write};

use super::Report;

/// Writes a line a style and class: precision and recall of settled triangles in percent, and how many there are.
///
/// # Errors
/// Those of `out`.
pub fn write_table(out: &mut impl Write, reports: &[Report]) -> io::Result<()> {
    writeln!(
        out,
        "{:<18} {:<12} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "style", "class", "triangles", "found", "precision", "recall", "young"
    )?;
    for report in reports {
        for score in &report.classes {
            writeln!(
                out,
                "{:<18} {:<12} {:>9} {:>9} {:>9} {:>9} {:>9}",
                report.style,
                score.class,
                score.settled.told,
                score.settled.found,
                percent(score.precision),
                percent(score.recall),
                percent(score.young.recall()),
            )?;
        }
    }
    writeln!(out)?;
    writeln!(
        out,
        "{:<18} {:>7} {:>7} {:>10} {:>9} {:>11} {:>9} {:>9}",
        "style", "camera", "right", "position", "degrees", "projection", "invented", "switches"
    )?;
    for report in reports {
        let camera = &report.camera;
        let switches = report.identity.map_or("-".into(), |i| format!("{}/{}", i.switches, i.chances));
        writeln!(
            out,
            "{:<18} {:>7} {:>7} {:>10.2e} {:>9.3} {:>11.2e} {:>9} {:>9}",
            report.style,
            percent(Some(camera.found)),
            percent(Some(camera.right)),
            camera.worst_position,
            camera.worst_angle,
            camera.worst_projection,
            camera.invented,
            switches,
        )?;
    }
    Ok(())
}

/// A share in percent.
fn percent(share: Option<f64>) -> String {
    share.map_or("-".into(), |share| format!("{:.1}", 100.0 * share))
}
