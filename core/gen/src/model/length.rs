//! The XML's `len`: how many elements a pointer points to.

/// How many elements there are, in terms of the command's parameters (by position).
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Length {
    /// No pointer, or nothing is said.
    Unknown,
    /// So many.
    Count(u16),
    /// As many as the value of a parameter.
    Param(u8),
    /// As many as a parameter's value times a number.
    Product(u8, u16),
    /// A function of these parameters that needs a hand-written rule (`COMPSIZE`).
    Computed(Vec<u8>),
}

impl Length {
    /// Reads a `len`; `position` finds a parameter. What is not understood is unknown.
    pub fn parse(text: &str, position: impl Fn(&str) -> Option<u8>) -> Length {
        let text = text.trim();
        if let Some(inside) = text.strip_prefix("COMPSIZE(").and_then(|t| t.strip_suffix(')')) {
            return Length::Computed(inside.split(',').filter_map(|name| position(name.trim())).collect());
        }
        if let Ok(count) = text.parse() {
            return Length::Count(count);
        }
        if let Some(index) = position(text) {
            return Length::Param(index);
        }
        if let Some((name, factor)) = text.split_once('*')
            && let (Some(index), Ok(factor)) = (position(name.trim()), factor.trim().parse())
        {
            return Length::Product(index, factor);
        }
        Length::Unknown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_read() {
        let position = |name: &str| ["n", "type"].iter().position(|&p| p == name).map(|i| i as u8);
        let parse = |text| Length::parse(text, position);
        assert_eq!(parse("16"), Length::Count(16));
        assert_eq!(parse("n"), Length::Param(0));
        assert_eq!(parse("n*4"), Length::Product(0, 4));
        assert_eq!(parse("COMPSIZE(n,type)"), Length::Computed(vec![0, 1]));
        assert_eq!(parse("COMPSIZE()"), Length::Computed(vec![]));
        assert_eq!(parse("bufSize / 4"), Length::Unknown);
    }
}
