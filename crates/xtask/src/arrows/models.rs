//! Names of unit models: code outside a model's own crate uses the registry of models.
//!
//! Comments may name a model, and so may tests.

use super::tokens;
use crate::sources::Source;

/// The crates of the unit models; their names are the names of the crates.
const MODELS: &[&str] = &["nx-ect101"];
/// The one file that may name them all.
const REGISTRY: &str = "crates/plant/src/registry.rs";

/// Files of these crates that name a model.
pub(super) fn findings(crates: &[&str], sources: &[Source]) -> Vec<String> {
    let naming = naming(crates, sources).into_iter();
    naming
        .map(|file| format!("{file}: names a unit model outside its crate and the registry of models"))
        .collect()
}

/// The files whose code names a model of another crate.
fn naming<'a>(crates: &[&str], sources: &'a [Source]) -> Vec<&'a str> {
    let names_one = |source: &&Source| {
        let Some(own) = source.path.strip_prefix("crates/").and_then(|path| path.split('/').next()) else {
            return false;
        };
        let is_code = source.extension() == "rs" && !source.is_test() && source.path != REGISTRY;
        let others = || MODELS.iter().filter(|model| **model != own);
        is_code && crates.contains(&own) && others().any(|model| is_named(model, source))
    };
    sources.iter().filter(names_one).map(|source| source.path.as_str()).collect()
}

/// Whether code contains the name in any form: as a crate, a module, a type, an order code.
fn is_named(model: &str, source: &Source) -> bool {
    let lines: Vec<&str> = source.code_lines().map(|(_, line)| line).collect();
    let code = tokens::without_comments(&lines.join("\n")).to_lowercase();
    ["-", "_", ""].iter().any(|joint| code.contains(&model.replace('-', joint)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(path: &str, text: &str) -> bool {
        !naming(&["nx-ect101", "plc", "plant"], &[Source { path: path.into(), text: text.into() }]).is_empty()
    }

    #[test]
    fn a_model_is_found_however_it_is_spelled() {
        for code in [
            "use nx_ect101::Unit;",
            "fn f(unit: &NxEct101) {}",
            "const FILE: &str = \"model = \\\"nx-ect101\\\"\"; // a text",
            "const NAME: &str = \"NX-ECT101\";",
            "const URL: &str = \"https://example.org\"; use nx_ect101::Unit;",
        ] {
            assert!(found("crates/plc/src/io.rs", code), "{code}");
        }
    }

    #[test]
    fn its_own_crate_the_registry_comments_and_tests_may_name_it() {
        let code = "use nx_ect101::Unit;";
        assert!(!found("crates/nx-ect101/src/unit.rs", code));
        assert!(!found(REGISTRY, code));
        assert!(!found("crates/plc/tests/io.rs", code));
        assert!(!found("crates/plc/src/io/tests.rs", code));
        assert!(!found("crates/plc/src/io.rs", "#[cfg(test)]\nmod tests { use nx_ect101::Unit; }"));
        assert!(!found("crates/plc/src/io.rs", "//! As the NX-ECT101 does.\nfn f() {} // nx_ect101"));
        assert!(!found("crates/testbed/src/lib.rs", code));
        assert!(!found("docs/unit-file.md", code));
    }

    #[test]
    fn a_file_that_names_a_model_is_a_finding() {
        let source = Source { path: "crates/plc/src/io.rs".into(), text: "use nx_ect101::Unit;".into() };
        let findings = findings(&["nx-ect101", "plc"], &[source]);
        assert_eq!(findings.len(), 1);
        assert!(findings[0].starts_with("crates/plc/src/io.rs: names a unit model"), "{findings:?}");
    }
}
