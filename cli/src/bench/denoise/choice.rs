//! Which denoisers there are to be compared.

use std::str::FromStr;

use afterglow_render::PathtraceOptions;

/// A way to smooth pictures of few samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Denoiser {
    /// The noise stays.
    None,
    /// The filter of indirect light.
    Filter,
}

impl Denoiser {
    /// All of them.
    pub const ALL: [Denoiser; 2] = [Denoiser::None, Denoiser::Filter];

    /// As it is written on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Denoiser::None => "none",
            Denoiser::Filter => "filter",
        }
    }

    /// Tells a renderer.
    pub fn apply(self, options: &mut PathtraceOptions) {
        options.filter = self == Denoiser::Filter;
    }
}

impl FromStr for Denoiser {
    type Err = String;

    fn from_str(text: &str) -> Result<Denoiser, String> {
        let names = || Denoiser::ALL.map(Denoiser::name).join(", ");
        let found = Denoiser::ALL.into_iter().find(|denoiser| denoiser.name() == text);
        found.ok_or_else(|| format!("'{text}' is none of {}", names()))
    }
}
