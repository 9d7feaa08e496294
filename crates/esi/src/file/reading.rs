//! A document while it is read: its places, and the findings so far.

use core::cell::RefCell;

use roxmltree::{Document, Node};

use super::place::{Place, Places};
use super::read_error::ReadError;
use crate::lint::finding::{Finding, Findings, Report};
use crate::lint::rules::Rule;

/// Bytes of a file for each node of its tree: what a node takes in memory is bounded by the length of the file.
const BYTES_PER_NODE_MIN: usize = 8;
/// Nodes that every file may have.
const NODES_MIN: usize = 1_000;

/// The tree of a text.
pub(super) fn parse(text: &str) -> Result<Document<'_>, ReadError> {
    let nodes = (text.len() / BYTES_PER_NODE_MIN).max(NODES_MIN);
    let options = roxmltree::ParsingOptions {
        nodes_limit: u32::try_from(nodes).unwrap_or(u32::MAX),
        ..roxmltree::ParsingOptions::default()
    };
    Document::parse_with_options(text, options).map_err(|error| not_xml(text, &error))
}

fn not_xml(text: &str, error: &roxmltree::Error) -> ReadError {
    use roxmltree::Error as Xml;
    let reason = match error {
        Xml::NodesLimitReached | Xml::AttributesLimitReached | Xml::NamespacesLimitReached => {
            return ReadError::TooManyElements { length_bytes: text.len() };
        }
        Xml::UnclosedRootNode | Xml::UnexpectedEndOfStream => {
            let place = Places::of(text).of_byte(text.len());
            return ReadError::NotXml { place, reason: "the file ends too early".into() };
        }
        Xml::DtdDetected => "a document type declaration is not accepted".into(),
        Xml::NoRootNode => "there is no element".into(),
        Xml::UnexpectedCloseTag(expected, found, _) => {
            format!("`</{}>` where `</{}>` is expected", user_file::shown(found), user_file::shown(expected))
        }
        other => {
            let told = other.to_string();
            told.strip_suffix(&format!(" at {}", other.pos())).unwrap_or(&told).to_owned()
        }
    };
    let position = error.pos();
    let place = Place { line: position.row, column: position.col, byte: 0 };
    ReadError::NotXml { place, reason: user_file::shortened(user_file::on_one_line(&reason)) }
}

/// A document that is read.
pub(super) struct Reading<'a> {
    document: &'a Document<'a>,
    places: Places<'a>,
    /// The name of the file; none for the ESI file itself.
    file: Option<String>,
    findings: RefCell<Findings>,
}

impl<'a> Reading<'a> {
    pub(super) fn new(document: &'a Document<'a>, file: Option<String>) -> Self {
        let places = Places::of(document.input_text());
        Self { document, places, file, findings: RefCell::default() }
    }

    pub(super) fn root(&self) -> Node<'a, 'a> {
        self.document.root_element()
    }

    pub(super) fn place(&self, byte: usize) -> Place {
        self.places.of_byte(byte)
    }

    pub(super) fn into_findings(self) -> Findings {
        self.findings.into_inner()
    }

    /// The element at a place.
    fn element_at(&self, byte: usize) -> Option<Node<'a, 'a>> {
        let mut deepest = self.document.root_element();
        while let Some(inner) =
            deepest.children().filter(Node::is_element).find(|child| child.range().contains(&byte))
        {
            deepest = inner;
        }
        Some(deepest)
    }
}

impl Report for Reading<'_> {
    fn report(&self, rule: &'static Rule, place: Place, message: String) {
        let mut findings = self.findings.borrow_mut();
        if findings.is_full() {
            return findings.omit(rule);
        }
        let path = self.element_at(place.byte as usize).map(path).unwrap_or_default();
        findings.push(Finding { rule, file: self.file.clone(), place, path, message });
    }
}

/// The way from the root to an element, as in XPath: `/EtherCATInfo/Descriptions/Devices/Device[2]/Sm[1]`.
fn path(node: Node<'_, '_>) -> String {
    let steps: Vec<String> = node.ancestors().filter(Node::is_element).map(step).collect();
    steps.iter().rev().map(|step| format!("/{step}")).collect()
}

fn step(node: Node<'_, '_>) -> String {
    let name = node.tag_name().name();
    let named = |other: &Node<'_, '_>| other.is_element() && other.tag_name().name() == name;
    let before = node.prev_siblings().skip(1).filter(named).count();
    let is_only = before == 0 && !node.next_siblings().skip(1).any(|other| named(&other));
    if is_only { name.to_owned() } else { format!("{name}[{}]", before + 1) }
}
