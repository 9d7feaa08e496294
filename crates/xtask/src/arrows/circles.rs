//! Circles between the files of a crate: each of the files reaches the others by arrows.
//!
//! An arrow goes from a file to the file that defines a name which the first file imports or writes as a path.
//! Declaring child modules and re-exporting their names is not an arrow. Tests have no arrows.

use std::collections::{BTreeMap, BTreeSet};

use super::list::{self, List};
use super::modules::Modules;
use crate::outcome::{Outcome, report};
use crate::sources::Source;

/// The existing circles: to be removed, never to be extended.
const KNOWN: List = List { file: "crates/xtask/src/arrows/circles.txt", text: include_str!("circles.txt") };

/// Files from the top folder, in order.
type Circle<'a> = BTreeSet<&'a str>;

/// Circles that are not in the list, and lines of the list that are no longer a circle.
pub(super) fn findings(crates: &[&str], sources: &[Source]) -> Vec<String> {
    let found: Vec<Circle<'_>> = crates.iter().flat_map(|name| circles(name, sources)).collect();
    compare(&found, &known(KNOWN.text))
}

/// The number of circles in the list.
pub(super) fn count() -> usize {
    KNOWN.items().count()
}

/// Writes the list, if no circle is new and none has grown.
pub(super) fn bless(crates: &[&str], sources: &[Source]) -> Outcome {
    let found: Vec<Circle<'_>> = crates.iter().flat_map(|name| circles(name, sources)).collect();
    let known = known(KNOWN.text);
    report("new circles", &new(&found, &known))?;
    KNOWN.write(found.iter().map(line))
}

/// Circles that are not part of a known one.
fn new(found: &[Circle<'_>], known: &[Circle<'_>]) -> Vec<String> {
    let is_new = |circle: &&Circle<'_>| !known.iter().any(|known| circle.is_subset(known));
    found.iter().filter(is_new).map(line).collect()
}

fn line(circle: &Circle<'_>) -> String {
    circle.iter().copied().collect::<Vec<_>>().join(" ")
}

fn compare(found: &[Circle<'_>], known: &[Circle<'_>]) -> Vec<String> {
    let new = found.iter().filter(|circle| !known.contains(circle)).map(|circle| {
        let smaller = known.iter().any(|known| circle.is_subset(known));
        let what =
            if smaller { "is smaller now: `cargo xtask arrows --bless`" } else { "is a new circle of files" };
        format!("{}: {what}", line(circle))
    });
    let gone = known.iter().filter(|circle| !found.contains(circle));
    new.chain(gone.map(|circle| format!("{}: is gone: `cargo xtask arrows --bless`", line(circle)))).collect()
}

fn known(text: &str) -> Vec<Circle<'_>> {
    list::items(text).map(|line| line.split_whitespace().collect()).collect()
}

/// The circles of one crate.
fn circles<'a>(crate_name: &str, sources: &'a [Source]) -> Vec<Circle<'a>> {
    let mut next: BTreeMap<&str, Vec<&'a str>> = BTreeMap::new();
    for (from, to) in Modules::of(crate_name, sources).arrows() {
        next.entry(from).or_default().push(to);
    }
    let reached: BTreeMap<&'a str, Circle<'a>> =
        next.values().flatten().map(|file| (*file, reachable(file, &next))).collect();
    let mutual = |file: &&'a str| {
        let back = |other: &&&'a str| reached.get(**other).is_some_and(|reached| reached.contains(file));
        reached[file].iter().filter(back).copied().collect::<Circle<'a>>()
    };
    let circles: BTreeSet<Circle<'a>> =
        reached.keys().map(mutual).filter(|circle| circle.len() > 1).collect();
    circles.into_iter().collect()
}

/// The files that a file reaches by arrows, directly or through others.
fn reachable<'a>(file: &'a str, next: &BTreeMap<&str, Vec<&'a str>>) -> Circle<'a> {
    let mut reached = Circle::new();
    let mut open: Vec<&str> = vec![file];
    while let Some(file) = open.pop() {
        open.extend(next.get(file).into_iter().flatten().filter(|to| reached.insert(**to)));
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let sources: Vec<Source> = files
            .iter()
            .map(|(file, text)| Source { path: format!("crates/a/src/{file}"), text: text.to_string() })
            .collect();
        let short = |file: &&str| file["crates/a/src/".len()..].to_string();
        let line = |circle: &Circle<'_>| circle.iter().map(short).collect::<Vec<_>>().join(" ");
        circles("a", &sources).iter().map(line).collect()
    }

    #[test]
    fn a_circle_is_found_however_the_files_name_each_other() {
        for (one, two) in [
            ("use crate::two::Two;", "use crate::one::One;"),
            ("use super::two::Two;", "fn f() { crate::one::g() }"),
            ("use crate::{two::{Two, f}, three};", "use super::one;"),
            ("use crate::Two;", "use crate::one::One as First;"),
        ] {
            let root = "mod one;\nmod two;\npub use two::Two;\n";
            assert_eq!(
                found(&[("lib.rs", root), ("one.rs", one), ("two.rs", two)]),
                ["one.rs two.rs"],
                "{one}"
            );
        }
        let way =
            [("lib.rs", "mod a; mod b; mod c;"), ("a.rs", "use crate::b;"), ("b/mod.rs", "use crate::c::C;")];
        assert_eq!(found(&[way[0], way[1], way[2], ("c.rs", "use crate::a::A;")]), ["a.rs b/mod.rs c.rs"]);
    }

    #[test]
    fn a_parent_that_declares_and_re_exports_is_in_no_circle_and_one_that_uses_is() {
        let child = ("one/part.rs", "use super::One;");
        let declares = "mod part;\npub use part::Part;\npub(crate) use part::{f, g};\n";
        assert_eq!(found(&[("lib.rs", "mod one;"), ("one.rs", declares), child]), Vec::<String>::new());
        for uses in ["mod part;\nuse part::Part;", "mod part;\nfn h() { part::f() }"] {
            assert_eq!(found(&[("lib.rs", "mod one;"), ("one.rs", uses), child]), ["one.rs one/part.rs"]);
        }
    }

    #[test]
    fn tests_comments_and_texts_draw_no_arrow() {
        let quiet = "// use crate::two::Two;\nconst A: &str = \"use crate::two::Two;\"; const B: char = '\"';\n\
                     #[cfg(test)]\nmod tests;\nuse std::fmt;\nfn f<'a>(a: &'a str) {}\n\
                     #[cfg(test)]\nmod checks { use crate::two::Two; }";
        let two = ("two.rs", "use crate::one::One;");
        assert_eq!(found(&[("lib.rs", ""), ("one.rs", quiet), two]), Vec::<String>::new());
        let tests = ("one/tests.rs", "use crate::two::Two;");
        assert_eq!(found(&[("lib.rs", ""), ("one.rs", ""), tests, two]), Vec::<String>::new());
        let behind = format!("#[cfg(test)]\nmod tests;\n{}", "use crate::two::Two;");
        assert_eq!(found(&[("lib.rs", ""), ("one.rs", &behind), two]), ["one.rs two.rs"]);
    }

    #[test]
    fn the_list_of_known_circles_only_shrinks() {
        let known = known("# known\na.rs b.rs c.rs\n\nd.rs e.rs\n");
        let circle = |files: &'static str| files.split(' ').collect::<Circle<'_>>();
        assert_eq!(compare(&known, &known), Vec::<String>::new());
        let ends = |found: &[Circle<'_>]| {
            compare(found, &known)
                .iter()
                .map(|line| line.split(": ").nth(1).unwrap().to_string())
                .collect::<Vec<_>>()
        };
        assert_eq!(ends(&known[..1]), ["is gone"]);
        assert_eq!(ends(&[circle("a.rs b.rs"), circle("d.rs e.rs")]), ["is smaller now", "is gone"]);
        assert_eq!(
            ends(&[known[0].clone(), circle("d.rs e.rs f.rs")]),
            ["is a new circle of files", "is gone"]
        );
    }

    #[test]
    fn a_list_is_written_only_where_it_shrinks() {
        let known = known("a.rs b.rs c.rs");
        let circle = |files: &'static str| files.split(' ').collect::<Circle<'_>>();
        assert_eq!(new(&[circle("a.rs c.rs")], &known), Vec::<String>::new());
        assert_eq!(new(&[circle("a.rs b.rs c.rs d.rs")], &known), ["a.rs b.rs c.rs d.rs"]);
    }
}
