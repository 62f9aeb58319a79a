//! How near scene recovery comes to the truth.

mod camera;
mod classes;
mod identity;
mod lights;
mod observe;
mod play;
mod stability;
mod table;

use serde::Serialize;

use crate::client::Recording;
use crate::truth::Truth;
pub use camera::CameraScore;
pub use classes::{ClassScore, HYSTERESIS, TracedScore};
pub use identity::IdentityScore;
pub use lights::{BakedLight, BakedScore, LightScore, baked, lights_profile, write_baked};
pub use observe::{Observed, Run};
pub use play::{Played, play, play_as, play_file};
pub use stability::{Samples, StabilityScore};
pub use table::{write_table, write_wrong};

/// What was measured of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// The program.
    pub style: String,
    /// Frames of it.
    pub frames: usize,
    /// Of the classes that the program has or recovery found, in the order of [`CLASSES`](crate::CLASSES).
    pub classes: Vec<ClassScore>,
    /// Of the camera.
    pub camera: CameraScore,
    /// Of lights.
    pub lights: LightScore,
    /// Of objects' identities; nothing while recovery does not tell objects apart.
    pub identity: Option<IdentityScore>,
    /// Of what is traced and should not be.
    pub traced: TracedScore,
    /// Of the static world's place on screen; nothing where only verdicts are compared.
    pub stability: Option<StabilityScore>,
}

/// Plays a recording and measures what scene recovery makes of it.
///
/// # Errors
/// Where the trace cannot be played, or its frames do not have the triangles that the truth says.
pub fn measure(recording: &Recording) -> anyhow::Result<Report> {
    measure_played(&recording.truth, &play(&recording.trace)?)
}

/// Measures what scene recovery made of frames that were played.
///
/// # Errors
/// Where they do not have the triangles that the truth says.
pub fn measure_played(truth: &Truth, played: &[Played]) -> anyhow::Result<Report> {
    let observed: Vec<Observed> = played.iter().map(|frame| frame.observed.clone()).collect();
    let report = compare(truth, &observed)?;
    Ok(Report { stability: Some(stability::score(truth, &observed, played)), ..report })
}

/// Compares what was recovered with the truth.
///
/// # Errors
/// Where both do not have the same triangles.
pub fn compare(truth: &Truth, observed: &[Observed]) -> anyhow::Result<Report> {
    anyhow::ensure!(
        truth.frames.len() == observed.len(),
        "{} frames were played of {}",
        observed.len(),
        truth.frames.len()
    );
    for (index, (frame, observed)) in truth.frames.iter().zip(observed).enumerate() {
        let (told, seen) = (frame.triangles(), observed.triangles());
        anyhow::ensure!(told == seen, "frame {index} has {seen} triangles, the truth {told}");
    }
    Ok(Report {
        style: truth.style.clone(),
        frames: truth.frames.len(),
        classes: classes::score(truth, observed),
        camera: camera::score(truth, observed),
        lights: lights::score(truth, observed),
        identity: identity::score(truth, observed),
        traced: classes::traced(truth, observed),
        stability: None,
    })
}
