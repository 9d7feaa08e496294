//! Results as JUnit, which every CI system shows, written one by one. Its times are virtual, and it has no time stamps.

use std::io::{self, BufWriter, Write};
use std::time::Duration;

use quick_junit::XmlString;
use quick_xml::Writer;
use quick_xml::escape::escape;
use quick_xml::events::attributes::Attr;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};

use super::case::test_name;
use super::result::{CaseResult, FailedStep, Verdict};
use super::story;

const REPORT: &str = "testsuites";
const SUITE: &str = "testsuite";
const CASE: &str = "testcase";
const FAILURE: &str = "failure";
const SYSTEM_OUT: &str = "system-out";
const INDENT: usize = 4;

/// What the head of a report says of all results.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Totals {
    pub(crate) cases: u64,
    pub(crate) failed: u64,
    pub(crate) warned: u64,
    /// Test cases that are not results: those that a signal has ended, and those that were not begun.
    interrupted: u64,
    skipped: u64,
    lasted_ns: u64,
}

/// A test case without a result.
pub(crate) struct NotEnded {
    pub(crate) name: String,
    /// The scenario file.
    pub(crate) file: String,
    pub(crate) why: NotEndedBy,
    pub(crate) message: String,
}

/// Why a test case has no result.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum NotEndedBy {
    /// A signal while it ran: an error.
    Signal,
    /// It was not begun: it is skipped.
    Skipped,
}

impl Totals {
    /// Counts a result.
    pub(crate) fn add(&mut self, result: &CaseResult) {
        self.cases += 1;
        self.failed += u64::from(result.verdict == Verdict::Failed);
        self.warned += u64::from(!result.warnings.is_empty());
        self.lasted_ns = self.lasted_ns.saturating_add(result.virtual_ns);
    }

    /// Counts a test case without a result.
    pub(super) fn add_not_ended(&mut self, why: NotEndedBy) {
        match why {
            NotEndedBy::Signal => self.interrupted += 1,
            NotEndedBy::Skipped => self.skipped += 1,
        }
    }
}

/// A report with one suite, whose head is written. The results follow in their order.
pub(crate) struct JunitReport<W: Write> {
    writer: Writer<BufWriter<W>>,
    /// A suite without cases is one tag.
    has_cases: bool,
}

impl<W: Write> JunitReport<W> {
    /// `command` is the name of the report, such as `ectwin replay`.
    pub(crate) fn begin(to: W, command: &str, totals: Totals) -> io::Result<Self> {
        let mut writer = Writer::new_with_indent(BufWriter::new(to), b' ', INDENT);
        let count = totals.cases + totals.interrupted + totals.skipped;
        let (tests, failures) = (count.to_string(), totals.failed.to_string());
        let (skipped, errors) = (totals.skipped.to_string(), totals.interrupted.to_string());
        let time = seconds(totals.lasted_ns);
        writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        let (tests, failures) = (("tests", tests.as_str()), ("failures", failures.as_str()));
        let (skipped, errors) = (("skipped", skipped.as_str()), ("errors", errors.as_str()));
        let time = ("time", time.as_str());
        let report = [("name", command), tests, skipped, failures, errors, time];
        writer.write_event(Event::Start(BytesStart::new(REPORT).with_attributes(report)))?;
        let suite = [("name", "scenarios"), tests, skipped, errors, failures, time];
        let suite = BytesStart::new(SUITE).with_attributes(suite);
        let has_cases = count > 0;
        writer.write_event(if has_cases { Event::Start(suite) } else { Event::Empty(suite) })?;
        Ok(Self { writer, has_cases })
    }

    /// Writes the next result.
    pub(crate) fn take(&mut self, result: &CaseResult) -> io::Result<()> {
        let name = xml(test_name(&result.title, result.parameters.as_deref(), result.seed));
        let file = xml(&result.file);
        let time = seconds(result.virtual_ns);
        let mut case = BytesStart::new(CASE);
        case.extend_attributes([("name", name.as_str()), ("classname", file.as_str()), ("time", &time)]);
        // GitLab and others link a failure to its place by these.
        case.push_attribute(("file", file.as_str()));
        let warnings = story::warnings(result);
        let Some(step) = &result.failure else {
            if warnings.is_empty() {
                return self.writer.write_event(Event::Empty(case));
            }
            self.writer.write_event(Event::Start(case))?;
            self.text(SYSTEM_OUT, &warnings)?;
            return self.writer.write_event(Event::End(BytesEnd::new(CASE)));
        };
        case.push_attribute(("line", step.line.to_string().as_str()));
        self.writer.write_event(Event::Start(case))?;
        self.failure(result, step)?;
        if let Some(trace) = &result.trace {
            self.text(SYSTEM_OUT, trace)?;
        }
        self.writer.write_event(Event::End(BytesEnd::new(CASE)))
    }

    /// Writes a test case without a result.
    pub(super) fn not_ended(&mut self, case: &NotEnded) -> io::Result<()> {
        let (name, file, message) = (xml(&case.name), xml(&case.file), xml(&case.message));
        let attributes = [("name", name.as_str()), ("classname", file.as_str()), ("file", file.as_str())];
        self.writer.write_event(Event::Start(BytesStart::new(CASE).with_attributes(attributes)))?;
        let element = match case.why {
            NotEndedBy::Signal => BytesStart::new("error").with_attributes([("type", "interrupted")]),
            NotEndedBy::Skipped => BytesStart::new("skipped"),
        };
        let element = element.with_attributes([("message", message.as_str())]);
        self.writer.write_event(Event::Empty(element))?;
        self.writer.write_event(Event::End(BytesEnd::new(CASE)))
    }

    fn failure(&mut self, result: &CaseResult, step: &FailedStep) -> io::Result<()> {
        let message = xml(format!("{}:{}: `{}`: {}", result.file, step.line, step.step, step.seen));
        let told = xml(story::failure(result));
        // Line ends stay line ends, which readers have always seen here.
        let message = escape(message.as_str());
        let mut failure = BytesStart::new(FAILURE);
        failure.push_attribute(Attr::DoubleQ("message", message.as_ref()));
        let kind = if step.panicked_at.is_some() { "panic" } else { "expectation" };
        failure.push_attribute(("type", kind));
        self.writer.write_event(Event::Start(failure))?;
        self.writer.write_event(Event::Text(BytesText::new(told.as_str())))?;
        self.writer.write_event(Event::End(BytesEnd::new(FAILURE)))
    }

    fn text(&mut self, element: &str, text: &str) -> io::Result<()> {
        let text = xml(text);
        self.writer.write_event(Event::Start(BytesStart::new(element)))?;
        self.writer.write_event(Event::Text(BytesText::new(text.as_str())))?;
        self.writer.write_event(Event::End(BytesEnd::new(element)))
    }

    /// Ends the report behind its last result, and returns where it went.
    pub(crate) fn end(mut self) -> io::Result<W> {
        if self.has_cases {
            self.writer.write_event(Event::End(BytesEnd::new(SUITE)))?;
        }
        self.writer.write_event(Event::End(BytesEnd::new(REPORT)))?;
        self.writer.write_indent()?;
        self.writer.into_inner().into_inner().map_err(io::IntoInnerError::into_error)
    }
}

/// A text without the characters that XML 1.0 does not allow. The library omits all but the two noncharacters.
fn xml(text: impl AsRef<str>) -> XmlString {
    XmlString::new(text.as_ref().replace(['\u{FFFE}', '\u{FFFF}'], ""))
}

fn seconds(nanos: u64) -> String {
    format!("{:.3}", Duration::from_nanos(nanos).as_secs_f64())
}

#[cfg(test)]
mod tests {
    use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

    use super::super::partition::Partition;
    use super::*;

    fn result(case: u64, title: &str, failure: Option<&str>) -> CaseResult {
        let failure_trace = failure.map(|seen| format!("1 ms <seen> {seen}\n"));
        let failure = failure.map(|seen| FailedStep {
            line: 7,
            step: "unit 1 is in <OP> & \"OP\"".to_owned(),
            at_ns: 5_000_000,
            seen: seen.to_owned(),
            panicked_at: None,
        });
        CaseResult {
            case,
            cases: 9,
            partition: Partition::WHOLE,
            campaign: "0".to_owned(),
            file: "s/a & b.toml".to_owned(),
            parameters: None,
            title: title.to_owned(),
            seed: case,
            verdict: if failure.is_some() { Verdict::Failed } else { Verdict::Passed },
            failure,
            warnings: Vec::new(),
            virtual_ns: 1_234_567_890 * case,
            cycles: 0,
            differences: Vec::new(),
            trace_differences: Vec::new(),
            trace: failure_trace,
            command: None,
            frames: Vec::new(),
            met: None,
        }
    }

    fn streamed(results: &[CaseResult]) -> String {
        let mut totals = Totals::default();
        results.iter().for_each(|result| totals.add(result));
        let mut bytes = Vec::new();
        let mut report = JunitReport::begin(&mut bytes, "ectwin replay", totals).unwrap();
        results.iter().for_each(|result| report.take(result).unwrap());
        report.end().unwrap();
        String::from_utf8(bytes).unwrap()
    }

    /// The report as the library for JUnit writes it, which needs all results at once.
    fn at_once(results: &[CaseResult]) -> String {
        let lasted = Duration::from_nanos(results.iter().map(|result| result.virtual_ns).sum());
        let mut suite = TestSuite::new("scenarios");
        for result in results {
            let status = result.failure.as_ref().map_or_else(TestCaseStatus::success, |step| {
                let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                status.set_type("expectation");
                let message = format!("{}:{}: `{}`: {}", result.file, step.line, step.step, step.seen);
                status.set_message(message).set_description(story::failure(result));
                status
            });
            let mut case = TestCase::new(format!("{} (seed {})", result.title, result.seed), status);
            case.set_classname(result.file.as_str()).set_time(Duration::from_nanos(result.virtual_ns));
            case.extra.insert("file".into(), result.file.as_str().into());
            if let Some(trace) = &result.trace {
                case.set_system_out(trace);
            }
            if let Some(step) = &result.failure {
                case.extra.insert("line".into(), step.line.to_string().into());
            }
            suite.add_test_case(case);
        }
        suite.set_time(lasted);
        let mut report = Report::new("ectwin replay");
        report.add_test_suite(suite).set_time(lasted);
        report.to_string().unwrap()
    }

    #[test]
    fn a_report_that_is_written_one_by_one_is_what_the_library_for_junit_writes() {
        let results = [
            result(1, "outputs stop in OP", None),
            result(
                2,
                "Öl & <tags> \"quoted\" 'so'\ttab",
                Some("unit 1 is in SAFE-OP\nand more ]]> \u{1b}[31m\u{7}"),
            ),
            result(3, "", Some("")),
        ];
        for count in 0..=results.len() {
            assert_eq!(streamed(&results[..count]), at_once(&results[..count]), "{count} results");
        }
    }

    #[test]
    fn a_panic_is_a_failure_of_another_type() {
        let mut failed = result(1, "a model panics", Some("panicked at a.rs:1:2: no room"));
        failed.failure.iter_mut().for_each(|step| step.panicked_at = Some("a.rs:1:2".to_owned()));
        assert!(streamed(&[failed]).contains("type=\"panic\""));
    }

    #[test]
    fn what_xml_does_not_allow_is_left_out_of_titles_names_and_results() {
        let mut failed = result(1, "a\u{FFFE}b\u{FFFF}c\u{7}d", Some("e\u{FFFE}f"));
        failed.file = "g\u{FFFF}.toml".to_owned();
        let report = streamed(&[failed]);
        assert!(report.contains("name=\"abcd (seed 1)\" classname=\"g.toml\""), "{report}");
        assert!(report.contains(": ef\"") && !report.contains(['\u{FFFE}', '\u{FFFF}', '\u{7}']), "{report}");
    }
}
