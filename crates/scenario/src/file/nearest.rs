//! The known name that is nearest to an unknown one.

/// Minimum similarity of two names.
const ALIKE: f64 = 0.7;

/// The nearest of the names that a refusal lists after the unknown one, each in backticks.
pub(super) fn nearest_name(refusal: &str) -> Option<&str> {
    let mut names = refusal.split('`').skip(1).step_by(2);
    let unknown = names.next().filter(|_| refusal.starts_with("unknown "))?;
    let likeness = |name: &str| strsim::jaro_winkler(name, unknown);
    let nearest = names.max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(nearest) >= ALIKE).then_some(nearest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_of_the_names_that_are_listed() {
        let nearest = |unknown: &str| {
            let refusal = format!("unknown field `{unknown}`, expected one of `take`, `request`, `read_sdo`");
            nearest_name(&refusal).map(str::to_owned)
        };
        assert_eq!(nearest("tke").as_deref(), Some("take"));
        assert_eq!(nearest("read_sod").as_deref(), Some("read_sdo"));
        assert_eq!(nearest("xyz"), None);
        assert_eq!(nearest_name("missing field `title`"), None);
    }
}
