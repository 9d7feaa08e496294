//! One finding with an excerpt of its place in the file.

use std::fmt;
use std::path::Path;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, Severity, SourceCode};
use nx_ect101::{EventLevel, Finding};

use super::places::Place;
use crate::colour::colour_on_stdout;
use crate::file_problem::ShownFile;

/// The finding with its places, its event and its correction.
pub(super) fn picture(
    path: &Path,
    text: &str,
    finding: &Finding,
    level: EventLevel,
    places: Vec<Place>,
) -> String {
    let spans = places.iter().map(|place| place.span.clone());
    let source = ShownFile::of(&path.display().to_string(), text, spans);
    let diagnostic = RuleDiagnostic { finding, level, places, source };
    let theme = if colour_on_stdout() { GraphicalTheme::unicode() } else { GraphicalTheme::none() };
    let mut picture = String::new();
    let handler = GraphicalReportHandler::new_themed(theme).with_links(false);
    match handler.render_report(&mut picture, &diagnostic) {
        Ok(()) => picture + "\n",
        Err(_) => format!("{diagnostic}\n"),
    }
}

#[derive(Debug)]
struct RuleDiagnostic<'f> {
    finding: &'f Finding,
    level: EventLevel,
    places: Vec<Place>,
    source: ShownFile,
}

impl fmt::Display for RuleDiagnostic<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.finding.message())?;
        match self.places.is_empty() {
            true => formatter.write_str(" (the file leaves this to the factory setting)"),
            false => Ok(()),
        }
    }
}

impl std::error::Error for RuleDiagnostic<'_> {}

impl Diagnostic for RuleDiagnostic<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let Finding { event, rule, .. } = self.finding;
        Some(Box::new(format!("{event} {} (rule {})", self.finding.event_name(), rule.id())))
    }

    fn severity(&self) -> Option<Severity> {
        Some(if self.level == EventLevel::MinorFault { Severity::Error } else { Severity::Warning })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.finding.correction()))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        (!self.places.is_empty()).then_some(&self.source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let labelled = self.places.iter().zip(self.source.marked());
        Some(Box::new(
            labelled.map(|(place, span)| LabeledSpan::new_with_span(Some(place.label.clone()), span)),
        ))
    }
}
