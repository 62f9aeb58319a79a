//! The report's rows.

use std::io::{self, Write};

use serde::Serialize;

use super::build::BuildRow;
use super::hardware::DriverRow;
use super::subject::Subject;

/// All figures of a mesh.
#[derive(Debug, Serialize)]
pub struct SubjectRow {
    /// The mesh.
    pub name: String,
    /// How many triangles.
    pub triangles: usize,
    /// Building it.
    pub build: BuildRow,
    /// The driver's building of it, where its structures were asked for and are there.
    pub driver: Option<DriverRow>,
    /// The yardstick first.
    pub structures: Vec<StructureRow>,
    /// Backends that were asked for and are not there, and why.
    pub not_there: Vec<(&'static str, String)>,
}

/// Figures of a structure.
#[derive(Debug, Serialize)]
pub struct StructureRow {
    /// Its name.
    pub structure: String,
    /// One a kind of rays.
    pub rays: Vec<RayRow>,
}

/// Figures of a kind of rays.
#[derive(Debug, Serialize)]
pub struct RayRow {
    /// `primary`, `shadow`, `bounce`.
    pub kind: &'static str,
    /// Millions of rays a second in the shortest run.
    pub best_mrays: f64,
    /// The same in the run of median length.
    pub median_mrays: f64,
    /// Rays that met something, 0 to 1.
    pub hit_share: f64,
    /// Answers that are others than the yardstick's.
    pub differing: usize,
    /// How many runs.
    pub runs: usize,
}

/// Writes what stands above the first row.
pub fn write_head(out: &mut dyn Write, device: &str, size: [u32; 2]) -> io::Result<()> {
    writeln!(
        out,
        "{device}, {}x{} rays; Mrays/s of the shortest run, the median one, and in units of the binary structure",
        size[0], size[1]
    )
}

impl SubjectRow {
    /// Without structures yet.
    pub fn new(subject: &Subject, build: BuildRow) -> Self {
        Self {
            name: subject.name.clone(),
            triangles: subject.triangle_count(),
            build,
            driver: None,
            structures: Vec::new(),
            not_there: Vec::new(),
        }
    }

    /// Writes the mesh's figures as text.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}, {} triangles", self.name, self.triangles)?;
        self.build.write(out)?;
        self.driver.as_ref().map_or(Ok(()), |driver| driver.write(out))?;
        for structure in &self.structures {
            for (number, rays) in structure.rays.iter().enumerate() {
                let yardstick = self.structures[0].rays.get(number).map_or(f64::NAN, |rays| rays.best_mrays);
                writeln!(
                    out,
                    "  {:<9} {:<8} {:>9.2} {:>9.2} {:>6.2}   {:.2} % hit, {} differ, {} runs",
                    structure.structure,
                    rays.kind,
                    rays.best_mrays,
                    rays.median_mrays,
                    rays.best_mrays / yardstick,
                    100.0 * rays.hit_share,
                    rays.differing,
                    rays.runs
                )?;
            }
        }
        for (backend, reason) in &self.not_there {
            writeln!(out, "  {backend:<9} not there: {reason}")?;
        }
        Ok(())
    }
}

impl BuildRow {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let good = self.good_mtriangles.map_or(String::new(), |good| format!(", {good:.2} (good)"));
        writeln!(
            out,
            "  software  builds {:.2} (fast){good}, refits {:.2} Mtriangles/s; {:.1} bytes a triangle, {:.1} of nodes; {} \
             levels",
            self.fast_mtriangles,
            self.refit_mtriangles,
            self.bytes_a_triangle,
            self.node_bytes_a_triangle,
            self.levels
        )
    }
}

impl DriverRow {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(
            out,
            "  hardware  builds {:.2} (fast), {:.2} (good), updates {:.2} Mtriangles/s; {:.1} (fast), {:.1} (good, \
             compacted) bytes a triangle",
            self.fast_mtriangles,
            self.good_mtriangles,
            self.update_mtriangles,
            self.fast_bytes_a_triangle,
            self.good_bytes_a_triangle
        )
    }
}
