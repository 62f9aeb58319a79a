//! Which denoisers there are to be compared.

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
}

/// Tells a renderer.
pub fn apply(denoiser: Denoiser, options: &mut PathtraceOptions) {
    options.filter = denoiser == Denoiser::Filter;
}

/// The one of a name.
pub fn parse(text: &str) -> Result<Denoiser, String> {
    let found = Denoiser::ALL.into_iter().find(|denoiser| denoiser.name() == text);
    found.ok_or_else(|| format!("'{text}' is none of {}", Denoiser::ALL.map(Denoiser::name).join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for denoiser in Denoiser::ALL {
            assert_eq!(parse(denoiser.name()), Ok(denoiser));
        }
        assert!(parse("blur").unwrap_err().contains("none, "));
    }
}
