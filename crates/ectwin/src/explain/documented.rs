//! Names in tables of the user's pages: faults of scenarios, types, variables, ErrorIDs, counters.

use std::sync::LazyLock;

use super::{DocumentedKind, Explanation, Fact, Subject, page};

/// A table of a page, by its heading and its header.
struct Source {
    kind: DocumentedKind,
    text: &'static str,
    /// The page, as users find it.
    page: &'static str,
    heading: &'static str,
    header: &'static [&'static str],
    /// The column of the meaning, and the words before it.
    meaning: (usize, &'static str),
}

#[rustfmt::skip]
const SOURCES: &[Source] = &[
    Source {
        kind: DocumentedKind::Fault,
        text: include_str!("../../../../docs/user/scenario-reference.md"),
        page: "docs/user/scenario-reference.md",
        heading: "faults", header: &["fault", "event"], meaning: (1, "causes the event "),
    },
    Source {
        kind: DocumentedKind::DataType,
        text: include_str!("../../../../docs/user/structured-text-reference.md"),
        page: "docs/user/structured-text-reference.md",
        heading: "elementary types", header: &["type", "bits", "values"], meaning: (2, ""),
    },
    Source {
        kind: DocumentedKind::Variable,
        text: include_str!("../../../../docs/user/structured-text.md"),
        page: "docs/user/structured-text.md",
        heading: "Device variables", header: &["variable", "TRUE"], meaning: (1, "TRUE "),
    },
    Source {
        kind: DocumentedKind::Variable,
        text: include_str!("../../../../docs/user/scenario-programs.md"),
        page: "docs/user/scenario-programs.md",
        heading: "The user program of the master", header: &["variable", "element n is TRUE"],
        meaning: (1, "element n is TRUE "),
    },
    Source {
        kind: DocumentedKind::ErrorId,
        text: include_str!("../../../../docs/user/structured-text.md"),
        page: "docs/user/structured-text.md",
        heading: "Messages and user-defined errors", header: &["ErrorID", "means", "ErrorIDEx"], meaning: (1, ""),
    },
    Source {
        kind: DocumentedKind::Counter,
        text: include_str!("../../../../docs/user/command-line.md"),
        page: "docs/user/command-line.md",
        heading: "run", header: &["counter", "number of"], meaning: (1, "number of "),
    },
];

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| SOURCES.iter().flat_map(rows).collect());

struct Row {
    source: &'static Source,
    /// The first cell: one name, or several.
    names: &'static str,
    cells: Vec<&'static str>,
}

fn rows(source: &'static Source) -> Vec<Row> {
    let sections =
        page::sections(source.text).into_iter().filter(|section| section.heading == source.heading);
    let tables = sections.flat_map(|section| section.tables).filter(|table| table.header == source.header);
    let rows = tables.flat_map(|table| table.rows).filter(|cells| cells.len() == source.header.len());
    rows.filter_map(|cells| Some(Row { source, names: cells.first()?, cells })).collect()
}

/// Each name with its subject. An ErrorID is known without its `16#` too.
pub(super) fn names() -> impl Iterator<Item = (&'static str, Subject)> {
    ROWS.iter().flat_map(|row| {
        let subject = Subject::Documented(row.source.kind, row.names);
        let names = row.names.split([',', ';']).map(|name| name.trim().trim_matches('`'));
        let all = names.flat_map(|name| [Some(name), name.strip_prefix("16#")].into_iter().flatten());
        all.chain([row.names]).map(move |name| (name, subject))
    })
}

pub(super) fn explanation(kind: DocumentedKind, names: &'static str) -> Option<Explanation> {
    let row = ROWS.iter().find(|row| (row.source.kind, row.names) == (kind, names))?;
    let (meaning, before) = row.source.meaning;
    let others =
        row.source.header.iter().zip(&row.cells).enumerate().skip(1).filter(|(at, _)| *at != meaning);
    let facts = others.map(|(_, (label, cell))| Fact::new(*label, page::plain(cell)));
    Some(Explanation {
        subject: Subject::Documented(kind, names),
        name: format!("{before}{}", page::plain(row.cells.get(meaning)?)),
        facts: facts.chain([Fact::new("page", row.source.page)]).collect(),
        advice: Vec::new(),
        sections: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_is_found() {
        for source in SOURCES {
            assert!(!rows(source).is_empty(), "{}: {}", source.page, source.heading);
        }
    }
}
