//! Which denoisers there are to be compared.

pub use afterglow_render::Denoiser;

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
