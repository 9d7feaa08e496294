use super::*;

fn source(path: &str, text: &str) -> Source {
    Source { path: path.to_string(), text: text.to_string() }
}

/// A reference with sections 1 and 1.7, and three statements: covered, left out, not yet supported.
fn reference() -> Vec<Source> {
    let statements = "| number | statement | pinned |\n\
                      | C001 | frames come back | `esc/tests/frames.rs` |\n\
                      | C002 | files arrive | not here: no FoE |\n\
                      | C003 | clocks agree | not yet: 0x092C is 0 |\n";
    vec![
        source("docs/reference/frames.md", "# 1 Frames\n## 1.7 Errors\n"),
        source(STATEMENTS, statements),
        source("crates/esc/tests/frames.rs", "/// C001: all of them.\n#[test]\nfn frames() {}\n"),
    ]
}

fn findings_with(path: &str, text: &str) -> Vec<String> {
    let mut sources = reference();
    sources.retain(|source| source.path != path);
    sources.push(source(path, text));
    findings(&sources)
}

#[test]
fn a_reference_that_agrees_has_no_finding() {
    assert_eq!(findings(&reference()), Vec::<String>::new());
    let good = "// See reference 1.7, and Reference, 1; C002.\n// The reference\n// 1.7 goes on.\n";
    assert_eq!(findings_with("crates/esc/src/lib.rs", good), Vec::<String>::new());
}

#[test]
fn a_citation_without_heading_is_found_with_its_line() {
    let wrong = [
        ("crates/esc/src/lib.rs", "\n// It wraps (reference 1.8)."),
        ("crates/esc/src/lib.rs", "\n/// Reference, 2: see there"),
        ("crates/esc/src/lib.rs", "\n//! reference 1.7, 1.7 to 1.9"),
        ("crates/esc/src/lib.rs", "\n// The reference\n// 3.1 says why."),
        ("docs/decisions.md", "\n| a choice | reference 1 and 7.3, unsure |"),
        ("units/small.toml", "\nkey = 1 # reference 4.2"),
    ];
    for (path, text) in wrong {
        let found = findings_with(path, text);
        assert_eq!(found.len(), 1, "{text}: {found:?}");
        assert!(found[0].starts_with(&format!("{path}:2: reference ")), "{found:?}");
    }
}

#[test]
fn what_only_looks_like_a_citation_is_none() {
    for text in [
        "let reference = 9.9;",
        "// A reference to 9 things, preference 9.9, the manual's reference 8-6, reference 16#1.",
        "// A colour 0xC999, C9999, RC999, C99.",
        "let code = \"C999x\";",
    ] {
        assert_eq!(findings_with("crates/esc/src/lib.rs", text), Vec::<String>::new(), "{text}");
    }
}

#[test]
fn a_citation_or_mark_of_an_unknown_statement_is_found() {
    for (path, text) in [
        ("crates/esc/src/lib.rs", "// As C004 says."),
        ("crates/esc/src/lib.rs", "let check = \"C004\";"),
        ("docs/decisions.md", "| a choice | C004 |"),
        ("crates/esc/tests/sii.rs", "/// C004: a mark.\n#[test]\nfn sii() {}"),
        ("scenarios/a.toml", "# C004: a mark."),
    ] {
        let found = findings_with(path, text);
        assert_eq!(found, [format!("{path}:1: C004 is not in docs/reference/")], "{text}");
    }
}

#[test]
fn a_statement_without_mark_or_reason_is_found() {
    for text in [
        "#[test]\nfn frames() {}\n",
        "/// Not C001 at the beginning.\n#[test]\nfn frames() {}\n",
        "/// C001: no test follows.\nfn frames() {}\n\n#[test]\nfn other() {}\n",
    ] {
        let found = findings_with("crates/esc/tests/frames.rs", text);
        assert_eq!(
            found,
            ["docs/reference/conformance.md: C001 has neither a test that names it nor a reason"],
            "{text}"
        );
    }
    for reason in ["", "not here: ", "nobody needs it"] {
        let row = format!("| C001 | frames come back | `esc/tests/frames.rs` |\n| C002 | files | {reason} |");
        assert_eq!(findings_with(STATEMENTS, &row).len(), 1, "{reason}");
    }
}

#[test]
fn a_reason_that_is_no_longer_true_and_a_place_that_moved_are_found() {
    let marked = findings_with("scenarios/foe.toml", "# C002, C003: files and clocks");
    assert_eq!(marked.len(), 2, "{marked:?}");
    let moved = findings_with("crates/segment/tests/frames.rs", "/// C001\n#[tokio::test]\nasync fn f() {}");
    assert_eq!(
        moved,
        ["docs/reference/conformance.md: C001 is pinned elsewhere: `cargo xtask conformance --bless`"]
    );
    let twice = "| C001 | frames come back | `esc/tests/frames.rs` |\n".repeat(2);
    assert_eq!(findings_with(STATEMENTS, &twice), ["docs/reference/conformance.md: C001 has two rows"]);
}

#[test]
fn bless_writes_places_and_keeps_reasons() {
    let page = "# 10\n| C001 | one | |\n| C002 | two | not here: no FoE |\n| C003 | three | `a.rs` |\n";
    let marked = BTreeMap::from([
        (1, BTreeSet::from(["crates/esc/tests/sii.rs", "scenarios/a.toml"])),
        (2, BTreeSet::from(["crates/esc/tests/sii.rs"])),
    ]);
    assert_eq!(
        Page::of(page).with_places(&marked),
        "# 10\n| C001 | one | `esc/tests/sii.rs`, `scenarios/a.toml` |\n| C002 | two | not here: no FoE |\n| C003 | three |  |\n"
    );
}
