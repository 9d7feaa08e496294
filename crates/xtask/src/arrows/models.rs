//! Names of unit models: code outside a model's own crate uses the registry of models.
//!
//! Comments may name a model, and so may tests. The files whose code does so at present are in a list; if a
//! file is only moved, rename it there by hand.

use super::list::List;
use super::tokens;
use crate::outcome::{Outcome, report};
use crate::sources::Source;

/// The crates of the unit models; their names are the names of the crates.
const MODELS: &[&str] = &["nx-ect101"];
/// The one file that may name them all.
const REGISTRY: &str = "crates/plant/src/registry.rs";

/// The files that name a model.
const KNOWN: List = List { file: "crates/xtask/src/arrows/models.txt", text: include_str!("models.txt") };

/// Files of these crates that name a model and are not in the list, and lines of the list that no longer name one.
pub(super) fn findings(crates: &[&str], sources: &[Source]) -> Vec<String> {
    compare(&naming(crates, sources), &KNOWN.items().collect::<Vec<_>>())
}

/// The number of files in the list.
pub(super) fn count() -> usize {
    KNOWN.items().count()
}

/// Writes the list, if no file is new.
pub(super) fn bless(crates: &[&str], sources: &[Source]) -> Outcome {
    let (found, known) = (naming(crates, sources), KNOWN.items().collect::<Vec<_>>());
    report("files that name a model", &new(&found, &known))?;
    KNOWN.write(found.iter().map(ToString::to_string))
}

fn compare(found: &[&str], known: &[&str]) -> Vec<String> {
    let new = new(found, known).into_iter();
    let new =
        new.map(|file| format!("{file}: names a unit model outside its crate and the registry of models"));
    let gone = known.iter().filter(|file| !found.contains(file));
    new.chain(gone.map(|file| format!("{file}: names no unit model any more: `cargo xtask arrows --bless`")))
        .collect()
}

fn new(found: &[&str], known: &[&str]) -> Vec<String> {
    found.iter().filter(|file| !known.contains(file)).map(ToString::to_string).collect()
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
    fn the_list_only_shrinks() {
        let known = ["a.rs", "b.rs"];
        assert_eq!(compare(&known, &known), Vec::<String>::new());
        assert!(compare(&["a.rs"], &known)[0].starts_with("b.rs: names no unit model"));
        assert!(compare(&["a.rs", "b.rs", "c.rs"], &known)[0].starts_with("c.rs: names a unit model"));
        assert_eq!(new(&["a.rs"], &known), Vec::<String>::new());
        assert_eq!(new(&["a.rs", "c.rs"], &known), ["c.rs"]);
    }
}
