//! One finding with an excerpt of its place in the file.

use std::fmt;
use std::path::Path;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, Severity, SourceCode};
use unit_model::{EventLevel, SettingsFinding};

use crate::colour::colour_on_stdout;
use crate::file_problem::ShownFile;

/// The finding with its places, its event and its correction.
pub(super) fn picture(path: &Path, text: &str, finding: &SettingsFinding) -> String {
    let spans = finding.places.iter().map(|place| place.span.clone());
    let source = ShownFile::of(&path.display().to_string(), text, spans);
    let diagnostic = RuleDiagnostic { finding, source };
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
    finding: &'f SettingsFinding,
    source: ShownFile,
}

impl fmt::Display for RuleDiagnostic<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.finding.message)?;
        match self.finding.places.is_empty() {
            true => formatter.write_str(" (the file leaves this to the factory setting)"),
            false => Ok(()),
        }
    }
}

impl std::error::Error for RuleDiagnostic<'_> {}

impl Diagnostic for RuleDiagnostic<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let SettingsFinding { event, event_name, rule, .. } = self.finding;
        Some(Box::new(format!("{event} {event_name} (rule {rule})")))
    }

    fn severity(&self) -> Option<Severity> {
        Some(if self.finding.level == EventLevel::MinorFault { Severity::Error } else { Severity::Warning })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.finding.correction))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        (!self.finding.places.is_empty()).then_some(&self.source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let labelled = self.finding.places.iter().zip(self.source.marked());
        Some(Box::new(
            labelled.map(|(place, span)| LabeledSpan::new_with_span(Some(place.label.clone()), span)),
        ))
    }
}
