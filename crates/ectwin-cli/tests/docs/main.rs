//! The pages are correct: every example of README.md, docs/user and docs/add-a-unit-model.md is run, read or found in a test.
//!
//! The test of a block depends on its language and on the file name after it:
//!
//! | block | test |
//! |---|---|
//! | `console` | each `$ ` line is run in a shell, and its output compared with the lines below it |
//! | `rust` | occurs word for word in a test, in crates/ectwin/tests |
//! | `toml` | is a unit file without mistakes |
//! | `st` | is a program without problems, for a unit at its factory setting |
//! | `sh` | is good syntax for a shell |
//! | `toml`, `python`, … with a file name | is a file with that name in the folder where the `console` blocks run |
//! | `text`, `json`, `yaml`, `mermaid` | nothing |

mod pages;
mod session;

use std::path::Path;
use std::process::Command;

use ectwin::Setup;
use pages::{Block, Page};
use session::Session;
use testbed::{in_network_namespace, ip};

fn blocks<'p>(pages: &'p [Page], language: &'p str) -> impl Iterator<Item = (&'p Page, &'p Block)> {
    let blocks = pages.iter().flat_map(|page| page.blocks.iter().map(move |block| (page, block)));
    blocks.filter(move |(_, block)| block.language == language)
}

#[test]
fn every_block_has_a_language_that_is_held_to_something() {
    let known = ["console", "rust", "toml", "st", "sh", "python", "text", "json", "yaml", "mermaid"];
    for page in &pages::read() {
        for block in &page.blocks {
            let place = page.place(block);
            assert!(known.contains(&block.language.as_str()), "{place}: a block of `{}`", block.language);
            let runs_nowhere = block.language == "python" && block.file_name.is_none();
            assert!(!runs_nowhere, "{place}: give it a file name, and run it in a console block");
        }
    }
}

#[test]
fn every_rust_block_stands_in_a_test() {
    let tests = pages::rust_tests();
    for (page, block) in blocks(&pages::read(), "rust") {
        let stands = tests.iter().any(|text| text.contains(block.text.trim()));
        assert!(
            stands,
            "{}: this stands in no test of crates/ectwin/tests:\n{}",
            page.place(block),
            block.text
        );
    }
}

#[test]
fn every_toml_block_is_a_unit_file() {
    for (page, block) in blocks(&pages::read(), "toml").filter(|(_, block)| block.file_name.is_none()) {
        if let Err(error) = Setup::from_toml(&block.text) {
            panic!("{}: {error}", page.place(block));
        }
    }
}

#[test]
fn every_st_block_is_a_program_without_problems() {
    for (page, block) in blocks(&pages::read(), "st").filter(|(_, block)| block.file_name.is_none()) {
        let place = page.place(block);
        let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap_or_else(|error| panic!("{error}"));
        setup.structured_text(&block.text).map(drop).unwrap_or_else(|problems| panic!("{place}: {problems}"));
    }
}

#[test]
fn every_sh_block_is_good_syntax() {
    for (page, block) in blocks(&pages::read(), "sh") {
        let output = Command::new("sh").args(["-n", "-c", &block.text]).output();
        let output = output.unwrap_or_else(|error| panic!("sh: {error}"));
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{}: {told}", page.place(block));
    }
}

/// In a separate network: the pages use the default port of UDP, and interfaces that they create.
#[test]
fn every_console_block_prints_what_it_says() {
    const TEST: &str = "every_console_block_prints_what_it_says";
    in_network_namespace(TEST, || {
        ip(&["link", "set", "lo", "up"]);
        for page in &pages::read() {
            let mut session = Session::begin(TEST, &page.name);
            for block in &page.blocks {
                if let Some(file_name) = &block.file_name {
                    session.put(Path::new(file_name), &block.text);
                } else if block.language == "console" {
                    session.run(&page.place(block), &block.text);
                }
            }
            session.end();
        }
    });
}
