//! `ectwin lint FILE.xml`: what is wrong with an ESI file.

use std::path::{Component, Path};

use ectwin::user_files::{self, Wanted};
use esi::file::{DeviceElement, EsiFile, ReadError};
use esi::lint::finding::Finding;
use esi::lint::rules::Level;
use esi::sii;
use serde::Serialize;
use user_file::{and_more, counted};

use crate::cli::LintArgs;
use crate::failure::Failure;
use crate::failure_document::or_document;
use crate::file_problem::FileProblem;
use crate::output;

#[derive(Serialize)]
struct Document<'a> {
    devices: usize,
    modules: usize,
    findings: Vec<Row<'a>>,
    /// The number of further findings.
    omitted: usize,
    /// The findings of the SII image; none without one.
    sii: Option<Vec<SiiRow<'a>>>,
}

#[derive(Serialize)]
struct SiiRow<'a> {
    check: &'a str,
    place: &'a str,
    found: &'a str,
    expected: &'a str,
}

#[derive(Serialize)]
struct Row<'a> {
    rule: &'a str,
    level: String,
    /// The external file, relative to the ESI file; none for the ESI file itself.
    file: Option<&'a str>,
    line: u32,
    column: u32,
    path: &'a str,
    message: &'a str,
    correction: &'a str,
    source: &'a str,
}

/// Shows the findings. Notes alone are no failure.
pub(crate) fn run(args: &LintArgs) -> Result<(), Failure> {
    let file = or_document(args.json, read(&args.esi))?;
    let sii = args.sii.as_ref().map(|path| sii_findings(path, &file)).transpose();
    let sii = or_document(args.json, sii)?;
    if args.json {
        output::print(output::json(&document(&file, sii.as_deref()))?.as_bytes())?;
    } else {
        output::print_text(&for_people(&args.esi, &file))?;
        if let (Some(path), Some(findings)) = (&args.sii, &sii) {
            output::print_text(&sii_for_people(path, findings))?;
        }
    }
    let is_sii_right = sii.is_none_or(|findings| findings.is_empty());
    if file.findings.has(Level::Warning) || !is_sii_right { Err(Failure::RulesBroken) } else { Ok(()) }
}

/// What is wrong with an image by itself, and where it differs from the device of the file that has its identity.
fn sii_findings(path: &Path, file: &EsiFile) -> Result<Vec<sii::Finding>, Failure> {
    let unreadable = |source| Failure::Unreadable { path: path.to_owned(), source };
    let image = user_files::bytes(path, Wanted::SiiImage).map_err(unreadable)?;
    let mut findings = sii::lint(&image);
    let Ok(contents) = sii::parse(&image) else { return Ok(findings) };
    let identity = (contents.header.vendor_id, contents.header.product_code, contents.header.revision);
    let descriptions = file.devices.iter().map(DeviceElement::description);
    let mut same =
        descriptions.filter(|device| (device.vendor.id, device.product_code, device.revision) == identity);
    match same.next() {
        Some(device) => findings.extend(sii::compare(&image, &device)),
        None => findings.push(sii::Finding {
            check: "C023",
            place: "identity".into(),
            found: format!("{:#X}, {:#X}, {:#X}", identity.0, identity.1, identity.2),
            expected: "vendor ID, product code and revision number of a device of the ESI file".into(),
        }),
    }
    Ok(findings)
}

fn read(path: &Path) -> Result<EsiFile, Failure> {
    let unreadable = |source| Failure::Unreadable { path: path.to_owned(), source };
    let bytes = user_files::bytes(path, Wanted::Esi).map_err(unreadable)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let beside = |name: &str| {
        let is_below = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
        if is_below { user_files::bytes(&folder.join(name), Wanted::Esi).ok() } else { None }
    };
    EsiFile::read(&bytes, &beside).map_err(|error| Failure::BadFile(problem(path, &bytes, &error).into()))
}

fn problem(path: &Path, bytes: &[u8], error: &ReadError) -> FileProblem {
    let message = error.to_string();
    match error.place() {
        Some(place) => {
            let text = String::from_utf8_lossy(bytes);
            let number = place.line as usize;
            let line = text.lines().nth(number.saturating_sub(1)).unwrap_or_default();
            FileProblem::in_line(path, number, line, &message, error.help())
        }
        None => FileProblem::of_file(&message, error.help()),
    }
}

fn document<'a>(file: &'a EsiFile, sii: Option<&'a [sii::Finding]>) -> Document<'a> {
    Document {
        devices: file.devices.len(),
        modules: file.modules.len(),
        findings: file.findings.list().iter().map(row).collect(),
        omitted: file.findings.omitted(),
        sii: sii.map(|findings| findings.iter().map(sii_row).collect()),
    }
}

fn sii_row(finding: &sii::Finding) -> SiiRow<'_> {
    let sii::Finding { check, place, found, expected } = finding;
    SiiRow { check, place, found, expected }
}

fn sii_for_people(path: &Path, findings: &[sii::Finding]) -> String {
    let shown = output::shown(path);
    let lines: String = findings.iter().map(|finding| format!("{shown}: {finding}\n")).collect();
    let result =
        if findings.is_empty() { "no problems".to_owned() } else { counted(findings.len(), "finding") };
    lines + &format!("{shown}: {result}\n")
}

fn row(finding: &Finding) -> Row<'_> {
    let Finding { rule, file, place, path, message } = finding;
    Row {
        rule: rule.code,
        level: rule.level.to_string(),
        file: file.as_deref(),
        line: place.line,
        column: place.column,
        path,
        message,
        correction: rule.correction,
        source: rule.source,
    }
}

fn for_people(path: &Path, file: &EsiFile) -> String {
    let shown = output::shown(path);
    let findings = file.findings.list();
    let mut text: String = findings.iter().map(|finding| picture(&shown, finding)).collect();
    text.extend(and_more(file.findings.omitted()).map(|more| format!("{more}\n")));
    let devices = counted(file.devices.len(), "device");
    let result = if findings.is_empty() {
        "no problems".to_owned()
    } else {
        let count = |level| findings.iter().filter(|finding| finding.rule.level == level).count();
        let levels = [(Level::Error, "error"), (Level::Warning, "warning"), (Level::Note, "note")];
        let counts = levels.map(|(level, noun)| (count(level), noun));
        let told =
            counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, noun)| counted(count, noun));
        told.collect::<Vec<_>>().join(", ")
    };
    text + &format!("{shown}: {devices}, {result}\n")
}

fn picture(esi: &str, finding: &Finding) -> String {
    let Finding { rule, file, path, .. } = finding;
    let file = file.as_ref().map_or_else(|| esi.to_owned(), |file| user_file::on_one_line(file));
    let finding = user_file::on_one_line(&finding.to_string());
    format!("{file}:{finding}\n  at {path}\n  help: {}; {}\n", rule.correction, rule.source)
}
